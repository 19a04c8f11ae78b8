import * as app from '../state/app';
import { get, getScalar, type Path } from '../state/splice';
import { Choice, Color, Slider } from './controls';
import { Icon } from './icons';
import { TextPane } from './TextPane';
import { hexOf, upperFirst, wallColor } from './words';
import * as g from '../room/geometry';

export function Panel() {
  if (app.mode.value !== 'design' || !app.scene.value) return null;
  const isText = app.tab.value === 'text';
  return (
    <section id="panel" class={`plate ${isText ? 'wide' : ''}`} aria-label="Design">
      <div class="tabs" role="tablist">
        <button role="tab" aria-selected={!isText} onClick={() => (app.tab.value = 'things')}>
          <Icon name="cube" />
          Things
        </button>
        <button role="tab" aria-selected={isText} onClick={() => (app.tab.value = 'text')}>
          <Icon name="text" />
          Text
          {app.errors.value.length > 0 && (
            <span class="count" title="errors">
              {app.errors.value.length}
            </span>
          )}
        </button>
      </div>
      {isText ? <TextPane /> : <Things />}
    </section>
  );
}

function Things() {
  const chosen = app.selection.value;
  if (chosen.kind === 'object') return <ObjectInspector index={chosen.index} />;
  if (chosen.kind === 'wall') return <WallInspector index={chosen.index} />;
  if (chosen.kind === 'lamp') return <LampInspector index={chosen.index} />;
  return <RoomList />;
}

const primitives: { label: string; text: string }[] = [
  { label: 'Sphere', text: '{sphere: {radius: 0.1}, at: centre, material: glass}' },
  { label: 'Cylinder', text: '{cylinder: {radius: 0.07, height: 0.3}, at: centre, material: wood}' },
  { label: 'Box', text: '{box: {size: [0.15, 0.15, 0.15]}, at: centre, material: {color: steelblue}}' },
  { label: 'Ring', text: '{torus: {radius: 0.1, tube: 0.03}, at: centre, material: gold}' },
  { label: 'Knot', text: '{torus_knot: {p: 2, q: 3, radius: 0.1, tube: 0.03}, at: centre, material: {kind: glossy, color: coral}}' },
  { label: 'Lamp', text: '{kind: sphere, at: centre, power: 4, temperature: 3400}' },
];

export function addThing(text: string, label: string): void {
  if (label === 'Lamp') app.add(['lights'], text);
  else app.add(['objects'], text);
  const s = app.scene.value;
  if (s) app.selection.value = label === 'Lamp' ? { kind: 'lamp', index: s.lamps.length } : { kind: 'object', index: s.objects.length };
}

function RoomList() {
  const s = app.scene.value!;
  const beams = s.objects.filter((o) => o.shape === 'beam').length;
  return (
    <div class="view" role="tabpanel">
      <div class="head">
        <h2>The room</h2>
      </div>
      <section>
        <h3>Mirrors show</h3>
        <Choice
          label="Mirrors show"
          column
          value={app.presetOf()}
          options={[
            { value: 'universal', label: 'Universal cover', sub: 'every image' },
            { value: 'translational', label: 'Fading cover', sub: 'the nearest images' },
            { value: 'orbifold', label: 'Orbifold', sub: 'the room alone' },
          ]}
          choose={(value) => {
            const lines: [string[], string][] =
              value === 'orbifold' ? [[['cover', 'max_bounces'], '0']] : [[['cover', 'max_bounces'], value === 'universal' ? '12' : '4'], [['room', 'walls', 'all', 'mirror', 'reflectance'], value === 'universal' ? '1' : '0.7']];
            app.document_.apply(app.severalSplices(lines));
          }}
        />
      </section>
      <section>
        <h3>Walls</h3>
        <ul>
          {s.shell.walls.map((wall, i) => (
            <li key={i}>
              <button class="item" onClick={() => (app.selection.value = { kind: 'wall', index: i })}>
                <span class="chip" style={{ background: wallColor(i) }}>
                  {i + 1}
                </span>
                Wall {i + 1}
                <span class="end dim">{wall.mirrors[0] ? `mirror ${Number(Math.max(...wall.mirrors[0].throughput).toFixed(2))}` : 'plain'}</span>
              </button>
            </li>
          ))}
        </ul>
      </section>
      <section>
        <h3>Objects</h3>
        <ul>
          {s.objects.map(
            (object, i) =>
              object.shape !== 'beam' && (
                <li key={i}>
                  <button class="item" onClick={() => (app.selection.value = { kind: 'object', index: i })}>
                    <Icon name="cube" />
                    {object.name}
                    <span class="end dim">{object.pattern !== 'plain' ? object.pattern : object.material === 'own' ? object.shape : object.material}</span>
                  </button>
                </li>
              ),
          )}
          {beams > 0 && (
            <li class="item dim">
              <Icon name="cube" />
              {beams} beams
            </li>
          )}
        </ul>
        <div class="adds" aria-label="Add">
          {primitives.map((p) => (
            <button class="soft" key={p.label} onClick={() => addThing(p.text, p.label)}>
              <Icon name="plus" />
              {p.label}
            </button>
          ))}
        </div>
      </section>
      <section>
        <h3>Lamps</h3>
        <ul>
          {s.lamps.map((lamp, i) => (
            <li key={i}>
              <button class="item" onClick={() => (app.selection.value = { kind: 'lamp', index: i })}>
                <Icon name="lamp" />
                Lamp {i + 1}
                <span class="end dim">{lamp.kind}</span>
              </button>
            </li>
          ))}
          {s.lamps.length === 0 && <li class="item dim">None: the room shows its plain colors</li>}
        </ul>
      </section>
      <section>
        <h3>Floor and ceiling</h3>
        <Color label="Floor" value={hexOf(s.shell.floor.color)} path={colorPath(['room', 'floor'])} />
        <Color label="Ceiling" value={hexOf(s.shell.ceiling.color)} path={colorPath(['room', 'ceiling'])} />
      </section>
    </div>
  );
}

/** Where the first color of a surface stands in the text. */
function colorPath(path: app.Path): app.Path {
  for (const key of ['checker', 'marble', 'wood', 'granite']) if (get(app.text.value, [...path, key]) !== undefined) return [...path, key, 0];
  return [...path, 'color'];
}

function Head(p: { title: string; children?: preact.ComponentChildren }) {
  return (
    <div class="head">
      <button aria-label="Back to the room" title="Back to the room" onClick={() => (app.selection.value = { kind: 'room' })}>
        <Icon name="back" />
      </button>
      <h2>{p.title}</h2>
      {p.children}
    </div>
  );
}

function DeleteButton({ path }: { path: Path }) {
  const remove = () => {
    app.take(path);
    app.selection.value = { kind: 'room' };
  };
  return (
    <button aria-label="Delete" title="Delete (Del)" onClick={remove}>
      <Icon name="bin" />
    </button>
  );
}

/** Where a thing is, in polar coordinates about the room's centre (r in lengths of the scene, angle in degrees). The text of what
 * `stands` on the floor does not name the height 0. */
function PlaceSliders(p: { path: Path; place: { r: number; angle: number; z: number }; stands?: boolean }) {
  const room = app.scene.value!.room;
  const path = [...p.path, 'at'];
  const { r, angle, z } = p.place;
  const at = (radius: number, degrees: number, height: number) => {
    const polar = `polar: [${app.written(radius)}, ${Number(degrees.toFixed(1))}deg]`;
    return p.stands && height === 0 ? `{${polar}}` : `{${polar}, z: ${app.written(height)}}`;
  };
  return (
    <>
      <Slider label="From centre" value={r} min={0} max={room.circumradius} path={path} write={(v) => at(v, angle, z)} />
      <Slider label="Direction" value={angle} min={0} max={360} unit="°" path={path} write={(v) => at(r, v, z)} />
      <Slider label="Above floor" value={z} min={0} max={room.height} path={path} write={(v) => at(r, angle, v)} />
    </>
  );
}

const materials = ['marble', 'granite', 'wood', 'gold', 'glass', 'chrome'];

function ObjectInspector({ index }: { index: number }) {
  const s = app.scene.value!;
  const object = s.objects[index];
  if (!object) return <RoomList />;
  const path = app.objectPath(index), k = s.room.curvature;
  const [x, y] = g.logMap(k, object.at);
  // What the text says counts: the place that the core tells has been rounded on its way.
  const polar = [0, 1].map((i) => parseFloat(getScalar(app.text.value, [...path, 'at', 'polar', i]) ?? 'none'));
  const r = Number.isFinite(polar[0]) ? polar[0]! : Math.hypot(x, y);
  const angle = Number.isFinite(polar[1]) ? (polar[1]! + 360) % 360 : ((Math.atan2(y, x) * 180) / Math.PI + 360) % 360;
  const z = Number(getScalar(app.text.value, [...path, 'at', 'z']) ?? 0);
  const turn = parseFloat(getScalar(app.text.value, [...path, 'turn']) ?? '0');
  const size = getScalar(app.text.value, [...path, 'size']);
  const material = getScalar(app.text.value, [...path, 'material']);
  const snap = (place: string) => app.change([...path, 'at'], z === 0 ? `{${place}}` : `{${place}, z: ${app.written(z)}}`);
  const nearestWall = nearest(s.room.walls.map((w) => g.valueAt(w.line, object.at)));
  const nearestCorner = nearest(s.room.corners.map((c) => Math.hypot(g.diskFromPoint(k, c)[0] - g.diskFromPoint(k, object.at)[0], g.diskFromPoint(k, c)[1] - g.diskFromPoint(k, object.at)[1])));
  return (
    <div class="view" role="tabpanel">
      <Head title={object.name}>
        <button aria-label="Duplicate" title="Duplicate" onClick={() => duplicate(index)}>
          <Icon name="copy" />
        </button>
        <DeleteButton path={path} />
      </Head>
      <section>
        <PlaceSliders path={path} place={{ r, angle, z }} stands />
        <div class="row">
          <span class="label">Snap to</span>
          <button class="soft" title="The centre" onClick={() => snap('polar: [0, 0deg]')}>
            Centre
          </button>
          {s.room.corners.length > 0 && (
            <button class="soft" title="The nearest corner's axis" onClick={() => snap(`toward: corner ${nearestCorner + 1}, distance: ${app.written(r || 0.1)}`)}>
              Corner
            </button>
          )}
          <button class="soft" title="The middle of the nearest wall" onClick={() => snap(`toward: wall ${nearestWall + 1}, distance: ${app.written(r || 0.1)}`)}>
            Wall
          </button>
        </div>
      </section>
      <section>
        <Slider label="Turn" value={turn} min={0} max={360} unit="°" path={[...path, 'turn']} />
        <Slider label="Size" value={size === undefined ? 2 * object.extent : Number(size)} min={0.02} max={Math.max(0.3, s.room.inradius * 1.6)} path={[...path, 'size']} />
      </section>
      <section>
        <div class="row">
          <span class="label">Material</span>
          <span>{material && /^[a-z]+$/.test(material) ? upperFirst(material) : 'Its own'}</span>
        </div>
        <div class="materials" role="radiogroup" aria-label="Material">
          {materials.map((m) => (
            <button key={m} role="radio" aria-checked={material === m} aria-label={m} title={upperFirst(m)} class={`swatch ${m}`} onClick={() => app.change([...path, 'material'], m)} />
          ))}
        </div>
        <Color label="Color" value={colorOf(material)} path={[...path, 'material']} />
      </section>
    </div>
  );
}
const colorOf = (material: string | undefined) => (material && /^#[0-9a-f]{6}$/i.test(material) ? material : '#cccccc');
const nearest = (list: number[]) => list.indexOf(Math.min(...list));

function duplicate(index: number): void {
  const entry = get(app.text.value, ['objects', index]);
  if (!entry) return;
  const object = app.scene.value!.objects[index]!;
  const [x, y] = g.logMap(app.scene.value!.room.curvature, object.at);
  const angle = ((Math.atan2(y, x) * 180) / Math.PI + 30 + 360) % 360;
  const flat = app.flowOf(entry);
  const moved = app.withEntry(flat, 'at', `{polar: [${app.written(Math.max(0.1, Math.hypot(x, y)))}, ${angle.toFixed(0)}deg]}`);
  app.add(['objects'], app.withoutEntry(moved, 'name'));
  app.selection.value = { kind: 'object', index: app.scene.value!.objects.length };
}

function WallInspector({ index }: { index: number }) {
  const s = app.scene.value!;
  const wall = s.shell.walls[index];
  if (!wall) return <RoomList />;
  const path = app.wallPath(index);
  const mirror = wall.mirrors[0];
  const share = mirror ? Math.max(...mirror.throughput) : 0;
  const tint = mirror && share > 0 ? mirror.throughput.map((x) => x / share) : [1, 1, 1];
  const own = (key: string[]) => getScalar(app.text.value, [...path, ...key]) ?? getScalar(app.text.value, ['room', 'walls', 'all', ...key]);
  const width = Number(own(['frame', 'width']) ?? own(['mirror', 'frame', 'width']) ?? 0);
  const frame = own(['mirror', 'frame', 'width']) !== undefined ? [...path, 'mirror', 'frame'] : [...path, 'frame'];
  return (
    <div class="view" role="tabpanel">
      <div class="head">
        <button aria-label="Back to the room" title="Back to the room" onClick={() => (app.selection.value = { kind: 'room' })}>
          <Icon name="back" />
        </button>
        <span class="chip" style={{ background: wallColor(index) }}>
          {index + 1}
        </span>
        <h2>Wall {index + 1}</h2>
        <span class="dim caption">length {Number(s.room.walls[index]!.length.toPrecision(4))}</span>
      </div>
      <section>
        <Choice
          label="Kind of wall"
          value={mirror ? 'mirror' : 'plain'}
          options={[
            { value: 'mirror', label: 'Mirror' },
            { value: 'plain', label: 'Plain wall' },
          ]}
          choose={(v) => app.change([...path, 'mirror'], v === 'plain' ? 'none' : '{reflectance: 0.94}')}
        />
        {mirror && (
          <>
            <Slider label="Reflectance" value={Number(share.toFixed(3))} min={0.05} max={1} path={[...path, 'mirror', 'reflectance']} />
            <Color label="Tint" value={hexOf(tint)} path={[...path, 'mirror', 'tint']} />
          </>
        )}
        {!mirror && <Color label="Color" value={hexOf(wall.color)} path={[...path, 'color']} />}
      </section>
      {mirror && (
        <section>
          <Slider label="Frame width" value={width} min={0} max={0.12} path={[...frame, 'width']} />
          <div class="caption dim">
            Each bounce keeps {Math.round(100 * share)} % of the light; after 10 bounces {Math.round(100 * share ** 10)} %.
          </div>
        </section>
      )}
      <section>
        <button
          class="soft wide"
          onClick={() => {
            const value = get(app.text.value, path);
            if (value !== undefined) app.document_.apply(app.severalSplices([[['room', 'walls'], `{all: ${app.flowOf(value)}}`]]));
          }}
        >
          Copy to all walls
        </button>
      </section>
    </div>
  );
}

function LampInspector({ index }: { index: number }) {
  const s = app.scene.value!;
  const lamp = s.lamps[index];
  if (!lamp) return <RoomList />;
  const path = app.lampPath(index), k = s.room.curvature;
  const [x, y] = g.logMap(k, lamp.at);
  const r = Math.hypot(x, y), angle = ((Math.atan2(y, x) * 180) / Math.PI + 360) % 360, z = lamp.at[3]!;
  return (
    <div class="view" role="tabpanel">
      <Head title={`Lamp ${index + 1}`}>
        <DeleteButton path={path} />
      </Head>
      <section>
        <Slider label="Power" value={Number(getScalar(app.text.value, [...path, 'power']) ?? 10)} min={0} max={20} path={[...path, 'power']} />
        <Slider label="Temperature" value={Number(getScalar(app.text.value, [...path, 'temperature']) ?? 6500)} min={1500} max={12000} unit="K" path={[...path, 'temperature']} write={(v) => String(Math.round(v / 50) * 50)} />
        {(lamp.kind === 'sphere' || lamp.kind === 'disk') && <Slider label="Radius" value={Number(getScalar(app.text.value, [...path, 'radius']) ?? 0.05)} min={0.01} max={0.2} path={[...path, 'radius']} />}
      </section>
      <section>
        <PlaceSliders path={path} place={{ r, angle, z }} />
      </section>
    </div>
  );
}
