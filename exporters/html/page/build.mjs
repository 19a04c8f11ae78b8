// Bundles the page: node build.mjs CORE_FOLDER OUTPUT. CORE_FOLDER holds orbc-core.js and orbc-core.wasm (scripts/web).
import { build } from 'esbuild';
import { readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { deflateRawSync } from 'node:zlib';

const [coreFolder, output] = process.argv.slice(2);
const here = dirname(fileURLToPath(import.meta.url));
const bundle = async (entry) => {
  const made = await build({
    entryPoints: [join(here, entry)], bundle: true, write: false, minify: true, format: 'iife', target: 'es2022', charset: 'utf8',
    jsx: 'automatic', jsxImportSource: 'preact', loader: { '.glsl': 'text', '.vert': 'text', '.frag': 'text', '.yaml': 'text', '.jpg': 'dataurl' }, legalComments: 'none',
  });
  return made.outputFiles[0].text;
};
// Nothing in a script element may look like its end, or like a comment of HTML.
const inScript = (text) => text.replace(/<\/(script)/gi, '<\\/$1').replace(/<!--/g, '<\\!--');
const style = (await build({ entryPoints: [join(here, 'style.css')], bundle: true, write: false, minify: true })).outputFiles[0].text;
const parts = {
  'STYLE': style.trim(),
  'WASM': deflateRawSync(readFileSync(join(coreFolder, 'orbc-core.wasm')), { level: 9 }).toString('base64'),
  'CORE': inScript(readFileSync(join(coreFolder, 'orbc-core.js'), 'utf8')),
  'WORKER': inScript(await bundle('core/worker.ts')),
  'MAIN': deflateRawSync(await bundle('main.tsx'), { level: 9 }).toString('base64'),
};
const template = readFileSync(join(here, 'page.html'), 'utf8');
const page = template.replace(/\/\*STYLE\*\/|(?<=>)(WASM|CORE|WORKER|MAIN)(?=<)/g, (mark) => parts[mark.replace(/[/*]/g, '')]);
writeFileSync(output, page);
console.error(`${output}: ${(page.length / 1e6).toFixed(2)} MB`);
