// Pictures of every state of the designer, to be looked at: node tests/page/states.mjs PAGE EMPTY_PAGE FOLDER [STATE …]
// The page should hold a lit room with an object and a lamp. States are named as below; without any all are drawn.
import { mkdirSync } from 'node:fs';
import { app, browser, open, ready, until } from './browser.mjs';

const [file, emptyFile, folder, ...wanted] = process.argv.slice(2);
const desk = { width: 1440, height: 900 }, tablet = { width: 1024, height: 768 }, phone = { width: 844, height: 390, touch: true };
const pause = (page, time = 300) => page.waitForTimeout(time);
const select = (kind, index) => (page) => app(page, `(app.mode.value = 'design', app.selection.value = { kind: '${kind}', index: ${index} }, 0)`);
const text = (change) => async (page) => {
  await app(page, "(app.mode.value = 'design', app.tab.value = 'text', 0)");
  await pause(page);
  await app(page, `(app.document_.replaceAll(app.text.value${change}), 0)`);
  await pause(page, 800);
};
async function drag(page, dx, dy) {
  await select('object', 0)(page);
  await page.waitForSelector('#panel');
  await pause(page, 1500);
  // The middle of the object on the screen, by asking what a ray meets.
  const at = await app(page, `(() => { for (let y = 0; y < innerHeight; y += 6) for (let x = 330; x < innerWidth - 350; x += 6) if (walk().objectAt(x, y) === 0) return [x, y]; return null; })()`);
  if (!at) throw new Error('the object is not in view');
  await page.mouse.move(at[0], at[1] + 10);
  await page.mouse.down();
  for (let i = 1; i <= 8; ++i) await page.mouse.move(at[0] + (dx * i) / 8, at[1] + 10 + (dy * i) / 8);
  await pause(page, 600);
}
const states = {
  walk: [desk, async () => {}],
  'walk-1024': [tablet, async () => {}],
  walking: [desk, async (page) => (await page.keyboard.down('e'), await pause(page, 2600))],
  compass: [desk, async (page) => app(page, '(walk().go(0.2, 0.2), walk().go(0.2, -0.5), walk().go(-0.5, 0), walk().go(-0.1, 0.4), 0)')],
  object: [desk, select('object', 0)],
  wall: [desk, select('wall', 1)],
  lamp: [desk, select('lamp', 0)],
  room: [desk, select('room', 0)],
  'room-1024': [tablet, select('room', 0)],
  corner: [desk, async (page) => (await select('room', 0)(page), await pause(page), await page.click('.handle'))],
  refused: [desk, async (page) => (await select('room', 0)(page), await pause(page), await page.click('.handle'), await page.fill('#order', '0.3'), await page.keyboard.press('Enter'))],
  text: [desk, text('')],
  error: [desk, text(".replace('reflectance', 'reflectence')")],
  'error-1024': [tablet, text(".replace('reflectance', 'reflectence')")],
  dragging: [desk, (page) => drag(page, 90, 20)],
  blocked: [desk, (page) => drag(page, 600, -200)],
  difference: [desk, async (page) => (await app(page, '(app.difference.value = true, 0)'), await until(page, 'app.refining.value >= 0.3'))],
  share: [desk, async (page) => (await page.click('[aria-label="Share and export"]'), await pause(page, 600))],
  'share-1024': [tablet, async (page) => (await page.click('[aria-label="Share and export"]'), await pause(page, 600))],
  'share-phone': [phone, async (page) => (await page.tap('[aria-label="Share and export"]'), await pause(page, 600))],
  exporting: [desk, async (page) => (await app(page, "(app.exporting.value = { format: 'glb', stage: 'bending', share: 0.34 }, 0)"), await pause(page))],
  keys: [desk, async (page) => (await page.focus('#room'), await page.keyboard.press('?'))],
  projector: [desk, async (page) => app(page, '(app.projector.value = true, 0)')],
  fatal: [desk, async (page) => app(page, "(app.fatal.value = 'The browser took the graphics card away (WebGL context lost).', 0)")],
  light: [desk, async () => {}, { light: true }],
  'light-room': [desk, select('wall', 1), { light: true }],
  phone: [phone, async () => {}],
  'phone-corner': [phone, async (page) => (await select('room', 0)(page), await pause(page), await page.tap('.handle'))],
  'phone-object': [phone, select('object', 0)],
  empty: [desk, async () => {}, { empty: true }],
  'empty-1024': [tablet, async () => {}, { empty: true }],
  'empty-phone': [phone, async () => {}, { empty: true }],
};
// What a state leaves behind is taken back, so that states of one size share a page and its light.
const reset = "(app.document_.replaceAll(globalThis.first ??= app.text.value), app.mode.value = 'walk', app.tab.value = 'things', app.menu.value = null, " +
  "app.corner.value = null, app.projector.value = false, app.fatal.value = null, app.difference.value = false, app.exporting.value = null, app.selection.value = { kind: 'room' }, " +
  "app.eye.value = app.home, app.stepped.value = false, 0)";
mkdirSync(folder, { recursive: true });
const chrome = await browser();
const pages = new Map();
for (const [name, [size, act, options = {}]] of Object.entries(states)) {
  if (wanted.length > 0 && !wanted.includes(name)) continue;
  const key = JSON.stringify([size, options]);
  if (!pages.has(key)) {
    const opened = await open(chrome, options.empty ? emptyFile : file, { ...size, light: options.light });
    pages.set(key, opened);
    if (options.empty) await opened.page.waitForSelector('#empty');
    else {
      await ready(opened.page);
      await until(opened.page, 'app.lightShare.value >= 1');
    }
  }
  const { page, errors } = pages.get(key);
  try {
    if (!options.empty) await app(page, reset);
    await page.mouse.move(700, 300);
    await pause(page, 400);
    await act(page);
    if (!options.empty && name !== 'walking' && name !== 'fatal') await until(page, 'walk().smoothed >= 3', 20).catch(() => {});
    await page.screenshot({ path: `${folder}/${name}.png` });
    await page.keyboard.up('e');
    await page.mouse.up();
  } catch (error) {
    console.log(`${name}: ${error}`);
  }
  if (errors.length > 0) console.log(`${name}: ${errors.splice(0)}`);
}
await chrome.close();
