/** The worker: it holds the core and does the page's work in slices, so that a new scene never waits for light or pixels of the old one. */
import { Core } from './core';
import type { CopiesReply, ExportReply, LightReply, SceneReply } from '../state/reply';

export interface TraceJob {
  eye: number[];
  fov: number;
  width: number;
  height: number;
  shift: number[];
  samples: number;
}
export type ToWorker =
  | { kind: 'start'; wasm: ArrayBuffer; assets: [string, Uint8Array][] }
  | { kind: 'asset'; name: string; bytes: Uint8Array }
  | { kind: 'mesh'; id: number; name: string; bytes: Uint8Array }
  | { kind: 'open'; id: number; text: string; copies: number; most: number }
  | { kind: 'notation'; id: number; text: string; real: boolean }
  | { kind: 'trace'; job: TraceJob | null }
  | { kind: 'export'; text: string; format: string; eye: number[] | null };
export type FromWorker =
  | { kind: 'ready' }
  | { kind: 'failed'; message: string }
  | { kind: 'opened'; id: number; scene: SceneReply; copies: CopiesReply; time: number }
  | { kind: 'answer'; id: number; reply: unknown }
  | { kind: 'told'; stage: string; share: number | null }
  | { kind: 'exported'; reply: ExportReply }
  | { kind: 'light'; id: number; light: LightReply }
  | { kind: 'tile'; x: number; y: number; width: number; height: number; pixels: Uint8Array; pass: number; share: number };

const scope = self as unknown as { postMessage(message: FromWorker): void; onmessage: ((event: MessageEvent<ToWorker>) => void) | null };
const slice = 25; // milliseconds that a slice of work takes at most, about
let core: Core | undefined;
let openId = 0;
let lightLeft = false;
let lightChunk = 64;
let trace: { job: TraceJob; tiles: [number, number][]; next: number; pass: number } | null = null;
const queue: ToWorker[] = [];
const tileSide = 64;

function tilesOf(job: TraceJob): [number, number][] {
  const tiles: [number, number][] = [];
  for (let y = 0; y < job.height; y += tileSide) for (let x = 0; x < job.width; x += tileSide) tiles.push([x, y]);
  const middle = [job.width / 2, job.height / 2] as const;
  const far = (t: [number, number]) => Math.hypot(t[0] + tileSide / 2 - middle[0], t[1] + tileSide / 2 - middle[1]);
  return tiles.sort((a, b) => far(a) - far(b));
}

function open(message: { id: number; text: string; copies: number; most: number }): void {
  const begin = performance.now();
  const scene = core!.open<SceneReply>(message.text);
  let copies: CopiesReply = { matrices: new Float64Array(), words: new Uint8Array(), lengths: new Uint8Array(), whole: true };
  if (scene.ok) {
    copies = core!.copies<CopiesReply>(Math.min(scene.cover.max_bounces, message.copies), message.most);
    openId = message.id;
    lightLeft = scene.light.lit;
    trace = null;
  }
  scope.postMessage({ kind: 'opened', id: message.id, scene, copies, time: performance.now() - begin });
}

function work(): void {
  const begin = performance.now();
  if (lightLeft) {
    const light = core!.light<LightReply>(lightChunk);
    const took = performance.now() - begin;
    if (took < slice) lightChunk = Math.min(8192, Math.ceil(lightChunk * 1.5));
    else if (took > 2 * slice) lightChunk = Math.max(16, lightChunk >> 1);
    lightLeft = light.done < light.all;
    scope.postMessage({ kind: 'light', id: openId, light });
    return;
  }
  while (trace && performance.now() - begin < slice) {
    const { job } = trace;
    const [x, y] = trace.tiles[trace.next]!;
    const width = Math.min(tileSide, job.width - x), height = Math.min(tileSide, job.height - y);
    // The samples of a grid in an order that covers the pixel early.
    const index = (trace.pass * 13 + (job.samples >> 1)) % job.samples;
    const pixels = core!.traceTile(x, y, width, height, index, job.samples);
    const done = trace.pass * trace.tiles.length + trace.next + 1;
    scope.postMessage({ kind: 'tile', x, y, width, height, pixels, pass: trace.pass, share: done / (job.samples * trace.tiles.length) });
    if (++trace.next === trace.tiles.length) {
      trace.next = 0;
      if (++trace.pass === job.samples) trace = null;
    }
  }
}

/** How far an export is, not more often than a reader can follow. */
let lastTold = 0;
function tell(stage: string, done: number, all: number): void {
  if (performance.now() - lastTold < 100) return;
  lastTold = performance.now();
  scope.postMessage({ kind: 'told', stage, share: all ? done / all : null });
}

function handle(message: ToWorker): void {
  if (message.kind === 'start')
    void Core.start(message.wasm, tell).then(
      (made) => {
        core = made;
        for (const [name, bytes] of message.assets) core.asset(name, bytes);
        scope.postMessage({ kind: 'ready' });
        tick();
      },
      (error: unknown) => scope.postMessage({ kind: 'failed', message: String(error) }),
    );
  else if (message.kind === 'asset') core!.asset(message.name, message.bytes);
  else if (message.kind === 'open') open(message);
  else if (message.kind === 'notation') scope.postMessage({ kind: 'answer', id: message.id, reply: core!.notation(message.text, message.real) });
  else if (message.kind === 'mesh') scope.postMessage({ kind: 'answer', id: message.id, reply: core!.takeMesh(message.name, message.bytes) });
  else if (message.kind === 'export') scope.postMessage({ kind: 'exported', reply: core!.export(message.text, message.format, message.eye) });
  else if (message.job) {
    core!.traceBegin(message.job.eye, message.job.fov, message.job.width, message.job.height, message.job.shift);
    trace = { job: message.job, tiles: tilesOf(message.job), next: 0, pass: 0 };
  } else trace = null;
}

const channel = new MessageChannel();
let ticking = false;
function tick(): void {
  if (!core || ticking) return;
  ticking = true;
  channel.port2.postMessage(0);
}
channel.port1.onmessage = () => {
  ticking = false;
  try {
    // Of several scenes that wait the last one counts.
    const newest = queue.map((m) => m.kind).lastIndexOf('open');
    const message = queue.shift();
    if (message) {
      if (message.kind !== 'open' || newest <= 0) handle(message);
    } else work();
  } catch (error) {
    scope.postMessage({ kind: 'failed', message: String(error) });
    return;
  }
  if (queue.length > 0 || lightLeft || trace) tick();
};
scope.onmessage = (event) => {
  if (event.data.kind === 'start') return handle(event.data);
  if (event.data.kind === 'trace') trace = null;
  queue.push(event.data);
  tick();
};
