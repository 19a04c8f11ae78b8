/** What a ray of the eye meets: objects stand for the cylinders around them, and mirrors are followed. */
import type { SceneReply } from '../state/reply';
import type { Eye } from './eye';
import * as g from './geometry';

export interface Picked {
  object: number;
  /** The wall that the ray meets first, or -1. */
  wall: number;
  word: number[];
  distance: number;
}

const bounces = 4;

export function pick(scene: SceneReply, eye: Eye, ray: g.Vector): Picked {
  const { room } = scene;
  const k = room.curvature;
  const level = Math.hypot(ray[0], ray[1]) || 1e-9, slope = ray[2] / level;
  let p = g.column(eye.roomFromEye, 0);
  const e1 = g.column(eye.roomFromEye, 1), e2 = g.column(eye.roomFromEye, 2);
  let v = [0, 1, 2].map((i) => (ray[0] * e1[i]! + ray[1] * e2[i]!) / level) as g.Vector;
  let z = eye.z, gone = 0;
  const word: number[] = [];
  let first = -1;
  for (let n = 0; n <= bounces; ++n) {
    let best = k > 0 ? -1e30 : k < 0 ? 1 : 1e-9, hit = -1;
    room.walls.forEach((wall, i) => {
      const t = -g.valueAt(wall.line, v) / Math.max(1e-9, g.valueAt(wall.line, p));
      if (t > best) (best = t), (hit = i);
    });
    const toWall = hit < 0 ? 1e9 : k > 0 ? Math.atan2(1, best) : k < 0 ? 0.5 * Math.log((best + 1) / (best - 1)) : 1 / best;
    const toFlat = slope > 0 ? (room.height - z) / slope : z / Math.max(1e-9, -slope);
    const s = Math.min(toWall, toFlat);
    const object = nearestObject(scene, p, v, z, slope, s);
    if (object) return { object: object.index, wall: first, word, distance: (gone + object.at) * Math.hypot(1, slope) };
    if (toFlat <= toWall || hit < 0) return { object: -1, wall: first, word, distance: gone + s };
    if (first < 0) first = hit;
    const line = room.walls[hit]!.line;
    if (scene.shell.walls[hit]!.mirrors.length === 0) break;
    const c = g.cosK(k, s), sn = g.sinK(k, s);
    const q = p.map((x, i) => c * x + sn * v[i]!) as g.Vector;
    v = v.map((x, i) => c * x - k * sn * p[i]!) as g.Vector;
    p = q;
    const r = g.reflection(k, line);
    v = g.apply(r, v);
    z += slope * s;
    gone += s;
    word.push(hit);
  }
  return { object: -1, wall: first, word, distance: gone };
}

function nearestObject(scene: SceneReply, p: g.Vector, v: g.Vector, z: number, slope: number, end: number): { index: number; at: number } | null {
  const k = scene.room.curvature;
  let found: { index: number; at: number } | null = null;
  scene.objects.forEach((object, index) => {
    if (object.shape === 'beam') return;
    // The nearest point of the ray to the object's axis.
    const a = k === 0 ? (object.at[1]! - p[1]) * v[1] + (object.at[2]! - p[2]) * v[2] : 0;
    const along = k === 0 ? a : g.inner(k, object.at, v), towards = k === 0 ? 1 : k * g.inner(k, object.at, p);
    const s = k === 0 ? along : k > 0 ? Math.atan2(along, towards) : Math.atanh(Math.max(-0.999999, Math.min(0.999999, along / towards)));
    if (s <= 0 || s > end) return;
    const q = p.map((x, i) => g.cosK(k, s) * x + g.sinK(k, s) * v[i]!) as g.Vector;
    const d = k === 0 ? Math.hypot(q[1] - object.at[1]!, q[2] - object.at[2]!) : Math.hypot(...g.diskFromPoint(k, g.apply(g.inverse(k, frameAt(k, object.at)), q))) * 2;
    const there = z + slope * s;
    if (d <= object.extent * 1.02 && there >= object.at[3]! - 0.01 && there <= object.top + 0.01 && (!found || s < found.at)) found = { index, at: s };
  });
  return found;
}

/** The translation that takes the centre to a point of the floor. */
export function frameAt(k: number, at: ArrayLike<number>): g.Matrix {
  const [x, y] = g.logMap(k, at);
  return g.translation(k, x, y);
}

/** The point of the floor below the point where the ray reaches a height; null if it does not before it meets a wall. */
export function pointAtHeight(scene: SceneReply, eye: Eye, ray: g.Vector, height: number): g.Vector | null {
  const k = scene.room.curvature;
  const level = Math.hypot(ray[0], ray[1]) || 1e-9, slope = ray[2] / level;
  const s = (height - eye.z) / slope;
  if (!(s > 0) || s > 6) return null;
  const p = g.column(eye.roomFromEye, 0), e1 = g.column(eye.roomFromEye, 1), e2 = g.column(eye.roomFromEye, 2);
  return [0, 1, 2].map((i) => g.cosK(k, s) * p[i]! + (g.sinK(k, s) * (ray[0] * e1[i]! + ray[1] * e2[i]!)) / level) as g.Vector;
}
