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

export function moveObject(index: number, to: g.Vector, kind: 'object' | 'lamp' = 'object'): void {
  app.dragging.value = true;
  const path = kind === 'object' ? app.objectPath(index) : app.lampPath(index);
  app.document_.drag((held) => set(held, [...path, 'at'], placeText(held, path, to)));
}
