import type { CopiesReply, SceneReply } from '../state/reply';
import * as g from './geometry';

/** An image of the room: room coordinates to the universal cover, in which the room itself is one. */
export interface Copy {
  coverFromRoom: g.Matrix;
  word: number[];
  weight: [number, number, number];
  sheet: number;
  /** Mirrors between the eye and the copy. */
  met: number;
  reversing: boolean;
}

const one: [number, number, number] = [1, 1, 1];

/** What kind of walls a room has, which decides how it is drawn. */
export interface WallKinds {
  mirrorsPerWall: number;
  /** Some wall is not all one mirror. */
  partial: boolean;
  /** The copies that the group gives are not those that the eye sees as wholes: mirrors differ, or are parts of walls, or an angle is no
   *  π/k. Then pixels carry the word of their path. */
  coded: boolean;
}

export function wallKinds(scene: SceneReply): WallKinds {
  const { room, shell } = scene;
  let most = 1, partial = false, differ = false;
  const first = shell.walls[0]?.mirrors[0]?.throughput;
  shell.walls.forEach((wall, i) => {
    most = Math.max(most, wall.mirrors.length);
    const mirror = wall.mirrors[0];
    const length = room.walls[i]!.length;
    const whole =
      wall.mirrors.length === 1 && mirror!.span[0]! <= 1e-9 && mirror!.span[1]! >= length - 1e-9 && mirror!.height[0]! <= 1e-9 && mirror!.height[1]! >= room.height - 1e-9;
    if (!whole) partial = true;
    if (mirror && first && mirror.throughput.some((x, c) => Math.abs(x - first[c]!) > 1e-9)) differ = true;
  });
  return { mirrorsPerWall: most, partial, coded: (partial || differ || scene.orbifold.real) && room.walls.length <= 15 };
}

/** The copies that the group gives, with the weight of their mirrors. */
export function groupCopies(scene: SceneReply, reply: CopiesReply): Copy[] {
  const shares = scene.shell.walls.map((wall) => wall.mirrors[0]?.throughput ?? [0, 0, 0]);
  const copies: Copy[] = [];
  let at = 0;
  reply.lengths.forEach((length, i) => {
    const word = [...reply.words.subarray(at, at + length)];
    at += length;
    const weight: [number, number, number] = [...one];
    for (const wall of word) for (let c = 0; c < 3; ++c) weight[c]! *= shares[wall]![c]!;
    const coverFromRoom = [...reply.matrices.subarray(9 * i, 9 * i + 9)];
    copies.push({ coverFromRoom, word, weight, sheet: 0, met: length, reversing: length % 2 === 1 });
  });
  return scene.room.curvature > 0 && reply.whole ? withSheets(scene, copies) : copies;
}

/** S²: copies are seen again after each half turn. A great circle meets every mirror twice, and the longest word meets each once: so a copy
 *  seen the other way round lies behind twice that many mirrors, less its own. */
function withSheets(scene: SceneReply, copies: Copy[]): Copy[] {
  const mirrors = Math.max(...copies.map((copy) => copy.word.length));
  const share = scene.shell.walls[0]?.mirrors[0]?.throughput ?? [0, 0, 0];
  const all: Copy[] = [];
  for (const copy of copies)
    for (let sheet = 0; sheet < 6; ++sheet) {
      const turns = 2 * mirrors * Math.floor((sheet + 1) / 2);
      const met = sheet % 2 === 0 ? turns + copy.word.length : turns - copy.word.length;
      if (met > scene.cover.max_bounces || mirrors === 0) continue;
      const weight = share.map((x) => x ** met) as [number, number, number];
      all.push({ ...copy, sheet, met, weight });
    }
  return all.length > 0 ? all : copies;
}

/** The beams of an eye: words of walls that some ray from the eye crosses in turn, wherever mirrors end. Recursion over the walls with the
 *  interval of bearings that still sees them. Words longer than 16 letters have no code. */
export function beams(scene: SceneReply, eye: ArrayLike<number>, bounces: number, most: number): Copy[] {
  const { room, shell } = scene;
  const k = room.curvature;
  const shares = shell.walls.map((wall) => wall.mirrors.map((m) => m.throughput));
  const reflections = room.walls.map((wall) => g.reflection(k, wall.line));
  const ends = room.walls.map((wall, i) => {
    const next = room.walls[(i + 1) % room.walls.length]!;
    return [wall.start, next.start] as const;
  });
  const eyeFromRoom = g.inverse(k, eye);
  const copies: Copy[] = [];
  // The bearing of a point of the border after the previous one, so that walls of more than half a turn are whole.
  const bearing = (m: g.Matrix, p: ArrayLike<number>): number => {
    const e = g.apply(m, p);
    return Math.atan2(e[2], e[1]);
  };
  type Beam = { map: g.Matrix; word: number[]; from: number; to: number; weight: [number, number, number]};
  let level: Beam[] = [{ map: g.identity(), word: [], from: -Infinity, to: Infinity, weight: [...one] }];
  for (let depth = 0; depth <= Math.min(16, bounces) && level.length > 0; ++depth) {
    const next: Beam[] = [];
    for (const beam of level) {
      const toEye = g.multiply(eyeFromRoom, beam.map);
      const sheets = k > 0 ? [0, 1] : [0];
      for (const sheet of sheets)
        copies.push({ coverFromRoom: beam.map, word: beam.word, weight: beam.weight, sheet, met: beam.word.length, reversing: beam.word.length % 2 === 1 });
      if (copies.length > most) return copies;
      if (depth === Math.min(16, bounces)) continue;
      room.walls.forEach((_, i) => {
        if (beam.word.length > 0 && beam.word[beam.word.length - 1] === i) return;
        if (shares[i]!.length === 0) return;
        let a = bearing(toEye, ends[i]![0]), b = bearing(toEye, ends[i]![1]);
        if (room.corners.length < 2) (a = -Math.PI), (b = Math.PI);
        if (beam.word.length % 2 === 1) [a, b] = [b, a];
        let from: number, to: number;
        if (beam.from === -Infinity) {
          if (b < a) b += 2 * Math.PI;
          (from = a), (to = b);
        } else {
          const mid = (beam.from + beam.to) / 2;
          let width = b - a;
          width -= 2 * Math.PI * Math.floor(width / (2 * Math.PI));
          let begin = a;
          begin += 2 * Math.PI * Math.round((mid - (begin + width / 2)) / (2 * Math.PI));
          from = Math.max(beam.from, begin);
          to = Math.min(beam.to, begin + width);
          if (k > 0) {
            // Past the antipode left and right change places; the path code alone decides there.
            from = beam.from;
            to = beam.to;
          }
        }
        if (to - from < 1e-9) return;
        const share = shares[i]![0]!;
        const weight = beam.weight.map((x, c) => x * share[c]!) as [number, number, number];
        if (Math.max(...weight) < Math.max(scene.cover.min_weight, 0.002)) return;
        next.push({ map: g.multiply(beam.map, reflections[i]!), word: [...beam.word, i], from, to, weight });
      });
    }
    level = next;
  }
  return copies;
}

/** The code of a word and the mask of its letters, as march.glsl writes them. */
export function codeOf(word: number[]): [number, number, number, number] {
  const code = [0, 0, 0, 0];
  word.forEach((wall, i) => {
    const half = i < 8 ? 0 : 1, shift = 4 * (i % 8);
    code[half]! |= (wall + 1) << shift;
    code[2 + half]! |= 15 << shift;
  });
  return code.map((x) => x >>> 0) as [number, number, number, number];
}
