// Files dropped on the page: node drops.mjs PAGE EMPTY_PAGE FOLDER. FOLDER takes a saved page.
import { readFileSync } from 'node:fs';
import { app, browser, check, finish, open, ready, until } from './browser.mjs';

const [file, emptyFile, folder] = process.argv.slice(2);
const chrome = await browser();
const text = (page) => app(page, 'app.text.value');
/** Drops files, given as [name, bytes or text], where a hand would. */
const drop = (page, files) =>
  page.evaluate((list) => {
    const data = new DataTransfer();
    for (const [name, content] of list) data.items.add(new File([typeof content === 'string' ? content : typeof content === 'number' ? new Uint8Array(content) : Uint8Array.from(atob(content[0]), (c) => c.charCodeAt(0))], name));
    orbc.app.message.value = '';
    dispatchEvent(new DragEvent('drop', { dataTransfer: data, cancelable: true }));
  }, files);
const bytes = (buffer) => [buffer.toString('base64')];

const corners = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
const obj = corners.map((c) => `v ${c.join(' ')}`).join('\n') + '\nvt 0 0\nvt 1 0\nvt 0 1\n' + faces.map((f) => `f ${f.map((v, k) => `${v + 1}/${k + 1}`).join(' ')}`).join('\n') + '\n';
const off = `OFF\n4 4 0\n${corners.map((c) => c.join(' ')).join('\n')}\n${faces.map((f) => `3 ${f.join(' ')}`).join('\n')}\n`;
const ply = `ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n${corners.map((c) => c.join(' ')).join('\n')}\n${faces.map((f) => `3 ${f.join(' ')}`).join('\n')}\n`;
const stl = `solid t\n${faces.map((f) => `facet normal 0 0 0\nouter loop\n${f.map((v) => `vertex ${corners[v].join(' ')}`).join('\n')}\nendloop\nendfacet`).join('\n')}\nendsolid t\n`;

{
  const { page, errors, requests } = await open(chrome, file, { width: 480, height: 360 });
  await ready(page);
  const before = await text(page);
  const objects = await app(page, 'app.scene.value.objects.length');
  const meshes = { 'a.obj': obj, 'b.off': off, 'c.ply': ply, 'd.stl': stl, 'e.glb': bytes(readFileSync('examples/meshes/vase.glb')) };
  let count = objects;
  for (const [name, content] of Object.entries(meshes)) {
    await drop(page, [[name, content]]);
    await until(page, `app.scene.value.objects.length === ${count + 1} && !app.stale.value`, 60);
    ++count;
    const now = await text(page);
    check(now.includes(name) && (await app(page, `app.selection.value.index`)) === count - 1, `${name} stands in the room and is chosen`);
  }
  const lines = (await text(page)).split('\n');
  check(before.split('\n').every((line) => lines.includes(line)), 'what stood in the text is untouched');
  for (let i = 0; i < 5; ++i) await app(page, '(app.document_.undo(), 0)');
  check((await text(page)) === before, 'each drop is one step of the history');
  await until(page, `app.scene.value.objects.length === ${objects}`);

  // A mesh with its material and picture, dropped together.
  const png = await page.evaluate(async () => {
    const canvas = new OffscreenCanvas(4, 4), c = canvas.getContext('2d');
    c.fillStyle = '#f00';
    c.fillRect(0, 0, 4, 4);
    const blob = await canvas.convertToBlob();
    return btoa(String.fromCharCode(...new Uint8Array(await blob.arrayBuffer())));
  });
  await drop(page, [['f.obj', 'mtllib f.mtl\nusemtl red\n' + obj], ['f.mtl', 'newmtl red\nmap_Kd wood.png\n'], ['wood.png', [png]]]);
  await until(page, `app.scene.value.objects.length === ${objects + 1}`, 60);
  check((await app(page, 'app.scene.value.textures.length')) === 1 && (await app(page, 'app.message.value')) === '', 'an OBJ finds the material and the picture that are dropped with it');
  await app(page, '(app.document_.undo(), 0)');

  // A picture alone: on what is chosen, else on the floor.
  await app(page, "(app.mode.value = 'walk', 0)");
  await drop(page, [['tiles.png', [png]]]);
  await until(page, "app.scene.value.shell.floor.pattern === 'texture'", 60);
  check((await text(page)).includes('floor: {texture: "tiles.png"}'), 'a picture becomes the texture of the floor');
  await app(page, '(app.document_.undo(), 0)');
  await app(page, "(app.mode.value = 'design', app.selection.value = { kind: 'object', index: 0 }, 0)");
  await drop(page, [['tiles2.png', [png]]]);
  await until(page, `/material: \\{texture: "tiles2.png"\\}/.test(app.text.value)`, 60);
  check(true, 'or of the chosen object');
  await app(page, '(app.document_.undo(), 0)');
  check((await text(page)) === before, 'undo takes both back');

  // What cannot be taken is said, and changes nothing.
  const refused = async (files, words, what) => {
    await drop(page, files);
    await until(page, "app.message.value !== ''", 60);
    const said = await app(page, 'app.message.value');
    check(words.test(said) && /Nothing was changed/.test(said) && (await text(page)) === before, `${what}: ${said}`);
    check((await page.textContent('#toast')).includes(said.slice(0, 20)), 'it is shown');
  };
  const glb = readFileSync('examples/meshes/vase.glb');
  await refused([['broken.glb', bytes(glb.subarray(0, 2000))]], /broken\.glb/i, 'half a GLB');
  await refused([['noise.glb', bytes(Buffer.from('glTF and then nothing that is one'))]], /noise\.glb/i, 'a GLB of noise');
  await refused([['large.glb', 100 << 20]], /100 MB/, 'a mesh of 100 MB');
  await refused([['damaged.png', 'no picture']], /damaged\.png/, 'a damaged picture');
  await refused([['film.mp4', 'x']], /film\.mp4/, 'what the page knows nothing of');
  await refused([['empty.off', '']], /empty/, 'an empty mesh');
  check(!(await app(page, 'app.stale.value')) && (await app(page, `app.scene.value.objects.length`)) === objects, 'the room stands as before');

  // A page saved with a dropped mesh holds it.
  await drop(page, [['c.ply', ply]]);
  await until(page, `app.scene.value.objects.length === ${objects + 1}`, 60);
  const [download] = await Promise.all([
    page.waitForEvent('download'),
    (async () => {
      await page.click('[aria-label="Share and export"]');
      await page.click('[role=menuitem]:has-text("This page")');
    })(),
  ]);
  await download.saveAs(`${folder}/saved.html`);
  const again = await open(chrome, `${folder}/saved.html`, { width: 480, height: 360 });
  await ready(again.page);
  check((await app(again.page, 'app.scene.value.objects.length')) === objects + 1 && (await text(again.page)) === (await text(page)), 'a saved page holds the scene and the mesh');
  check(again.errors.length === 0, `no error on its console ${again.errors}`);
  await again.page.context().close();
  check(requests.length === 0, `no request left the page ${requests}`);
  check(errors.length === 0, `no error on the console ${errors}`);
  await page.context().close();
}

{
  const { page, errors } = await open(chrome, emptyFile, { width: 480, height: 360 });
  await page.waitForSelector('#empty');
  await drop(page, [['c.ply', ply]]);
  await ready(page);
  await until(page, 'app.scene.value.objects.length === 1', 60);
  check(true, 'a mesh on the empty page makes a room around it');
  await app(page, '(app.document_.undo(), 0)');
  check((await text(page)) === '', 'and undo leads back to the empty text');
  check(errors.length === 0, `no error on the console ${errors}`);
  await page.context().close();
}
await chrome.close();
finish();
