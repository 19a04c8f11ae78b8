// What may go wrong, and what must not be lost: node trouble.mjs PAGE EMPTY_PAGE NASTY_PAGE. NASTY_PAGE has an object whose name would be a script.
import { app, browser, check, finish, open, ready, until } from './browser.mjs';

const [file, emptyFile, nastyFile] = process.argv.slice(2);
const chrome = await browser();
const text = (page) => app(page, 'app.text.value');

{
  const { page, errors } = await open(chrome, file, { width: 320, height: 240 });
  await ready(page);
  await until(page, 'app.refining.value >= 1', 90);
  await until(page, 'app.differing.value !== null', 20);
  const share = await app(page, 'app.differing.value');
  check(share < 0.2, `at rest the traced picture comes over the live one; ${(100 * share).toFixed(2)} % of so small a picture differ`);
  check(await page.evaluate("document.getElementById('truth').classList.contains('shown')"), 'and is shown');
  await page.focus('#room');
  await page.keyboard.press('x');
  await page.waitForSelector('#difference');
  check((await page.textContent('#difference')).includes('Live against traced'), 'the key X shows the difference');
  await page.keyboard.press('x');

  await app(page, "(app.document_.replaceAll(app.text.value.replace('height: 0.9', 'height: 0.8')), 0)");
  const changed = await text(page);
  await page.evaluate("document.getElementById('room').getContext('webgl2').getExtension('WEBGL_lose_context').loseContext()");
  await page.waitForSelector('#fatal');
  check(/context lost/.test(await page.textContent('#fatal')), 'a lost WebGL context is said');
  check((await text(page)) === changed, 'the text stays');
  await Promise.all([page.waitForEvent('load'), page.click('#fatal .primary')]);
  await ready(page);
  check((await text(page)) === changed, 'drawing again keeps what was changed');
  check((await page.$('#fatal')) === null, 'and there is a picture again');
  check(errors.length === 0, `no error on the console ${errors}`);
  await page.context().close();
}
{
  const { page } = await open(chrome, emptyFile, { width: 320, height: 240 });
  await page.context().addInitScript("const get = HTMLCanvasElement.prototype.getContext; HTMLCanvasElement.prototype.getContext = function (kind, ...more) { return kind === 'webgl2' ? null : get.call(this, kind, ...more); };");
  await page.goto('file://' + file);
  await page.waitForSelector('#fatal');
  check(/WebGL ?2/.test(await page.textContent('#fatal')), `without WebGL 2 the page says so: ${await page.textContent('#fatal p')}`);
  for (let i = 0; i < 100 && !(await page.evaluate("typeof orbc !== 'undefined'")); ++i) await page.waitForTimeout(100);
  await until(page, "app.text.value !== ''", 20);
  check((await text(page)).includes('statue'), 'and has the scene to save');
  await page.context().close();
}
{
  const { page } = await open(chrome, emptyFile, { width: 320, height: 240 });
  await page.waitForSelector('#empty');
  await page.fill('#empty .field', '*237');
  await page.keyboard.press('Enter');
  await ready(page);
  const typed = await text(page);
  await page.waitForTimeout(1200);
  await page.reload();
  await ready(page);
  check((await text(page)) === typed, 'what was typed comes back after the page was closed');
  await page.context().close();
}
{
  const { page, errors } = await open(chrome, nastyFile, { width: 800, height: 600 });
  await ready(page);
  check((await page.title()) === 'orbc', 'a name in the scene runs no script');
  await app(page, "(app.mode.value = 'design', 0)");
  check((await page.textContent('#panel')).includes("</script><script>document.title=1</script>]]>"), 'but is shown as it is');
  check(errors.length === 0, `no error on the console ${errors}`);
  await page.context().close();
}
{
  const { page, errors } = await open(chrome, file, { width: 844, height: 390, touch: true });
  await ready(page);
  const before = await app(page, '[...app.eye.value.roomFromEye]');
  const touch = await page.context().newCDPSession(page);
  const send = (type, points) => touch.send('Input.dispatchTouchEvent', { type, touchPoints: points });
  await send('touchStart', [{ x: 150, y: 300 }]);
  for (let i = 1; i <= 6; ++i) await send('touchMove', [{ x: 150, y: 300 - 10 * i }]);
  await page.waitForTimeout(800);
  await send('touchEnd', []);
  const after = await app(page, '[...app.eye.value.roomFromEye]');
  check(Math.hypot(after[3] - before[3], after[6] - before[6]) > 0.01, 'the left thumb walks');
  const yaw = await app(page, 'app.eye.value.yaw');
  await send('touchStart', [{ x: 650, y: 250 }]);
  for (let i = 1; i <= 6; ++i) await send('touchMove', [{ x: 650 - 15 * i, y: 250 }]);
  await send('touchEnd', []);
  check(Math.abs((await app(page, 'app.eye.value.yaw')) - yaw) > 0.02, 'the right thumb looks');
  check(errors.length === 0, `no error on the console ${errors}`);
  await page.context().close();
}
await chrome.close();
finish();
