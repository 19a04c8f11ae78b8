/** The tiling of the disk: every pixel is folded home by the reflections of the room, and colored by their number. */
import type { RoomReply } from '../state/reply';
import * as g from '../room/geometry';

/** How far the disk reaches in the chart: all of H², as much of E² and S² as shows the room with neighbours. */
export function reachOf(room: RoomReply): number {
  if (room.curvature < 0) return 1;
  const far = Math.max(...room.corners.map((c) => Math.hypot(...g.diskFromPoint(room.curvature, c))), room.inradius, 0.2);
  return room.curvature === 0 ? 3.2 * far : Math.max(1.8, 1.6 * far);
}

const colors = { dark: [34, 42, 52], light: [50, 61, 75], room: [61, 49, 38], line: [12, 14, 18] } as const;

export function drawTiling(canvas: HTMLCanvasElement, room: RoomReply): void {
  const context = canvas.getContext('2d');
  if (!context) return;
  const size = canvas.width;
  const image = context.createImageData(size, size);
  const k = room.curvature, reach = reachOf(room);
  const mirrors = room.walls.filter((w) => w.reflects);
  const n = mirrors.length;
  const L = new Float64Array(3 * n), N = new Float64Array(3 * n);
  mirrors.forEach((w, i) => {
    L.set(w.line, 3 * i);
    N.set([k * w.line[0]!, w.line[1]!, w.line[2]!], 3 * i);
  });
  const out = [0, 0, 0];
  const pixel = (2 * reach) / size;
  const plainWalls = room.walls.filter((w) => !w.reflects);
  for (let py = 0; py < size; ++py)
    for (let px = 0; px < size; ++px) {
      out[0] = out[1] = out[2] = 0;
      let alpha = 0;
      const x = ((px + 0.5) / size * 2 - 1) * reach, y = (1 - (py + 0.5) / size * 2) * reach;
      const r2 = x * x + y * y;
      const edge = (reach - Math.sqrt(r2)) / pixel;
      if (edge > 0) {
        alpha = Math.min(1, edge);
        let w: number, a: number, b: number;
        if (k === 0) (w = 1), (a = x), (b = y);
        else {
          const q = k * r2;
          (w = (1 - q) / (1 + q)), (a = (2 * x) / (1 + q)), (b = (2 * y) / (1 + q));
        }
        const scale = k === 0 ? 1 : (1 + w) / 2 || 1e-3; // of lengths in the chart
        let folds = 0, nearest = Infinity;
        for (; folds < 60; ++folds) {
          let worst = -1, low = -1e-12;
          nearest = Infinity;
          for (let i = 0; i < n; ++i) {
            const v = L[3 * i]! * w + L[3 * i + 1]! * a + L[3 * i + 2]! * b;
            if (v < low) (low = v), (worst = i);
            if (v < nearest) nearest = v;
          }
          if (worst < 0) break;
          w -= 2 * low * N[3 * worst]!;
          a -= 2 * low * N[3 * worst + 1]!;
          b -= 2 * low * N[3 * worst + 2]!;
        }
        const outside = plainWalls.some((p) => p.line[0]! * w + p.line[1]! * a + p.line[2]! * b < 0);
        const base = folds === 0 && !outside ? colors.room : outside ? colors.line : folds % 2 ? colors.light : colors.dark;
        const far = k === 0 ? 0 : k < 0 ? Math.min(1, Math.max(0, (Math.sqrt(r2) - 0.9) / 0.1)) : 0;
        const line = Math.min(1, Math.max(0, (nearest * scale) / pixel - 0.2)) * (1 - 0.5 * far) + 0.5 * far;
        for (let c = 0; c < 3; ++c) out[c] = colors.line[c]! + (base[c]! - colors.line[c]!) * (folds >= 60 ? 0.4 : line);
      }
      const at = 4 * (py * size + px);
      image.data.set([out[0]!, out[1]!, out[2]!, 255 * alpha], at);
    }
  context.putImageData(image, 0, 0);
}

/** A geodesic between two points as points of the chart, in the units of the overlay (0…1000, y downwards). */
export function chartPoint(room: RoomReply, p: ArrayLike<number>): [number, number] {
  const [x, y] = g.diskFromPoint(room.curvature, p), reach = reachOf(room);
  return [500 + (500 * x) / reach, 500 - (500 * y) / reach];
}
export function pointOfChart(room: RoomReply, x: number, y: number): g.Vector {
  const reach = reachOf(room);
  return g.pointFromDisk(room.curvature, ((x - 500) / 500) * reach, ((500 - y) / 500) * reach);
}
export function wallPath(room: RoomReply, index: number): string {
  const wall = room.walls[index]!;
  const k = room.curvature, steps = 24;
  let path = '';
  for (let i = 0; i <= steps; ++i) {
    const s = (wall.length * i) / steps;
    const p = wall.start.map((x, c) => g.cosK(k, s) * x + g.sinK(k, s) * wall.along[c]!);
    if (k === 0) p[0] = 1;
    const [x, y] = chartPoint(room, p);
    path += `${i === 0 ? 'M' : 'L'}${x.toFixed(1)} ${y.toFixed(1)}`;
  }
  return path;
}
export function wallMiddle(room: RoomReply, index: number, inwards = 0): [number, number] {
  const wall = room.walls[index]!;
  const k = room.curvature, s = wall.length / 2;
  const p = wall.start.map((x, c) => g.cosK(k, s) * x + g.sinK(k, s) * wall.along[c]!);
  if (k === 0) p[0] = 1;
  const [x, y] = chartPoint(room, p);
  const d = Math.hypot(x - 500, y - 500) || 1;
  return [x - (inwards * (x - 500)) / d, y - (inwards * (y - 500)) / d];
}
