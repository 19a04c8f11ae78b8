/** The page's words and numbers. */
import type { Orbifold } from '../state/reply';

const glyphs: Record<string, string> = { '1/2': '½', '1/3': '⅓', '2/3': '⅔', '1/4': '¼', '3/4': '¾', '1/5': '⅕', '2/5': '⅖', '3/5': '⅗', '4/5': '⅘', '1/6': '⅙', '5/6': '⅚', '1/8': '⅛', '3/8': '⅜', '5/8': '⅝', '7/8': '⅞' };

/** A fraction to twelfths as it is printed, else four figures. */
export function fraction(text: string): string {
  const minus = text.startsWith('-') ? '−' : '';
  const plain = text.replace(/^-/, '');
  if (glyphs[plain]) return minus + glyphs[plain];
  const [a, b] = plain.split('/').map(Number) as [number, number | undefined];
  if (b === undefined) return minus + plain;
  if (b <= 12 && a > b && glyphs[`${a % b}/${b}`]) return `${minus}${Math.floor(a / b)}${glyphs[`${a % b}/${b}`]}`;
  if (b <= 12) return `${minus}${a}/${b}`;
  return minus + (a / b).toPrecision(4).replace(/\.?0+$/, '');
}
export const spaceNames = { spherical: 'S²×R', euclidean: 'E²×R', hyperbolic: 'H²×R', none: '—' } as const;
export const spaceWords = { spherical: 'spherical', euclidean: 'flat', hyperbolic: 'hyperbolic', none: 'none' } as const;

/** χ as the sum over the corners, as far as it is short: "1 − 5 · ½(1 − ½)". */
export function chiSum(o: Orbifold): string {
  if (o.strip || o.orders.length === 0) return '';
  const groups = new Map<string, number>();
  for (const k of o.orders) groups.set(k, (groups.get(k) ?? 0) + 1);
  if (groups.size > 3) return `1 − Σ ½(1 − 1/k)`;
  const share = (k: string) => fraction(/^\d+$/.test(k) ? `1/${k}` : k.includes('/') ? k.split('/').reverse().join('/') : String(1 / Number(k)));
  return '1' + [...groups].map(([k, n]) => ` − ${n > 1 ? `${n} · ` : ''}½(1 − ${share(k)})`).join('');
}
/** The angle π/k in degrees. */
export function angleOf(order: string): string {
  const [a, b = 1] = order.split('/').map(Number) as [number, number?];
  const degrees = (180 * b) / a;
  return `${Number(degrees.toFixed(degrees % 1 ? 1 : 0))}°`;
}
export const upperFirst = (text: string): string => text.charAt(0).toUpperCase() + text.slice(1);
export const wallColors = ['#ff9d2e', '#5e84ff', '#f7f39a', '#b48cc6', '#22dfae', '#f4535a'];
export const wallColor = (i: number): string => wallColors[i % 6]!;
export function hexOf(color: number[]): string {
  const encode = (c: number) => {
    const x = c <= 0.0031308 ? 12.92 * c : 1.055 * c ** (1 / 2.4) - 0.055;
    return Math.round(255 * Math.min(1, Math.max(0, x))).toString(16).padStart(2, '0');
  };
  return '#' + color.map(encode).join('');
}
