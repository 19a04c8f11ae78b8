// The page's exports: node exports.mjs PAGE STEM [PAGE STEM …] writes STEM.glb, STEM.pov (with its atlas) and STEM.svg of each page's scene.
import { writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { browser, open, ready } from './browser.mjs';

const files = process.argv.slice(2);
const chrome = await browser();
for (let i = 0; i < files.length; i += 2) {
  const { page, errors, requests } = await open(chrome, files[i], { width: 480, height: 360 });
  await ready(page);
  for (const format of ['glb', 'pov', 'svg']) {
    const begin = Date.now();
    const reply = await page.evaluate(async (wanted) => {
      const made = await orbc.app.exportScene(wanted, null);
      return { diagnostics: made.diagnostics, files: made.files.map((file) => {
        let text = '';
        for (const byte of file.bytes) text += String.fromCharCode(byte);
        return [file.name, btoa(text)];
      }) };
    }, format);
    for (const [name, data] of reply.files) writeFileSync(name ? join(dirname(files[i + 1]), name) : `${files[i + 1]}.${format}`, Buffer.from(data, 'base64'));
    const wrong = reply.diagnostics.filter((d) => d.severity === 'error');
    if (wrong.length > 0) console.log(JSON.stringify(wrong));
    if (process.env.TIMES) console.error(`${files[i + 1]}.${format}: ${Date.now() - begin} ms`);
  }
  if (errors.length || requests.length) console.log(JSON.stringify({ page: files[i], errors, requests }));
  await page.context().close();
}
await chrome.close();
