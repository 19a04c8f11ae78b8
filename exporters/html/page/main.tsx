import { render } from 'preact';
import { effect } from '@preact/signals';
import { Walk } from './room/walk';
import { RoomView } from './room/view';
import * as app from './state/app';
import { linkOf, sceneOf } from './state/share';
import { Bar, Compass, Difference, Empty, Exporting, Fatal, Help, Menus, Status, Tag, Toast } from './ui/Chrome';
import { rememberPage } from './ui/files';
import { Gizmos } from './ui/Gizmos';
import { Panel } from './ui/Panel';
import { take } from './ui/take';
import { CornerPopover, Tiling } from './ui/Tiling';

const element = (id: string) => document.getElementById(id)!;

/** A block of the page: base64 of deflated bytes (format.md). */
async function unpacked(text: string): Promise<ArrayBuffer> {
  const response = await fetch('data:application/octet-stream;base64,' + text);
  return new Response(response.body!.pipeThrough(new DecompressionStream('deflate-raw'))).arrayBuffer();
}

function draw(walk: { current: Walk | null }, again: () => void): void {
  const Page = () => (
    <>
      <Gizmos />
      <Tiling />
      <CornerPopover />
      <Bar />
      <Panel />
      <Compass />
      <Help />
      <Status />
      <Difference />
      <Menus />
      <Tag />
      <Toast />
      <Exporting />
      <Empty />
      <Fatal again={again} />
    </>
  );
  render(<Page />, element('ui'));
  effect(() => {
    const c = document.documentElement.classList;
    c.toggle('design', app.mode.value === 'design');
    c.toggle('walking', app.walking.value && app.mode.value === 'walk');
    c.toggle('dragging', app.dragging.value);
    c.toggle('projector', app.projector.value);
    c.toggle('fatal', app.fatal.value !== null);
    c.toggle('empty', app.empty.value);
    c.toggle('difference', app.difference.value);
  });
  void walk;
}

async function firstText(): Promise<string> {
  try {
    const linked = await sceneOf(location.hash);
    if (linked !== null) return linked;
  } catch (error) {
    app.message.value = `The scene in this link cannot be read: ${String(error instanceof Error ? error.message : error)}`;
  }
  const own = JSON.parse(element('scene').textContent || '""') as string;
  if (own.trim() === '')
    try {
      return localStorage.getItem(app.storageKey) ?? '';
    } catch {
      return '';
    }
  return own;
}

async function start(): Promise<void> {
  document.currentScript?.remove(); // put there by page.html
  rememberPage();
  const canvas = element('room') as HTMLCanvasElement;
  const walk: { current: Walk | null } = { current: null };
  const begin = () => {
    try {
      const view = new RoomView(canvas);
      app.setView(view);
      if (app.scene.value && app.lastCopies) view.setScene(app.scene.value, app.lastCopies);
      if (!walk.current) walk.current = new Walk(view, canvas);
      app.fatal.value = null;
    } catch (error) {
      app.fatal.value = String(error instanceof Error ? error.message : error);
    }
  };
  canvas.addEventListener('webglcontextlost', (e) => {
    e.preventDefault();
    app.fatal.value = 'The browser took the graphics card away (WebGL context lost).';
  });
  // The text goes along in the address: what was changed would be lost where the page has a scene of its own.
  draw(walk, () => void linkOf(app.text.value).then((link) => (history.replaceState(null, '', link), location.reload())));
  begin();
  const assets = JSON.parse(element('assets').textContent || '[]') as [string, string][];
  const [wasm, text, ...files] = await Promise.all([unpacked(element('wasm').textContent!), firstText(), ...assets.map(async ([name, data]) => [name, new Uint8Array(await unpacked(data))] as [string, Uint8Array])]);
  const source = element('core').textContent! + '\n' + element('worker').textContent!;
  await app.startWorker(source, wasm as ArrayBuffer, files as [string, Uint8Array][]);
  app.document_.start(text as string);
  app.watchText();
  addEventListener('hashchange', () => void sceneOf(location.hash).then((linked) => linked !== null && app.document_.replaceAll(linked), () => (app.message.value = 'The scene in this link cannot be read.')));
  addEventListener('dragover', (e) => e.preventDefault());
  addEventListener('drop', (e) => {
    e.preventDefault();
    if (e.dataTransfer?.files.length) void take([...e.dataTransfer.files]);
  });
  // For tests: what the page is doing, by numbers.
  Object.assign(globalThis, { orbc: { app, walk: () => walk.current } });
  effect(() => void (app.scene.value && document.documentElement.setAttribute('data-ready', '1')));
}

start().catch((error: unknown) => (app.fatal.value = String(error instanceof Error ? error.message : error)));
