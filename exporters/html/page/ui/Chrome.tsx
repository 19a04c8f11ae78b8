/** What stands around the picture: bar, status, help, compass, menus, and the states in which there is no picture. */
import { useEffect, useState } from 'preact/hooks';
import * as app from '../state/app';
import { linkOf } from '../state/share';
import { holonomy } from '../room/walk';
import { Icon } from './icons';
import { examples } from './starters';
import { saveExport, saveFile, savePage, savePicture } from './files';
import { openFile } from './take';

export function Bar() {
  const design = app.mode.value === 'design';
  return (
    <nav id="bar" class="plate" aria-label="Commands">
      <button aria-label="Undo" title="Undo (Ctrl Z)" disabled={!app.document_.canUndo.value} onClick={() => app.document_.undo()}>
        <Icon name="undo" />
      </button>
      <button aria-label="Redo" title="Redo (Ctrl Y)" disabled={!app.document_.canRedo.value} onClick={() => app.document_.redo()}>
        <Icon name="redo" />
      </button>
      <span class="separator" />
      <button aria-label="Share and export" title="Share and export" aria-haspopup="menu" aria-expanded={app.menu.value === 'share'} onClick={() => (app.menu.value = app.menu.value === 'share' ? null : 'share')}>
        <Icon name="share" />
      </button>
      <button aria-label="More" title="More" aria-haspopup="menu" aria-expanded={app.menu.value === 'more'} onClick={() => (app.menu.value = app.menu.value === 'more' ? null : 'more')}>
        <Icon name="more" />
      </button>
      <span class="separator" />
      <button id="design" class={design ? 'soft' : 'primary'} title={design ? 'Walk (Esc)' : 'Design (Enter)'} onClick={() => (app.mode.value = design ? 'walk' : 'design')}>
        <Icon name={design ? 'eye' : 'pen'} />
        {design ? 'Walk' : 'Design'}
        {design && <kbd>Esc</kbd>}
      </button>
    </nav>
  );
}

export function Status() {
  const share = app.refining.value, light = app.lightShare.value;
  const busy = light < 1 ? light : share > 0 && share < 1 ? share : null;
  const words = app.stale.value ? 'Last good picture' : light < 1 ? `Lighting ${Math.round(100 * light)} %` : share >= 1 ? 'Traced, 16 samples' : share > 0 ? `Refining ${Math.round(100 * share)} %` : 'Live picture';
  return (
    <div id="status" class="plate" role="status">
      {app.stale.value ? (
        <span class="warn">
          <Icon name="warn" />
        </span>
      ) : (
        <svg class="progress" viewBox="0 0 16 16" aria-hidden="true">
          <circle cx="8" cy="8" r="6.5" />
          <circle class={share >= 1 ? 'arc done' : 'arc'} cx="8" cy="8" r="6.5" pathLength="100" stroke-dasharray={`${100 * (busy ?? (share >= 1 ? 1 : 0))} 100`} />
        </svg>
      )}
      <span>{words}</span>
      <button aria-label="Show the difference" title="Difference between the live and the traced picture (X)" aria-pressed={app.difference.value} onClick={() => (app.difference.value = !app.difference.value)}>
        <Icon name="difference" />
        <kbd>X</kbd>
      </button>
    </div>
  );
}

export function Difference() {
  if (!app.difference.value) return null;
  const share = app.differing.value;
  return (
    <div id="difference" class="plate" role="status">
      <b>Live against traced</b>
      <span class="dim">{share === null ? 'the tracer is on its way' : `${(100 * share).toFixed(2)} % of the picture differs by more than 4/255`}</span>
      <span class="scale-legend">
        0 <span class="scale" /> 64/255
      </span>
    </div>
  );
}

export function Help() {
  if (app.mode.value === 'design' || app.stepped.value || app.difference.value) return null;
  return (
    <div id="help" class="plate">
      <span class="keys-help">
        <kbd>W</kbd>
        <kbd>A</kbd>
        <kbd>S</kbd>
        <kbd>D</kbd> walk
      </span>
      <span class="keys-help">drag to look</span>
      <span class="keys-help">
        <kbd>Enter</kbd> design
      </span>
      <span class="keys-help">
        <kbd>?</kbd> keys
      </span>
      <span class="touch-help">left thumb walks · right thumb looks</span>
    </div>
  );
}

export function Compass() {
  const eye = app.eye.value;
  if (!eye || app.mode.value === 'design' || !app.home) return null;
  const { angle, mirrored } = holonomy(app.home, eye);
  if (Math.abs(angle) < 0.5 && !mirrored) return null;
  const a = (angle * Math.PI) / 180;
  const x = 20 + 16 * Math.sin(a), y = 20 - 16 * Math.cos(a);
  return (
    <div id="compass" class="plate" title="How the walk has turned the frame that was carried along it">
      <svg viewBox="0 0 40 40" aria-hidden="true">
        <circle cx="20" cy="20" r="18" />
        <path class="tick" d="M20 4v5" />
        <path class="arrow" d={`M20 20L${x} ${y}`} />
      </svg>
      <span>
        Turned {Math.round(Math.abs(angle))}°
        <small>since the start{mirrored ? ` · mirrored ${mirrored === 1 ? 'once' : mirrored + ' times'}` : ''}</small>
      </span>
    </div>
  );
}

export function Menus() {
  const [link, setLink] = useState('');
  const [copied, setCopied] = useState(false);
  useEffect(() => {
    if (app.menu.value === 'share') (setCopied(false), void linkOf(app.text.value).then(setLink));
  }, [app.menu.value]);
  if (app.menu.value === 'keys') return <Keys />;
  if (!app.menu.value) return null;
  const item = (icon: string, label: string, more: string, act: () => void) => (
    <button role="menuitem" class="item" onClick={() => (act(), (app.menu.value = null))}>
      <Icon name={icon} />
      {label}
      <span class="end dim">{more}</span>
    </button>
  );
  if (app.menu.value === 'more')
    return (
      <div class="menu plate" role="menu" aria-label="More">
        {item('page', 'Open files', 'scene, mesh, picture', openFile)}
        {item('room', 'New scene', '', () => app.document_.replaceAll(''))}
        {item('mirror', app.throughMirrors.value ? 'Mirrors are walls' : 'Walk through mirrors', 'T', () => (app.throughMirrors.value = !app.throughMirrors.value))}
        {item('image', app.projector.value ? 'Leave projector' : 'Projector', 'P', () => (app.projector.value = !app.projector.value))}
        {item('keyboard', 'Keys', '?', () => setTimeout(() => (app.menu.value = 'keys')))}
      </div>
    );
  return (
    <div class="menu plate" role="menu" aria-label="Share and export">
      <button
        role="menuitem"
        class="item"
        onClick={() => {
          const address = location.href.split('#')[0] + link;
          history.replaceState(null, '', link);
          void navigator.clipboard?.writeText(address).then(() => setCopied(true), () => setCopied(true));
        }}
      >
        <Icon name="link" />
        {copied ? 'Copied' : 'Copy link'}
        <span class="end dim">{link.length} characters</span>
      </button>
      <p>The whole scene is in the link. Nothing is uploaded.</p>
      <hr />
      {item('text', 'Scene', 'YAML', () => saveFile('scene.yaml', app.text.value, 'text/yaml'))}
      {item('page', 'This page', 'HTML', () => void savePage())}
      {item('image', 'Picture', 'PNG · this eye', savePicture)}
      {item('cube', 'Blender and viewers', 'GLB · this eye', () => void saveExport('glb'))}
      {item('eye', 'POV-Ray', 'POV · this eye', () => void saveExport('pov'))}
      {item('room', 'Tiling, for print', 'SVG', () => void saveExport('svg'))}
      <p>Straight rays draw these files: they show the mirrors' images as copies, true for this eye.</p>
    </div>
  );
}

function Keys() {
  const rows: [string, string][] = [
    ['W A S D, arrows', 'walk; Shift: faster'],
    ['Q E', 'turn'],
    ['R F', 'up and down'],
    ['Drag, or two fingers', 'look around'],
    ['T', 'walk through mirrors, or not'],
    ['Enter, Esc', 'design, walk'],
    ['X', 'live against traced'],
    ['H', 'back to the start'],
    ['P', 'projector'],
    ['Ctrl Z, Ctrl Y', 'undo, redo'],
  ];
  return (
    <div class="menu keys plate" role="dialog" aria-label="Keys">
      <h2>Keys</h2>
      <dl>
        {rows.map(([k, v]) => (
          <>
            <dt>{k}</dt>
            <dd>{v}</dd>
          </>
        ))}
      </dl>
      <button class="soft wide" onClick={() => (app.menu.value = null)}>
        Close
      </button>
    </div>
  );
}

export function Empty() {
  if (!app.empty.value) return null;
  return (
    <div id="empty" role="dialog" aria-label="Start in a room">
      <div class="sheet">
        <h1>Start in a room</h1>
        <p class="dim lead">Mirrors on every wall. What the corners add up to decides which space you stand in.</p>
        <div class="cards">
          {examples.map((e, i) => (
            <button class="card" key={e.notation} onClick={() => app.document_.replaceAll(e.text)}>
              <img src={e.picture} alt="" />
              <h2>
                <Icon name={e.space} />
                <span class="mono">{e.notation}</span>
                <span class="dim">
                  {e.where} <i class="math">χ</i> = {e.chi}
                </span>
                <kbd>{i + 1}</kbd>
              </h2>
              <p class="dim">{e.line}</p>
            </button>
          ))}
        </div>
        <form
          class="open"
          onSubmit={(e) => {
            e.preventDefault();
            const typed = new FormData(e.currentTarget).get('notation');
            if (typed) app.document_.replaceAll(`orbc: 1\norbifold: ${JSON.stringify(String(typed).trim())}\n`);
          }}
        >
          <input class="field" name="notation" aria-label="Notation" placeholder="Type a notation: *2323" spellcheck={false} onKeyDown={(e) => e.stopPropagation()} />
          <button type="button" class="soft" onClick={openFile}>
            <Icon name="page" />
            Open a file
          </button>
          <span class="dim end">or drop a scene or a mesh anywhere</span>
        </form>
      </div>
    </div>
  );
}

export function Fatal({ again }: { again: () => void }) {
  if (!app.fatal.value) return null;
  return (
    <div id="fatal" class="plate" role="alert">
      <h1>The picture stopped</h1>
      <p>{app.fatal.value} Your scene is safe: its text is kept in this browser.</p>
      <div class="open">
        <button class="primary" autofocus onClick={again}>
          Draw again
        </button>
        <button class="soft" onClick={() => saveFile('scene.yaml', app.text.value, 'text/yaml')}>
          Save scene
        </button>
      </div>
    </div>
  );
}

export function Tag() {
  const t = app.tag.value;
  if (!t) return null;
  return (
    <div class={`tag plate ${t.blocked ? 'blocked' : ''}`} style={{ left: `${t.x}px`, top: `${t.y}px` }}>
      <b>{t.title}</b> <span class="dim">{t.more}</span>
    </div>
  );
}

/** An export on its way. */
export function Exporting() {
  const now = app.exporting.value;
  if (!now) return null;
  return (
    <div id="exporting" class="plate" role="status">
      <span>
        Writing {now.format.toUpperCase()} · {now.stage}
        {now.share === null ? '' : ` ${Math.round(100 * now.share)} %`}
      </span>
      <button class="soft" onClick={app.stopExport}>
        Cancel
      </button>
    </div>
  );
}

export function Toast() {
  return app.message.value ? (
    <div id="toast" class="plate" role="alert">
      <Icon name="warn" />
      {app.message.value}
      <button aria-label="Close" onClick={() => (app.message.value = '')}>
        ×
      </button>
    </div>
  ) : null;
}
