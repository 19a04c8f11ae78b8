import * as app from '../state/app';
import { written, type Path } from '../state/splice';

/** A slider and a field with one value, which stands at a path of the text. */
export function Slider(p: { label: string; value: number; min: number; max: number; path: Path; unit?: string; digits?: number; write?: (x: number) => string }) {
  const write = p.write ?? ((x: number) => written(x) + (p.unit === '°' ? 'deg' : ''));
  const span = p.max - p.min;
  return (
    <div class="row">
      <label>{p.label}</label>
      <input
        type="range"
        aria-label={p.label}
        min={p.min}
        max={p.max}
        step={span / 400}
        value={p.value}
        style={{ '--v': `${(100 * (Math.min(p.max, Math.max(p.min, p.value)) - p.min)) / span}%` }}
        onInput={(e) => app.changeWhileDragging(p.path, write(Number(e.currentTarget.value)))}
        onChange={() => app.document_.release()}
      />
      <span class="number">
        <input
          class="field"
          aria-label={`${p.label}, number`}
          value={Number(p.value.toPrecision(4))}
          inputMode="decimal"
          onKeyDown={(e) => {
            e.stopPropagation();
            if (e.key === 'Enter') e.currentTarget.blur();
          }}
          onChange={(e) => {
            const typed = Number(e.currentTarget.value.replace(',', '.').replace('−', '-'));
            if (Number.isFinite(typed)) app.change(p.path, write(typed));
          }}
        />
        {p.unit && <span class="unit">{p.unit}</span>}
      </span>
    </div>
  );
}

export function Color(p: { label: string; value: string; path: Path }) {
  return (
    <div class="row">
      <label>{p.label}</label>
      <input
        type="color"
        aria-label={p.label}
        value={p.value}
        onInput={(e) => app.changeWhileDragging(p.path, JSON.stringify(e.currentTarget.value))}
        onChange={() => app.document_.release()}
      />
      <input
        class="field mono grow"
        aria-label={`${p.label}, as text`}
        value={p.value}
        onKeyDown={(e) => e.stopPropagation()}
        onChange={(e) => app.change(p.path, JSON.stringify(e.currentTarget.value))}
      />
    </div>
  );
}

export function Choice<T extends string>(p: { label: string; options: { value: T; label: string; sub?: string }[]; value: T | null; choose: (value: T) => void; column?: boolean }) {
  return (
    <div class={`choice ${p.column ? 'column' : ''}`} role="radiogroup" aria-label={p.label}>
      {p.options.map((o) => (
        <button role="radio" aria-checked={p.value === o.value} key={o.value} onClick={() => p.choose(o.value)}>
          {o.label}
          {o.sub && <span class="sub">{o.sub}</span>}
        </button>
      ))}
    </div>
  );
}
