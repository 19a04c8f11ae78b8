// The room of the page against the tracer of the program, pixel by pixel: node pictures.mjs WIDTH HEIGHT PAGE OUTPUT [PAGE OUTPUT …]
// Each output gets the page's pixels, 4 bytes each, rows from top to bottom.
import { writeFileSync } from 'node:fs';
import { app, browser, open, ready, until } from './browser.mjs';

const [width, height, ...files] = process.argv.slice(2);
const chrome = await browser();
for (let i = 0; i < files.length; i += 2) {
  const { page, errors, requests } = await open(chrome, files[i], { width: +width, height: +height });
  await ready(page);
  await app(page, '(walk().exact = true, walk().touch(), 0)');
  await until(page, 'walk().smoothed >= 1 && !walk().dirty');
  const pixels = await page.evaluate(() => {
    let text = '';
    for (const byte of orbc.app.view.read()) text += String.fromCharCode(byte);
    return btoa(text);
  });
  writeFileSync(files[i + 1], Buffer.from(pixels, 'base64'));
  if (errors.length || requests.length) console.log(JSON.stringify({ page: files[i], errors, requests }));
  await page.context().close();
}
await chrome.close();
