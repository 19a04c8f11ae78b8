import { useEffect, useRef } from 'preact/hooks';
import { column, expMap } from '../room/geometry';
import * as g from '../room/geometry';
import { chartPoint, drawTiling, pointOfChart, wallMiddle, wallPath } from '../panel/tiling';
import * as app from '../state/app';
import { Icon } from './icons';
import { Slider } from './controls';
import { chiSum, fraction, spaceNames, spaceWords, wallColor } from './words';
import { moveObject } from './move';

/** The tiling with its room, the eye and the things in it; in design with handles, the sum of χ and the shape of the room. */
export function Tiling() {
  const s = app.scene.value;
  const canvas = useRef<HTMLCanvasElement>(null);
  const room = s?.room;
  const size = app.mode.value === 'design' ? 296 : 188;
  useEffect(() => {
    if (!room || !canvas.current) return;
    canvas.current.width = canvas.current.height = Math.round(size * Math.min(2, devicePixelRatio || 1));
    drawTiling(canvas.current, room);
  }, [room, size]);
  if (!s || !room) return null;
  const o = s.orbifold;
  const design = app.mode.value === 'design';
  return (
    <aside id="tiling" class="plate" aria-label="The tiling">
      <header class="name">
        {design ? <NotationField notation={o.notation} /> : <b class="mono">{o.notation}</b>}
        <span class="space" title={`${spaceWords[o.space]}: χ ${o.chi_value > 0 ? '>' : o.chi_value < 0 ? '<' : '='} 0`}>
          <Icon name={o.space} />
          {spaceNames[o.space]}
          <span title={`Euler characteristic χ = ${o.chi}`}>
            <i class="math">χ</i> {fraction(o.chi)}
          </span>
        </span>
      </header>
      <div class="disk">
        <canvas ref={canvas} aria-hidden="true" />
        <Overlay />
      </div>
      {design && (
        <div class="more">
          <div class="sum">
            <span>
              <i class="math">χ</i> = {chiSum(o)} {chiSum(o) && '= '}
              <strong>{fraction(o.chi)}</strong>
            </span>
            <span class="dim end">{spaceWords[o.space]}</span>
          </div>
          <Axis chi={o.chi_value} />
          <Corners orders={o.orders} strip={o.strip} />
          <Height />
        </div>
      )}
    </aside>
  );
}

function NotationField({ notation }: { notation: string }) {
  const commit = (field: HTMLInputElement) => {
    const typed = field.value.trim();
    if (typed === notation) return;
    app.change(['orbifold'], JSON.stringify(typed));
  };
  return (
    <input
      class="field notation mono"
      aria-label="Notation of the orbifold"
      value={notation}
      spellcheck={false}
      onKeyDown={(e) => {
        if (e.key === 'Enter') commit(e.currentTarget);
        if (e.key === 'Escape') (e.currentTarget.value = notation), e.currentTarget.blur();
        e.stopPropagation();
      }}
      onBlur={(e) => commit(e.currentTarget)}
    />
  );
}

function Overlay() {
  const s = app.scene.value!;
  const room = s.room;
  const eye = app.eye.value;
  const chosen = app.selection.value;
  const design = app.mode.value === 'design';
  const svg = useRef<SVGSVGElement>(null);
  const grip = useRef<{ object: number; moved: boolean } | null>(null);
  const place = (e: PointerEvent) => {
    const box = svg.current!.getBoundingClientRect();
    return pointOfChart(room, ((e.clientX - box.left) / box.width) * 1000, ((e.clientY - box.top) / box.height) * 1000);
  };
  const eyeMark = () => {
    if (!eye) return null;
    const at = column(eye.roomFromEye, 0);
    const [x, y] = chartPoint(room, at);
    const fan = [-0.6, 0.6].map((a) => chartPoint(room, g.apply(eye.roomFromEye, expMap(room.curvature, 0.25 * unit * Math.cos(eye.yaw + a), 0.25 * unit * Math.sin(eye.yaw + a)))));
    const tip = chartPoint(room, g.apply(eye.roomFromEye, expMap(room.curvature, 0.02 * unit * Math.cos(eye.yaw), 0.02 * unit * Math.sin(eye.yaw))));
    const angle = (Math.atan2(tip[1] - y, tip[0] - x) * 180) / Math.PI;
    return (
      <g class="eye">
        <path class="fan" d={`M${x} ${y}L${fan[0]}L${fan[1]}z`} />
        <path transform={`translate(${x} ${y}) rotate(${angle})`} d="M26 0-16-18-8 0-16 18z" />
      </g>
    );
  };
  const unit = Math.max(0.3, room.circumradius);
  return (
    <svg ref={svg} class="overlay" viewBox="0 0 1000 1000" role="group" aria-label="Walls, corners and things">
      {room.walls.map((_, i) => (
        <path class="casing" d={wallPath(room, i)} key={i} />
      ))}
      {room.walls.map((_, i) => (
        <path
          class={`wall ${chosen.kind === 'wall' && chosen.index === i ? 'on' : ''}`}
          d={wallPath(room, i)}
          style={{ stroke: wallColor(i) }}
          key={i}
          onClick={() => design && (app.selection.value = { kind: 'wall', index: i })}
        />
      ))}
      {design &&
        room.walls.map((_, i) => {
          const [x, y] = wallMiddle(room, i, 44);
          return (
            <text class="wall-number" x={x} y={y} style={{ fill: wallColor(i) }} key={i}>
              {i + 1}
            </text>
          );
        })}
      {eyeMark()}
      {s.objects
        .map((object, i) => ({ object, i }))
        .filter(({ object }) => object.shape !== 'beam')
        .map(({ object, i }) => {
          const [x, y] = chartPoint(room, object.at);
          return (
            <circle
              class={`thing ${chosen.kind === 'object' && chosen.index === i ? 'on' : ''}`}
              cx={x}
              cy={y}
              r={design ? 17 : 13}
              key={i}
              onPointerDown={(e) => {
                if (!design) return;
                e.currentTarget.setPointerCapture(e.pointerId);
                grip.current = { object: i, moved: false };
                app.selection.value = { kind: 'object', index: i };
              }}
              onPointerMove={(e) => {
                if (!grip.current) return;
                grip.current.moved = true;
                moveObject(grip.current.object, place(e), e.altKey);
              }}
              onPointerUp={() => {
                if (grip.current?.moved) app.endDrag();
                grip.current = null;
              }}
            >
              <title>{object.name}</title>
            </circle>
          );
        })}
      {s.lamps.map((lamp, i) => {
        const [x, y] = chartPoint(room, lamp.at);
        return <path class="lamp-mark" d={`M${x} ${y - 12}l10 12-10 12-10-12z`} key={i} />;
      })}
      {design && s.orbifold.orders.map((order, i) => <Handle index={i} order={order} key={i} />)}
    </svg>
  );
}

/** One step of an order: integers by one, others to the next integer. */
export function nextOrder(order: string, by: number): string {
  const [a, b = 1] = order.split('/').map(Number) as [number, number?];
  const value = a / b;
  const next = by > 0 ? Math.floor(value + 1e-9) + 1 : Math.ceil(value - 1e-9) - 1;
  return String(Math.max(2, next));
}

function Handle({ index, order }: { index: number; order: string }) {
  const room = app.scene.value!.room;
  const at = room.corners[index];
  if (!at) return null;
  const [x, y] = chartPoint(room, at);
  const on = app.corner.value === index;
  const step = (by: number) => {
    app.corner.value = index;
    void app.setOrder(index, nextOrder(order, by));
  };
  const shown = order.includes('/') && order.length > 4 ? Number(eval2(order)).toPrecision(3) : order;
  return (
    <g
      class={`handle ${on ? 'on' : ''} ${on && app.refused.value ? 'refused' : ''}`}
      role="spinbutton"
      tabIndex={0}
      aria-label={`Corner ${index + 1}`}
      aria-valuenow={eval2(order)}
      aria-valuetext={`order ${order}`}
      onFocus={() => ((app.corner.value = index), (app.refused.value = null))}
      onClick={() => (app.corner.value = index)}
      onWheel={(e) => {
        e.preventDefault();
        step(e.deltaY < 0 ? 1 : -1);
      }}
      onKeyDown={(e) => {
        if (e.key === 'ArrowUp') step(1);
        else if (e.key === 'ArrowDown') step(-1);
        else if (/^[0-9]$/.test(e.key)) typeOrder(e.key);
        else if (e.key === 'Escape') app.corner.value = null;
        else return;
        e.preventDefault();
        e.stopPropagation();
      }}
    >
      <circle class="ring" cx={x} cy={y} r="66" />
      <circle cx={x} cy={y} r="48" />
      <text x={x} y={y + 2} style={shown.length > 2 ? { fontSize: '38px' } : {}}>
        {shown}
      </text>
    </g>
  );
}
const eval2 = (order: string): number => {
  const [a, b = 1] = order.split('/').map(Number) as [number, number?];
  return a / b;
};
/** Digits typed on a handle go on in the pop-over's field. */
function typeOrder(digit: string): void {
  const field = document.getElementById('order') as HTMLInputElement | null;
  if (!field) return;
  field.focus();
  field.value = digit;
}

function Axis({ chi }: { chi: number }) {
  // χ ≤ 1 for every room; the axis shows −1 … 1.
  const at = (x: number) => 140 + 136 * Math.max(-1, Math.min(1, x));
  const s = app.scene.value!;
  const corner = app.corner.value;
  const order = corner === null ? null : s.orbifold.orders[corner];
  const next = order ? chi - 0.5 / eval2(order) + 0.5 / eval2(nextOrder(order, 1)) : null;
  return (
    <svg class="axis" viewBox="0 0 280 40" role="img" aria-label={`χ is ${chi.toPrecision(3)}, on an axis with flat rooms at 0`}>
      <path class="line" d="M4 14h272M4 14l5-3.500M4 14l5 3.500M140 6v16M72 11v6M208 11v6M276 9v10" />
      {next !== null && <circle class="next" cx={at(next)} cy="14" r="3.5" />}
      <path class="now" d={`M${at(chi)} 12l-6-10h12z`} />
      <circle class="now" cx={at(chi)} cy="14" r="3" />
      <text x="72" y="35">H² χ &lt; 0</text>
      <text x="140" y="35">E² 0</text>
      <text x="208" y="35">S² χ &gt; 0</text>
      <text x="272" y="35">1</text>
    </svg>
  );
}

function Corners({ orders, strip }: { orders: string[]; strip: boolean }) {
  return (
    <div class="row">
      <span class="label">Corners</span>
      <span class="stepper">
        <button aria-label="One corner less" disabled={strip || orders.length < 3} onClick={() => void app.setOrders(orders.slice(0, -1))}>
          <Icon name="minus" />
        </button>
        <output>{orders.length}</output>
        <button aria-label="One corner more" disabled={strip || orders.length > 30} onClick={() => void app.setOrders([...orders, '2'])}>
          <Icon name="plus" />
        </button>
      </span>
      {app.scene.value!.room.moduli > 0 && (
        <span class="dim end" title="So many lengths of the room are free: cuts or lengths in the text set them">
          {app.scene.value!.room.moduli} free
        </span>
      )}
    </div>
  );
}

function Height() {
  return <Slider label="Height" value={app.scene.value!.room.height} min={0.2} max={2.5} path={['room', 'height']} />;
}

/** What is said of the chosen corner, beside the plate. */
export function CornerPopover() {
  const index = app.corner.value;
  const s = app.scene.value;
  if (index === null || !s || app.mode.value !== 'design') return null;
  const order = s.orbifold.orders[index];
  if (order === undefined) return null;
  const value = eval2(order);
  const next = nextOrder(order, 1);
  const chi = s.orbifold.chi_value - 0.5 / value + 0.5 / eval2(next);
  const space = chi > 1e-12 ? 'S²' : chi < -1e-12 ? 'H²' : 'E²';
  const here = s.orbifold.space === 'spherical' ? 'S²' : s.orbifold.space === 'hyperbolic' ? 'H²' : 'E²';
  return (
    <section id="corner" class="plate" aria-label={`Corner ${index + 1}`}>
      <div class="row">
        <b>Corner {index + 1}</b>
        <span class="dim end">angle {Number((180 / value).toFixed(1))}°</span>
      </div>
      <div class="big">
        <button aria-label="Order less" onClick={() => void app.setOrder(index, nextOrder(order, -1))} disabled={value <= 2}>
          <Icon name="minus" />
        </button>
        <input
          id="order"
          class="field"
          aria-label={`Order of corner ${index + 1}`}
          value={order}
          inputMode="decimal"
          onKeyDown={(e) => {
            e.stopPropagation();
            if (e.key === 'Enter') void app.setOrder(index, e.currentTarget.value);
            if (e.key === 'Escape') app.corner.value = null;
            if (e.key === 'ArrowUp') void app.setOrder(index, nextOrder(order, 1));
            if (e.key === 'ArrowDown') void app.setOrder(index, nextOrder(order, -1));
          }}
        />
        <button aria-label="Order more" onClick={() => void app.setOrder(index, next)}>
          <Icon name="plus" />
        </button>
      </div>
      {app.refused.value ? (
        <p class="error" role="alert">
          <Icon name="warn" />
          {app.refused.value.charAt(0).toUpperCase() + app.refused.value.slice(1)}
        </p>
      ) : (
        <p class="dim">
          Order {next}: angle {Number((180 / eval2(next)).toFixed(1))}°, χ = {chi.toFixed(3).replace('-', '−')}, {space === here ? `stays in ${space}` : `becomes ${space}`}.
        </p>
      )}
    </section>
  );
}
