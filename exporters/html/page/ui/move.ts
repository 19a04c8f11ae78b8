/** Objects by hand: a place on the floor becomes the polar coordinates of the text, as one line that changes while the pointer moves. */
import * as g from '../room/geometry';
import * as app from '../state/app';
import { get, set, written, type Path } from '../state/splice';

/** `at: {polar: [r, φ]}`, with the height that the text has. */
export function placeText(held: string, path: Path, to: ArrayLike<number>): string {
  const k = app.scene.value!.room.curvature;
  const [x, y] = g.logMap(k, to);
  const r = Math.hypot(x, y);
  const angle = ((Math.atan2(y, x) * 180) / Math.PI + 360) % 360;
  const z = get(held, [...path, 'at', 'z']);
  const floor = r < 5e-4 ? 'centre' : `{polar: [${written(r)}, ${Number(angle.toFixed(1))}deg]${z === undefined ? '' : `, z: ${z}`}}`;
  return floor === 'centre' ? (z === undefined ? 'centre' : `{polar: [0, 0deg], z: ${z}}`) : floor;
}

const near = 0.025; // of an axis or the centre: there a dragged thing snaps

/** Snaps a place to the centre, or to the axes of corners and of middles of walls. */
function snap(to: g.Vector): g.Vector {
  const { room } = app.scene.value!, k = room.curvature;
  const [x, y] = g.logMap(k, to), r = Math.hypot(x, y);
  app.snapped.value = null;
  if (r < near) {
    app.snapped.value = { words: 'at the centre', line: [] };
    return [1, 0, 0];
  }
  const axes = [
    ...room.corners.map((c, i) => ({ words: `on the axis of corner ${i + 1}`, end: g.logMap(k, c) })),
    ...room.walls.map((w, i) => ({ words: `on the axis of wall ${i + 1}`, end: g.logMap(k, foot(k, w.line)) })),
  ];
  for (const { words, end } of axes) {
    const size = Math.hypot(...end);
    if (!(size > 1e-6) || !Number.isFinite(size)) continue;
    const [ux, uy] = [end[0] / size, end[1] / size];
    const along = x * ux + y * uy, aside = Math.abs(x * uy - y * ux);
    if (along <= near || aside > near * 0.6) continue;
    app.snapped.value = { words, line: [...Array(13).keys()].map((i) => g.expMap(k, (end[0] * i) / 12, (end[1] * i) / 12)) };
    return g.expMap(k, along * ux, along * uy);
  }
  return to;
}

/** The point of a line nearest to the centre. */
function foot(k: number, line: ArrayLike<number>): g.Vector {
  const n = Math.hypot(line[1]!, line[2]!);
  const d = -g.asinK(k, line[0]!);
  return g.expMap(k, (d * line[1]!) / n, (d * line[2]!) / n);
}

/** Moves a thing while it is dragged; `free`: it does not snap. */
export function moveObject(index: number, to: g.Vector, free = false, kind: 'object' | 'lamp' = 'object'): void {
  const s = app.scene.value!;
  if (!app.dragging.value) app.dragStart.value = [...(kind === 'object' ? s.objects : s.lamps)[index]!.at];
  app.dragging.value = true;
  const place = free ? to : snap(to);
  if (free) app.snapped.value = null;
  app.draggedTo.value = place;
  const path = kind === 'object' ? app.objectPath(index) : app.lampPath(index);
  app.document_.drag((held) => set(held, [...path, 'at'], placeText(held, path, place)));
}
