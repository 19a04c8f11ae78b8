/** Where things of the room lie on the screen. The lens, not the layout, moves: the principal point lies in the middle of what the plates
 *  leave free. */
import * as app from '../state/app';
import { axes, type Eye } from './eye';
import * as g from './geometry';

export interface Lens {
  eye: Eye;
  /** Horizontal field of view, radians. */
  fov: number;
  /** The principal point, as a share of half the picture to the right and up. */
  shift: [number, number];
}

/** The lens of the page as it is now; there must be a scene. */
export function lens(): Lens {
  const s = app.scene.value!;
  const design = app.mode.value === 'design' && innerHeight > 480;
  const rem = app.projector.value ? 1.5 : 1;
  const left = design ? 328 * rem : app.projector.value ? 480 : 0, right = design ? (app.tab.value === 'text' ? 504 : 344) * rem : 0;
  const shift = innerWidth > left + right + 200 ? (left - right) / innerWidth : 0;
  // The field of view belongs to the picture's shape in the file; of other shapes the smaller side counts.
  const aspect = innerWidth / innerHeight, wanted = s.eye.size[0]! / s.eye.size[1]!;
  const t = Math.tan(Math.min(2.6, s.eye.fov) / 2);
  const fov = 2 * Math.atan(aspect > wanted ? Math.min(t * (aspect / wanted), t * 1.35) : t * Math.max(0.62, aspect / wanted));
  return { eye: app.eye.value!, fov, shift: [shift, 0] };
}

/** The direction of the eye, in its coordinates, that a point of the screen shows. */
export function rayAt(l: Lens, x: number, y: number): g.Vector {
  const t = Math.tan(l.fov / 2), a = axes(l.eye);
  const across = ((2 * x) / innerWidth - 1 - l.shift[0]) * t;
  const up = ((1 - (2 * y) / innerHeight - l.shift[1]) * t * innerHeight) / innerWidth;
  return [0, 1, 2].map((i) => a.forward[i]! + across * a.right[i]! + up * a.up[i]!) as g.Vector;
}

/** Maps points of the floor, with a height, to the screen, in pixels; null behind the eye. `cover` is the image of the room that is meant. */
export function projection(l: Lens, cover: g.Matrix = g.identity()): (p: ArrayLike<number>, z: number) => [number, number] | null {
  const k = app.scene.value!.room.curvature;
  const map = g.multiply(g.inverse(k, l.eye.roomFromEye), cover), a = axes(l.eye), t = Math.tan(l.fov / 2);
  const dot = (u: ArrayLike<number>, v: ArrayLike<number>) => u[0]! * v[0]! + u[1]! * v[1]! + u[2]! * v[2]!;
  return (p, z) => {
    const [x, y] = g.logMap(k, g.apply(map, p));
    const q = [x, y, z - l.eye.z];
    const depth = dot(q, a.forward);
    if (!(depth > 0.02)) return null;
    const sx = dot(q, a.right) / (t * depth) + l.shift[0], sy = (dot(q, a.up) * innerWidth) / (t * depth * innerHeight) + l.shift[1];
    return [((1 + sx) / 2) * innerWidth, ((1 - sy) / 2) * innerHeight];
  };
}
