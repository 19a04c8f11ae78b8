/** What is drawn over the picture for the chosen thing: the ring that turns an object, the mast that lifts it, its images' rings, the border
 *  of a wall. */
import * as app from '../state/app';
import { getScalar, set, written } from '../state/splice';
import * as g from '../room/geometry';
import { lens, projection, rayAt, type Lens } from '../room/lens';
import { frameAt, pointAtHeight } from '../room/pick';
import { wallColor } from './words';

type Point = [number, number];
const path = (points: (Point | null)[]): string => {
  let text = '', pen = false;
  for (const p of points) {
    if (p) text += `${pen ? 'L' : 'M'}${p[0].toFixed(1)} ${p[1].toFixed(1)}`;
    pen = p !== null;
  }
  return text;
};

export function Gizmos() {
  const s = app.scene.value, chosen = app.selection.value;
  if (!s || !app.eye.value || app.mode.value !== 'design' || app.fatal.value) return null;
  if (chosen.kind === 'room') return null;
  const l = lens();
  return (
    <svg id="gizmos" width={innerWidth} height={innerHeight} aria-hidden="true">
      {chosen.kind === 'object' && s.objects[chosen.index] && <ObjectMarks index={chosen.index} l={l} />}
      {chosen.kind === 'wall' && s.room.walls[chosen.index] && <WallMarks index={chosen.index} l={l} />}
      {chosen.kind === 'lamp' && s.lamps[chosen.index] && <LampMarks index={chosen.index} l={l} />}
    </svg>
  );
}

function circle(at: ArrayLike<number>, radius: number, k: number): g.Vector[] {
  const there = frameAt(k, at);
  return [...Array(49).keys()].map((i) => g.apply(there, g.expMap(k, radius * Math.cos((i * Math.PI) / 24), radius * Math.sin((i * Math.PI) / 24))));
}

function Line({ d, kind = '' }: { d: string; kind?: string }) {
  return (
    <>
      <path class="halo" d={d} />
      <path class={`ink ${kind}`} d={d} />
    </>
  );
}

function ObjectMarks({ index, l }: { index: number; l: Lens }) {
  const s = app.scene.value!, object = s.objects[index]!;
  const k = s.room.curvature, z = object.at[3]!;
  const ring = circle(object.at, object.extent + 0.02, k);
  const project = projection(l);
  const blocked = app.stale.value ? 'blocked' : '';
  const textPath = app.objectPath(index);
  const turn = parseFloat(getScalar(app.text.value, [...textPath, 'turn']) ?? '0') || 0;
  const radius = object.extent + 0.02, angle = (turn * Math.PI) / 180;
  const grip = project(g.apply(frameAt(k, object.at), g.expMap(k, radius * Math.cos(angle), radius * Math.sin(angle))), z);
  const mast = [...Array(9).keys()].map((i) => project(object.at, z + ((object.top + 0.05 - z) * i) / 8));
  const top = mast[mast.length - 1] ?? null;
  const copies = app.lastCopies;
  const images: { d: string; odd: boolean }[] = [];
  if (copies && !app.dragging.value) {
    let at = 0;
    for (let i = 0; i < copies.lengths.length && images.length < 24; ++i) {
      const length = copies.lengths[i]!;
      at += length;
      if (length === 0 || length > 2) continue;
      const image = projection(l, [...copies.matrices.subarray(9 * i, 9 * i + 9)]);
      images.push({ d: path(ring.map((p) => image(p, z))), odd: length % 2 === 1 });
    }
  }
  const start = app.dragStart.value;
  return (
    <g>
      {images.map((image, i) => (
        <path class={`image ${image.odd ? 'mirrored' : ''}`} d={image.d} key={i} />
      ))}
      {start && <path class="image old" d={path(circle(start, radius, k).map((p) => project(p, start[3]!)))} />}
      {app.snapped.value && <Line d={path(app.snapped.value.line.map((p) => project(p, z)))} kind="mast" />}
      <Line d={path(ring.map((p) => project(p, z)))} kind={blocked} />
      {!app.dragging.value && <Line d={path(mast)} kind="mast" />}
      {!app.dragging.value && grip && (
        <Knob at={grip} cursor="ew-resize" icon="M-4 -2a4.500 4.500 0 1 1 1 5M-4.500 -5v3h3" title="Turn" drag={(e) => turnTo(index, l, e)} />
      )}
      {!app.dragging.value && top && <Knob at={top} cursor="ns-resize" icon="M-3.500 -1.500L0 -5l3.500 3.500M-3.500 1.500L0 5l3.500 -3.500" title="Lift" drag={(e) => liftTo(index, l, e)} />}
    </g>
  );
}

function Knob({ at, cursor, icon, title, drag }: { at: Point; cursor: string; icon: string; title: string; drag: (e: PointerEvent) => void }) {
  return (
    <g
      class="knob"
      transform={`translate(${at[0].toFixed(1)} ${at[1].toFixed(1)})`}
      style={{ cursor }}
      onPointerDown={(e) => e.currentTarget.setPointerCapture(e.pointerId)}
      onPointerMove={(e) => e.currentTarget.hasPointerCapture(e.pointerId) && drag(e)}
      onPointerUp={() => app.endDrag()}
    >
      <title>{title}</title>
      <circle class="reach" r="20" />
      <circle r="11" />
      <path d={icon} />
    </g>
  );
}

let turning: { index: number; angle: number; turn: number } | null = null;
/** The angle of the pointer around the object turns it by as much. */
function turnTo(index: number, l: Lens, e: PointerEvent): void {
  const s = app.scene.value!, object = s.objects[index]!, k = s.room.curvature;
  const p = pointAtHeight(s, l.eye, rayAt(l, e.clientX, e.clientY), object.at[3]!);
  if (!p) return;
  const [x, y] = g.logMap(k, g.apply(g.inverse(k, frameAt(k, object.at)), p));
  const angle = (Math.atan2(y, x) * 180) / Math.PI;
  const textPath = [...app.objectPath(index), 'turn'];
  if (!turning || turning.index !== index || e.buttons === 0) turning = { index, angle, turn: parseFloat(getScalar(app.text.value, textPath) ?? '0') || 0 };
  const turned = (((turning.turn + angle - turning.angle) % 360) + 360) % 360;
  app.changeWhileDragging(textPath, `${Math.round(turned)}deg`);
  app.onceDragEnds(() => (turning = null));
}

/** The height at which the pointer's ray passes the object's axis. */
function liftTo(index: number, l: Lens, e: PointerEvent): void {
  const s = app.scene.value!, object = s.objects[index]!, k = s.room.curvature;
  const ray = rayAt(l, e.clientX, e.clientY);
  const [x, y] = g.logMap(k, g.apply(g.inverse(k, l.eye.roomFromEye), object.at));
  const there = l.eye.z + (Math.hypot(x, y) * ray[2]) / Math.max(1e-6, Math.hypot(ray[0], ray[1]));
  const z = Math.max(0, Math.min(s.room.height, there - (object.top + 0.05 - object.at[3]!)));
  app.document_.drag((held) => {
    const [px, py] = g.logMap(k, object.at);
    const at = `{polar: [${written(Math.hypot(px, py))}, ${Number(((((Math.atan2(py, px) * 180) / Math.PI + 360) % 360)).toFixed(1))}deg]${z < 0.004 ? '' : `, z: ${written(Number(z.toFixed(3)))}`}}`;
    return set(held, [...app.objectPath(index), 'at'], at);
  });
}

function LampMarks({ index, l }: { index: number; l: Lens }) {
  const lamp = app.scene.value!.lamps[index]!;
  const project = projection(l);
  const at = project(lamp.at, lamp.at[3]!);
  const mast = [...Array(9).keys()].map((i) => project(lamp.at, (lamp.at[3]! * i) / 8));
  return (
    <g>
      <Line d={path(mast)} kind="mast" />
      <Line d={path(circle(lamp.at, 0.04, app.scene.value!.room.curvature).map((p) => project(p, 0)))} />
      {at && <circle class="lamp" cx={at[0]} cy={at[1]} r="16" />}
    </g>
  );
}

function WallMarks({ index, l }: { index: number; l: Lens }) {
  const { room } = app.scene.value!, wall = room.walls[index]!;
  const k = room.curvature, project = projection(l);
  const along = (t: number): g.Vector => {
    const p = wall.start.map((x, c) => g.cosK(k, wall.length * t) * x + g.sinK(k, wall.length * t) * wall.along[c]!) as g.Vector;
    if (k === 0) p[0] = 1;
    return p;
  };
  const steps = [...Array(33).keys()].map((i) => 0.004 + (0.992 * i) / 32);
  const bottom = steps.map((t) => project(along(t), 0)), top = steps.map((t) => project(along(t), room.height));
  const whole = bottom.every(Boolean) && top.every(Boolean);
  const outline = whole ? path([...bottom, ...top.reverse(), bottom[0]!]) : path(bottom) + path(top);
  const middle = project(along(0.5), 0);
  const color = wallColor(index);
  return (
    <g>
      <path class="halo" d={outline} style={{ strokeWidth: 6 }} />
      <path d={outline} style={{ fill: whole ? color : 'none', fillOpacity: 0.1, stroke: color, strokeWidth: 3, strokeLinejoin: 'round' }} />
      {middle && (
        <g transform={`translate(${middle[0]} ${middle[1]})`}>
          <rect x="-13" y="-13" width="26" height="26" rx="5" style={{ fill: color, stroke: '#0c0e12', strokeWidth: 1.5 }} />
          <text class="chip-number">{index + 1}</text>
        </g>
      )}
    </g>
  );
}
