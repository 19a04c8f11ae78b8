import type { RoomReply, SceneReply } from '../state/reply';
import * as g from './geometry';

/** The eye: an isometry, the direction it looks in, its height. Walking multiplies a translation from the right, which transports the eye's
 *  frame along the path: what the compass shows is the holonomy of the walk. */
export interface Eye {
  roomFromEye: g.Matrix;
  yaw: number;
  pitch: number;
  z: number;
  /** The isometry of the mirrors that the eye has stepped through. */
  mirrored: number;
}

export function eyeOfScene(scene: SceneReply): Eye {
  const f = scene.eye.forward;
  return {
    roomFromEye: [...scene.eye.room_from_eye],
    yaw: Math.atan2(f[1]!, f[0]!),
    pitch: Math.asin(Math.min(1, Math.max(-1, f[2]!))),
    z: scene.eye.z,
    mirrored: 0,
  };
}

/** forward, right and up in eye coordinates. */
export function axes(eye: Eye): { forward: g.Vector; right: g.Vector; up: g.Vector } {
  const c = Math.cos(eye.yaw), s = Math.sin(eye.yaw), cp = Math.cos(eye.pitch), sp = Math.sin(eye.pitch);
  return { forward: [c * cp, s * cp, sp], right: [s, -c, 0], up: [-c * sp, -s * sp, cp] };
}

/** The eye as the core takes it (core.h): 19 numbers. */
export function eyeNumbers(eye: Eye): number[] {
  const a = axes(eye);
  return [...eye.roomFromEye, eye.z, ...a.forward, ...a.right, ...a.up];
}

const margin = 0.03; // how near to a wall, floor or ceiling the eye comes

/** Steps `ahead` and `aside` (to the right), as lengths. At a wall the eye slides along it; or it steps through a mirror, and the room flips. */
export function step(eye: Eye, room: RoomReply, ahead: number, aside: number, throughMirrors: boolean): Eye {
  const k = room.curvature;
  const c = Math.cos(eye.yaw), s = Math.sin(eye.yaw);
  let x = ahead * c + aside * s, y = ahead * s - aside * c;
  let moved = eye.roomFromEye;
  let mirrored = eye.mirrored;
  for (let tries = 0; tries < 4; ++tries) {
    const next = g.multiply(moved, g.translation(k, x, y));
    const at = g.column(next, 0);
    let worst = -1, depth = Infinity;
    room.walls.forEach((wall, i) => {
      const d = g.asinK(k, g.valueAt(wall.line, at)) - (throughMirrors && wall.reflects ? 0 : margin);
      if (d < 0 && d < depth) (worst = i), (depth = d);
    });
    if (worst < 0) {
      moved = next;
      break;
    }
    const wall = room.walls[worst]!;
    if (throughMirrors && wall.reflects) {
      moved = g.multiply(g.reflection(k, wall.line), next);
      ++mirrored;
      break;
    }
    // The part of the step towards the wall is taken away. The wall's gradient at the eye, in the eye's frame:
    const before = g.column(moved, 0);
    const n = [k * wall.line[0]!, wall.line[1]!, wall.line[2]!];
    const e1 = g.column(moved, 1), e2 = g.column(moved, 2);
    let nx = g.inner(k, n, e1), ny = g.inner(k, n, e2);
    const size = Math.hypot(nx, ny) || 1;
    nx /= size;
    ny /= size;
    const room_ahead = g.asinK(k, g.valueAt(wall.line, before)) - margin;
    const towards = -(x * nx + y * ny);
    const cut = towards - Math.max(0, Math.min(towards, room_ahead * 0.98));
    if (cut <= 1e-9) {
      // The eye stands too near already: it may go along the wall, and away from it.
      if (tries > 1) break;
      x += 0.002 * nx;
      y += 0.002 * ny;
      continue;
    }
    x += cut * nx;
    y += cut * ny;
  }
  return { ...eye, roomFromEye: g.renormalised(k, moved), mirrored };
}

export function lift(eye: Eye, room: RoomReply, dz: number): Eye {
  return { ...eye, z: Math.min(room.height - margin, Math.max(margin, eye.z + dz)) };
}

/** Whether the eye is in the room, away from its walls. */
export function stands(eye: Eye, room: RoomReply): boolean {
  const at = g.column(eye.roomFromEye, 0);
  return eye.z > 0 && eye.z < room.height && room.walls.every((wall) => g.valueAt(wall.line, at) > 1e-6) && at.every(Number.isFinite);
}
