/** Points of the floor are ambient vectors [w, x, y] with w² + κ(x² + y²) = 1; isometries are 3×3 matrices on them, row by row, in double. */
export type Vector = [number, number, number];
export type Matrix = number[];

export const identity = (): Matrix => [1, 0, 0, 0, 1, 0, 0, 0, 1];

export function multiply(a: ArrayLike<number>, b: ArrayLike<number>): Matrix {
  const c = new Array<number>(9);
  for (let i = 0; i < 3; ++i)
    for (let j = 0; j < 3; ++j) c[3 * i + j] = a[3 * i]! * b[j]! + a[3 * i + 1]! * b[3 + j]! + a[3 * i + 2]! * b[6 + j]!;
  return c;
}
export function apply(m: ArrayLike<number>, v: ArrayLike<number>): Vector {
  return [0, 3, 6].map((i) => m[i]! * v[0]! + m[i + 1]! * v[1]! + m[i + 2]! * v[2]!) as Vector;
}
export const column = (m: ArrayLike<number>, j: number): Vector => [m[j]!, m[3 + j]!, m[6 + j]!];
export const determinant = (m: Matrix): number =>
  m[0]! * (m[4]! * m[8]! - m[5]! * m[7]!) - m[1]! * (m[3]! * m[8]! - m[5]! * m[6]!) + m[2]! * (m[3]! * m[7]! - m[4]! * m[6]!);

/** The inverse of an isometry: the transpose, with the signs of the form (κ = ±1); E²: of a rigid motion. */
export function inverse(k: number, m: ArrayLike<number>): Matrix {
  if (k === 0) {
    const [a, b, c, d] = [m[4]!, m[5]!, m[7]!, m[8]!];
    const x = m[3]!, y = m[6]!;
    return [1, 0, 0, -(a * x + c * y), a, c, -(b * x + d * y), b, d];
  }
  return [m[0]!, k * m[3]!, k * m[6]!, k * m[1]!, m[4]!, m[7]!, k * m[2]!, m[5]!, m[8]!];
}

export const inner = (k: number, a: ArrayLike<number>, b: ArrayLike<number>): number => k * a[0]! * b[0]! + a[1]! * b[1]! + a[2]! * b[2]!;
export const valueAt = (line: ArrayLike<number>, p: ArrayLike<number>): number => line[0]! * p[0]! + line[1]! * p[1]! + line[2]! * p[2]!;
export const cosK = (k: number, s: number): number => (k > 0 ? Math.cos(s) : k < 0 ? Math.cosh(s) : 1);
export const sinK = (k: number, s: number): number => (k > 0 ? Math.sin(s) : k < 0 ? Math.sinh(s) : s);
/** The length of the point (w, ρ) = (cosκ r, sinκ r). */
export const arcK = (k: number, w: number, rho: number): number => (k > 0 ? Math.atan2(rho, w) : k < 0 ? Math.asinh(rho) : rho);
export const asinK = (k: number, v: number): number => (k > 0 ? Math.asin(Math.min(1, Math.max(-1, v))) : k < 0 ? Math.asinh(v) : v);
export const atanK = (k: number, v: number): number => (k > 0 ? Math.atan(v) : k < 0 ? Math.atanh(v) : v);

/** The translation along the geodesic through the origin in the direction (x, y), by its length. */
export function translation(k: number, x: number, y: number): Matrix {
  const d = Math.hypot(x, y);
  if (d === 0) return identity();
  const ux = x / d, uy = y / d, c = cosK(k, d), s = sinK(k, d);
  return [c, -k * s * ux, -k * s * uy, s * ux, 1 + (c - 1) * ux * ux, (c - 1) * ux * uy, s * uy, (c - 1) * ux * uy, 1 + (c - 1) * uy * uy];
}
export function rotation(angle: number): Matrix {
  const c = Math.cos(angle), s = Math.sin(angle);
  return [1, 0, 0, 0, c, -s, 0, s, c];
}
/** The reflection in a line: X ↦ X − 2 l(X) N. */
export function reflection(k: number, line: ArrayLike<number>): Matrix {
  const n = [k * line[0]!, line[1]!, line[2]!];
  const m = identity();
  for (let i = 0; i < 3; ++i) for (let j = 0; j < 3; ++j) m[3 * i + j]! -= 2 * n[i]! * line[j]!;
  return m;
}
/** The vector of the log map at the origin: distances and directions from there are true. */
export function logMap(k: number, p: ArrayLike<number>): [number, number] {
  const rho = Math.hypot(p[1]!, p[2]!);
  const f = rho < 1e-12 ? 1 : arcK(k, p[0]!, rho) / rho;
  return [f * p[1]!, f * p[2]!];
}
export function expMap(k: number, x: number, y: number): Vector {
  const d = Math.hypot(x, y);
  const f = d < 1e-12 ? 1 : sinK(k, d) / d;
  return [cosK(k, d), f * x, f * y];
}
export const diskFromPoint = (k: number, p: ArrayLike<number>): [number, number] => (k === 0 ? [p[1]!, p[2]!] : [p[1]! / (1 + p[0]!), p[2]! / (1 + p[0]!)]);
export function pointFromDisk(k: number, x: number, y: number): Vector {
  if (k === 0) return [1, x, y];
  const q = k * (x * x + y * y);
  return [(1 - q) / (1 + q), (2 * x) / (1 + q), (2 * y) / (1 + q)];
}
/** Restores an isometry that products of many factors have worn: its first column becomes a point, the others unit tangents there. */
export function renormalised(k: number, m: Matrix): Matrix {
  const p = column(m, 0);
  if (k > 0) {
    const n = Math.hypot(...p);
    for (let i = 0; i < 3; ++i) p[i]! /= n;
  } else if (k < 0) p[0] = Math.sqrt(1 + p[1] ** 2 + p[2] ** 2);
  else p[0] = 1;
  const tangent = (v: Vector, others: Vector[]): Vector => {
    if (k === 0) v[0] = 0;
    else {
      const f = k * inner(k, v, p);
      for (let i = 0; i < 3; ++i) v[i]! -= f * p[i]!;
    }
    for (const o of others) {
      const c = inner(k, v, o);
      for (let i = 0; i < 3; ++i) v[i]! -= c * o[i]!;
    }
    const n = Math.sqrt(inner(k, v, v));
    return v.map((x) => x / n) as Vector;
  };
  const a = tangent(column(m, 1), []), b = tangent(column(m, 2), [a]);
  return [p[0], a[0], b[0], p[1], a[1], b[1], p[2], a[2], b[2]];
}
