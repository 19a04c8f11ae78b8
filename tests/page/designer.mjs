// The page by hand: node designer.mjs PAGE EMPTY_PAGE. PAGE holds a pentagon with a comment in its text and an object called "statue".
import { readFileSync } from 'node:fs';
import { app, browser, check, finish, open, ready, until } from './browser.mjs';

const [file, emptyFile] = process.argv.slice(2);
const axe = readFileSync('node_modules/axe-core/axe.min.js', 'utf8');
const chrome = await browser();
const violations = async (page) =>
  (await page.evaluate(`${axe}; axe.run(document, { resultTypes: ['violations'] }).then((r) => r.violations.map((v) => v.id + ': ' + v.nodes.map((n) => n.html.slice(0, 90)).join(' | ')))`));
const text = (page) => app(page, 'app.text.value');

{
  const { page, errors, requests } = await open(chrome, file, { width: 720, height: 560 });
  await ready(page);
  const before = await text(page);
  check((await page.textContent('#tiling .name')).includes('*22222'), 'the tiling names the orbifold');

  const at = await app(page, '[...app.eye.value.roomFromEye]');
  await page.focus('#room');
  await page.keyboard.down('w');
  await until(page, `Math.abs(app.eye.value.roomFromEye[3] - ${at[3]}) + Math.abs(app.eye.value.roomFromEye[6] - ${at[6]}) > 0.02`);
  await page.keyboard.up('w');
  check(true, 'the key W walks');
  check(await app(page, 'app.scene.value.room.walls.every((w) => w.line[0] * app.eye.value.roomFromEye[0] + w.line[1] * app.eye.value.roomFromEye[3] + w.line[2] * app.eye.value.roomFromEye[6] > 0)'), 'and stays in the room');

  await page.keyboard.press('Enter');
  await page.waitForSelector('#panel');
  check(true, 'Enter opens the design');
  const found = await violations(page);
  check(found.length === 0, `axe finds no violations in design ${found}`);

  await page.focus('.handle');
  await page.keyboard.press('ArrowUp');
  await until(page, "app.scene.value.orbifold.notation === '*32222'");
  check((await text(page)) === before.replace('*22222', '*32222'), 'one step of a corner changes the notation in the text and nothing else');
  check((await page.textContent('.sum strong')) === '−⅓', 'the sum follows');
  await page.keyboard.press('Control+z');
  await until(page, "app.scene.value.orbifold.notation === '*22222'");
  check((await text(page)) === before, 'one undo takes it back, comments and all');

  await app(page, "(app.selection.value = { kind: 'object', index: 0 }, 0)");
  await page.fill('[aria-label="From centre, number"]', '0.2');
  await page.keyboard.press('Tab');
  await until(page, '/polar: \\[0.2, /.test(app.text.value)');
  check((await text(page)).split('\n').filter((line, i) => line !== before.split('\n')[i]).length === 1, 'moving an object changes one line');
  await app(page, '(app.document_.undo(), 0)');

  await page.click('[role=tab]:nth-child(2)');
  await page.waitForSelector('.cm-content');
  const textFound = await violations(page);
  check(textFound.length === 0, `axe finds no violations beside the text ${textFound}`);
  await app(page, "(app.document_.replaceAll(app.text.value.replace('height: 0.9', 'height: tall')), 0)");
  await until(page, 'app.stale.value');
  check((await page.textContent('#status')).includes('Last good picture'), 'what is wrong keeps the last good picture');
  check((await page.textContent('.diagnostics')).length > 10, 'and is explained beside the text');
  await app(page, '(app.document_.undo(), 0)');
  await until(page, '!app.stale.value');
  check((await text(page)) === before, 'undo takes it back');

  const link = await page.evaluate(async () => {
    const { text } = orbc.app;
    document.querySelector('[aria-label="Share and export"]').click();
    await new Promise((done) => setTimeout(done, 800));
    return [document.querySelector('[role=menu]').textContent, text.value.length];
  });
  check(/\d+ characters/.test(link[0]), 'the link is offered with its length');
  check(requests.length === 0, `no request left the page ${requests}`);
  check(errors.length === 0, `no error on the console ${errors}`);
  await page.context().close();
}

{
  const { page, errors } = await open(chrome, emptyFile, { width: 720, height: 560 });
  await page.waitForSelector('#empty');
  const found = await violations(page);
  check(found.length === 0, `axe finds no violations on the empty page ${found}`);
  await page.fill('#empty .field', '*2323');
  await page.keyboard.press('Enter');
  await until(page, "app.scene.value && app.scene.value.orbifold.notation === '*2323'");
  check(true, 'a notation alone makes a room');
  await app(page, '(app.document_.undo(), 0)');
  await page.waitForSelector('#empty');
  check((await text(page)) === '', 'undo leads back to the empty text');
  const big = await page.evaluate(async () => {
    const data = new DataTransfer();
    data.items.add(new File([new Uint8Array(100 << 20)], 'big.yaml'));
    dispatchEvent(new DragEvent('drop', { dataTransfer: data, cancelable: true }));
    await new Promise((done) => setTimeout(done, 300));
    return orbc.app.message.value;
  });
  check(/100 MB/.test(big), `a file of 100 MB is refused: ${big}`);
  check(errors.length === 0, `no error on the console ${errors}`);
  await page.context().close();
}
await chrome.close();
finish();
