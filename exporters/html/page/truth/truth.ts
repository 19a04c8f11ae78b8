/** The truth layer: at rest the tracer in the worker refines the picture tile by tile over the live one, and a key shows how the two differ. */
import type { FromWorker } from '../core/worker';
import * as app from '../state/app';
import { eyeNumbers } from '../room/eye';
import type { RoomView, Shot } from '../room/view';

const samples = 16;

export class Truth {
  private canvas = document.getElementById('truth') as HTMLCanvasElement;
  private running = false;
  private live: Uint8Array | null = null;
  private scale = 1;
  done = false;

  constructor(private view: RoomView) {}

  /** The live picture at rest, to be compared. */
  remember(): void {
    this.live = null;
  }

  stop(): void {
    if (!this.running && !this.done) return;
    this.running = this.done = false;
    app.refining.value = 0;
    app.differing.value = null;
    app.send({ kind: 'trace', job: null });
    this.canvas.classList.remove('shown');
    this.canvas.getContext('2d')!.clearRect(0, 0, this.canvas.width, this.canvas.height);
  }

  run(shot: Shot): void {
    if (this.running || this.done) return;
    this.running = true;
    const { canvas } = this.view;
    // On screens of many pixels the tracer draws one for four.
    this.scale = canvas.width * canvas.height > 2.2e6 ? 0.5 : 1;
    const width = Math.round(canvas.width * this.scale), height = Math.round(canvas.height * this.scale);
    this.canvas.width = width;
    this.canvas.height = height;
    app.send({
      kind: 'trace',
      job: {
        eye: eyeNumbers(shot.eye),
        fov: shot.fov,
        width,
        height,
        shift: [(shot.shift[0] * width) / 2, (-shot.shift[1] * height) / 2],
        samples,
      },
    });
    this.canvas.classList.add('shown');
  }

  tile(m: Extract<FromWorker, { kind: 'tile' }>): void {
    if (!this.running) return;
    const context = this.canvas.getContext('2d')!;
    const data = new ImageData(new Uint8ClampedArray(m.pixels), m.width, m.height);
    if (app.difference.value) this.differ(data, m.x, m.y);
    context.putImageData(data, m.x, m.y);
    app.refining.value = m.share;
    if (m.share >= 1) {
      this.running = false;
      this.done = true;
      this.measure();
    }
  }

  private livePixels(): Uint8Array {
    return (this.live ??= this.view.read());
  }

  /** The picture in grey, and how much the two differ in amber: 0 to 64 of 255. */
  private differ(data: ImageData, x0: number, y0: number): void {
    const live = this.livePixels(), width = this.view.canvas.width, step = Math.round(1 / this.scale);
    for (let y = 0; y < data.height; ++y)
      for (let x = 0; x < data.width; ++x) {
        const at = 4 * (y * data.width + x), other = 4 * ((y0 + y) * step * width + (x0 + x) * step);
        let most = 0;
        for (let c = 0; c < 3; ++c) most = Math.max(most, Math.abs(data.data[at + c]! - live[other + c]!));
        const grey = 0.25 * (0.3 * data.data[at]! + 0.59 * data.data[at + 1]! + 0.11 * data.data[at + 2]!);
        const t = Math.min(1, most / 64);
        data.data[at] = grey + t * (255 - grey);
        data.data[at + 1] = grey + t * (176 - grey);
        data.data[at + 2] = grey + t * (20 - grey) * 0.6;
      }
  }

  private measure(): void {
    if (app.difference.value) return;
    const live = this.livePixels(), width = this.view.canvas.width, step = Math.round(1 / this.scale);
    const traced = this.canvas.getContext('2d')!.getImageData(0, 0, this.canvas.width, this.canvas.height);
    let differ = 0;
    for (let y = 0; y < traced.height; ++y)
      for (let x = 0; x < traced.width; ++x) {
        const at = 4 * (y * traced.width + x), other = 4 * (y * step * width + x * step);
        for (let c = 0; c < 3; ++c)
          if (Math.abs(traced.data[at + c]! - live[other + c]!) > 4) {
            ++differ;
            break;
          }
      }
    app.differing.value = differ / (traced.width * traced.height);
  }
}
