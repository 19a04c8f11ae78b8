/** What the page knows and what it can do. Signals hold what the panes show; the text of the scene is the only thing that lasts. */
import { batch, computed, effect, signal } from '@preact/signals';
import type { FromWorker, ToWorker } from '../core/worker';
import { eyeOfScene, stands, type Eye } from '../room/eye';
import type { Vector } from '../room/geometry';
import { RoomView } from '../room/view';
import { difference as diff, SceneText } from './document';
import { textExtensions } from './editor';
import type { CopiesReply, Diagnostic, ExportReply, MeshReply, Orbifold, SceneReply } from './reply';
import { append, get, getScalar, keysAt, remove, set, written, type Path } from './splice';

export type Selection = { kind: 'room' } | { kind: 'wall' | 'object' | 'lamp'; index: number };

export const mode = signal<'walk' | 'design'>('walk');
export const tab = signal<'things' | 'text'>('things');
export const selection = signal<Selection>({ kind: 'room' });
export const corner = signal<number | null>(null);
export const menu = signal<'share' | 'more' | 'keys' | null>(null);
export const projector = signal(false);
export const scene = signal<SceneReply | null>(null);
export const diagnostics = signal<Diagnostic[]>([]);
export const stale = signal(false); // the picture is of an earlier text
export const empty = signal(false);
export const fatal = signal<string | null>(null);
export const dragging = signal(false);
export const tag = signal<{ x: number; y: number; title: string; more: string; blocked: boolean } | null>(null);
/** Of what is dragged: where it stood, where it is, what it snaps to. */
export const dragStart = signal<number[] | null>(null);
export const draggedTo = signal<Vector | null>(null);
export const snapped = signal<{ words: string; line: Vector[] } | null>(null);
export const eye = signal<Eye | null>(null);
export const walking = signal(false);
export const stepped = signal(false);
export const throughMirrors = signal(false);
export const refining = signal(0);
export const lightShare = signal(1);
export const difference = signal(false);
export const differing = signal<number | null>(null);
export const message = signal('');
export const refused = signal<string | null>(null);

export const document_ = new SceneText('', textExtensions());
export const text = document_.text;
export const errors = computed(() => diagnostics.value.filter((d) => d.severity === 'error'));

let worker: Worker | null = null;
let asked = 0, askedOpen = 0;
let replyFor: Map<number, (reply: unknown) => void> = new Map();
let listeners: ((message: FromWorker) => void)[] = [];
export let view: RoomView | null = null;
export let lastCopies: CopiesReply | null = null;
export const setView = (made: RoomView): void => void (view = made);

/** The first eye, to which the compass refers. */
export let home: Eye | null = null;

/** What every worker begins with. */
let seed: { address: string; wasm: ArrayBuffer; assets: Map<string, Uint8Array> };

export function startWorker(source: string, wasm: ArrayBuffer, assets: [string, Uint8Array][]): Promise<void> {
  seed = { address: URL.createObjectURL(new Blob([source], { type: 'text/javascript' })), wasm, assets: new Map(assets) };
  worker = new Worker(seed.address);
  return new Promise((resolve, reject) => {
    worker!.onmessage = (event: MessageEvent<FromWorker>) => {
      const m = event.data;
      if (m.kind === 'ready') resolve();
      if (m.kind === 'failed') (reject(new Error(m.message)), (message.value = m.message));
      receive(m);
    };
    worker!.onerror = (event) => reject(new Error(event.message));
    send({ kind: 'start', wasm, assets });
  });
}
export const send = (m: ToWorker, transfer: Transferable[] = []): void => worker?.postMessage(m, transfer);
export const listen = (listener: (m: FromWorker) => void): void => void listeners.push(listener);

/** An export in a worker of its own, so that the room goes on; null: there is none. */
export const exporting = signal<{ format: string; stage: string; share: number | null } | null>(null);
let exporter: Worker | null = null;
export function stopExport(): void {
  exporter?.terminate();
  exporter = exporting.value = null;
}
export function exportScene(format: string, eyeNumbers: number[] | null): Promise<ExportReply> {
  stopExport();
  const own = (exporter = new Worker(seed.address));
  exporting.value = { format, stage: 'starting', share: null };
  return new Promise<ExportReply>((resolve, reject) => {
    own.onmessage = (event: MessageEvent<FromWorker>) => {
      const m = event.data;
      if (m.kind === 'ready') own.postMessage({ kind: 'export', text: text.value, format, eye: eyeNumbers } satisfies ToWorker);
      else if (m.kind === 'told') exporting.value = { format, stage: m.stage, share: m.share };
      else if (m.kind === 'exported') resolve(m.reply);
      else if (m.kind === 'failed') reject(new Error(m.message));
    };
    own.onerror = (event) => reject(new Error(event.message));
    own.postMessage({ kind: 'start', wasm: seed.wasm, assets: [...seed.assets] } satisfies ToWorker);
  }).finally(() => own === exporter && stopExport());
}

let askedText = '';
let answeredText = '';
let goodText = '';
let ending = false;
let afterDrag: (() => void)[] = [];

/** The pointer has let go. Once the core has judged the last place, the drag becomes one step of the history; from a place that cannot be,
 *  what was dragged returns to the last that could. */
export function endDrag(): void {
  ending = true;
  if (answeredText === text.value) settleDrag();
}
function settleDrag(): void {
  ending = false;
  if (stale.value) document_.drag(() => diff(document_.heldText() ?? text.value, goodText));
  document_.release();
  quietDrag();
}
export function cancelDrag(): void {
  ending = false;
  document_.cancel();
  quietDrag();
}
function quietDrag(): void {
  batch(() => {
    dragging.value = false;
    tag.value = null;
    dragStart.value = draggedTo.value = snapped.value = null;
  });
  for (const act of afterDrag.splice(0)) act();
}
export const onceDragEnds = (act: () => void): void => void (afterDrag.length === 0 && afterDrag.push(act));

function receive(m: FromWorker): void {
  if (m.kind === 'opened' && m.id === askedOpen) {
    answeredText = askedText;
    if (m.scene.ok) goodText = askedText;
    batch(() => {
      diagnostics.value = m.scene.diagnostics;
      stale.value = !m.scene.ok;
      if (!m.scene.ok) return;
      lastCopies = m.copies;
      const before = scene.value;
      view?.setScene(m.scene, m.copies);
      const keep = before && eye.value && before.room.curvature === m.scene.room.curvature && stands(eye.value, m.scene.room);
      if (!keep) home = eye.value = eyeOfScene(m.scene);
      scene.value = m.scene;
      lightShare.value = m.scene.light.lit ? 0 : 1;
      clampSelection(m.scene);
    });
    if (ending && answeredText === text.value) settleDrag();
  } else if (m.kind === 'light' && m.id === askedOpen) lightShare.value = m.light.all ? m.light.done / m.light.all : 1;
  else if (m.kind === 'answer') {
    replyFor.get(m.id)?.(m.reply);
    replyFor.delete(m.id);
  }
  for (const listener of listeners) listener(m);
}

function clampSelection(s: SceneReply): void {
  const chosen = selection.value;
  if (chosen.kind === 'room') return;
  const count = { wall: s.room.walls.length, object: s.objects.length, lamp: s.lamps.length }[chosen.kind];
  if (chosen.index >= count) selection.value = { kind: 'room' };
  if (corner.value !== null && corner.value >= s.orbifold.orders.length) corner.value = null;
}

/** Has the core read the text whenever it has changed. */
export function watchText(): void {
  let timer = 0;
  effect(() => {
    const now = text.value;
    if (now.trim() === '') {
      empty.value = true;
      return;
    }
    empty.value = false;
    clearTimeout(timer);
    timer = window.setTimeout(() => {
      openNow(now);
    }, 15);
  });
  let saving = 0;
  effect(() => {
    const now = text.value;
    clearTimeout(saving);
    saving = window.setTimeout(() => {
      try {
        localStorage.setItem(storageKey, now);
      } catch {
        // A page opened from a file may not have a store; the text is still on the screen.
      }
    }, 600);
  });
}
export const storageKey = 'orbc scene ' + location.pathname;

function ask<T>(make: (id: number) => ToWorker): Promise<T> {
  const id = ++asked;
  send(make(id));
  return new Promise((resolve) => replyFor.set(id, (reply) => resolve(reply as T)));
}
export const askNotation = (symbol: string, real: boolean): Promise<{ diagnostics: Diagnostic[]; orbifold?: Orbifold }> =>
  ask((id) => ({ kind: 'notation', id, text: symbol, real }));

// ---- files that scenes name --------------------------------------------------------------------------------------------------------

/** Whether files have been given to the page since it was opened. */
export let filesChanged = false;
export const files = (): ReadonlyMap<string, Uint8Array> => seed.assets;
export function addFile(name: string, bytes: Uint8Array): void {
  seed.assets.set(name, bytes);
  filesChanged = true;
  send({ kind: 'asset', name, bytes });
}
/** Has the core read a mesh file; it is kept if it is one. */
export async function addMesh(name: string, bytes: Uint8Array): Promise<MeshReply> {
  const reply = await ask<MeshReply>((id) => ({ kind: 'mesh', id, name, bytes }));
  if (reply.triangles === undefined) return reply;
  seed.assets.set(name, bytes);
  filesChanged = true;
  return reply;
}
/** Has the core read the text again, since files have changed. */
export const reread = (): void => openNow(text.value);
function openNow(now: string): void {
  if (now.trim() === '') return;
  askedText = now;
  send({ kind: 'open', id: (askedOpen = ++asked), text: now, copies: 64, most: 3000 });
}

// ---- edits: each is one splice of the text ---------------------------------------------------------------------------------------

export const change = (path: Path, value: string): void => document_.apply(set(text.value, path, value));
export const changeWhileDragging = (path: Path, value: string): void => document_.drag((held) => set(held, path, value));
export const take = (path: Path): void => document_.apply(remove(text.value, path));
export const add = (path: Path, value: string): void => document_.apply(append(text.value, path, value));

export function notationOf(orders: string[]): string {
  return '*' + orders.map((k) => (/^[2-9]$/.test(k) ? k : `(${k})`)).join('');
}
const quotedNotation = (orders: string[]) => `"${notationOf(orders)}"`;

/** Sets the order of a corner, if a room with it exists; else says why not. */
export async function setOrder(index: number, order: string): Promise<boolean> {
  const s = scene.value;
  if (!s) return false;
  const orders = [...s.orbifold.orders];
  orders[index] = fraction(order);
  return setOrders(orders, order);
}
/** 2.5 as 5/2: the notation wants fractions or decimals; both are exact. */
const fraction = (order: string) => order.trim();

export async function setOrders(orders: string[], typed = ''): Promise<boolean> {
  const symbol = notationOf(orders);
  const real = orders.some((k) => !/^\d+$/.test(k));
  const told = await askNotation(symbol, real);
  const wrong = told.diagnostics.find((d) => d.severity === 'error');
  if (!told.orbifold || told.orbifold.space === 'none') {
    refused.value = wrong ? wrong.message : `${typed || symbol} closes in no space of constant curvature`;
    return false;
  }
  refused.value = null;
  let next = text.value;
  const edits: [Path, string][] = [[['orbifold'], quotedNotation(orders)]];
  if (real && getScalar(next, ['allow_non_orbifold']) !== 'true') edits.push([['allow_non_orbifold'], 'true']);
  for (const [path, value] of edits) {
    const splice = set(next, path, value);
    if (splice) next = next.slice(0, splice.from) + splice.insert + next.slice(splice.to);
  }
  document_.apply(diff(text.value, next));
  return true;
}
export function presetOf(): 'universal' | 'translational' | 'orbifold' | null {
  const bounces = getScalar(text.value, ['cover', 'max_bounces']);
  const share = Number(getScalar(text.value, ['room', 'walls', 'all', 'mirror', 'reflectance']) ?? 0.9);
  if (bounces === '0') return 'orbifold';
  if (share >= 0.999) return 'universal';
  return null;
}

/** The path of the mirror of a wall (from 0) in the text, where its own keys stand or will stand. */
export function wallPath(index: number): Path {
  return ['room', 'walls', String(index + 1)];
}
export const objectPath = (index: number): Path => ['objects', index];
export const lampPath = (index: number): Path => ['lights', index];
export { get, getScalar, keysAt, written };
export type { Path };

/** Several edits as one step of the history. */
export function severalSplices(edits: [Path, string][]): { from: number; to: number; insert: string } {
  let next = text.value;
  for (const [path, value] of edits) {
    const splice = set(next, path, value);
    if (splice) next = next.slice(0, splice.from) + splice.insert + next.slice(splice.to);
  }
  return diff(text.value, next);
}

/** A value as YAML on one line, without its comments. */
export function flowOf(value: string): string {
  if (/^[{["']/.test(value.trim())) return value.trim();
  const keys = keysAt(value, []);
  if (keys.length === 0) return value.trim();
  const isList = typeof keys[0] === 'number';
  const parts = keys.map((key) => (isList ? '' : `${key}: `) + flowOf(get(value, [key]) ?? ''));
  return isList ? `[${parts.join(', ')}]` : `{${parts.join(', ')}}`;
}
export function withEntry(value: string, key: string, entry: string): string {
  const splice = set(value, [key], entry);
  return splice ? value.slice(0, splice.from) + splice.insert + value.slice(splice.to) : value;
}
export function withoutEntry(value: string, key: string): string {
  const splice = remove(value, [key]);
  return splice ? value.slice(0, splice.from) + splice.insert + value.slice(splice.to) : value;
}
