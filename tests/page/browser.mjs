// What the tests of the designer's page share: a browser without a network, and what it said.
import { chromium } from 'playwright-core';

export async function browser() {
  return chromium.launch({
    executablePath: '/usr/bin/chromium',
    headless: true,
    args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-quic', '--no-first-run', '--disable-background-networking',
      '--host-resolver-rules=MAP * ~NOTFOUND'],
  });
}

/** A page of its own, with its errors and the requests that it made. */
export async function open(chrome, file, { width = 800, height = 600, touch = false, light = false, hash = '' } = {}) {
  const context = await chrome.newContext({ viewport: { width, height }, deviceScaleFactor: 1, colorScheme: light ? 'light' : 'dark', hasTouch: touch });
  const page = await context.newPage();
  page.setDefaultTimeout(300_000);
  const errors = [], requests = [];
  page.on('console', (m) => m.type() === 'error' && errors.push(m.text()));
  page.on('pageerror', (e) => errors.push(String(e)));
  page.on('request', (r) => /^(file|data|blob):/.test(r.url()) || requests.push(r.url()));
  await page.goto('file://' + file + hash);
  return { page, errors, requests };
}

export const ready = (page) => page.waitForSelector('html[data-ready="1"]', { state: 'attached' });
export const app = (page, expression) => page.evaluate(`(() => { const { app, walk } = orbc; return ${expression}; })()`);
/** Waits until an expression of the page is true. (Playwright's own way would need eval, which the page's policy forbids.) */
export async function until(page, expression, seconds = 240) {
  for (const end = Date.now() + 1000 * seconds; Date.now() < end; await page.waitForTimeout(100)) if (await app(page, expression)) return;
  throw new Error(`never true: ${expression}`);
}

let failed = 0;
export function check(fine, what) {
  console.log((fine ? 'ok      ' : 'FAILED  ') + what);
  if (!fine) ++failed;
}
export function finish() {
  console.log(failed ? `${failed} failed` : 'all passed');
  process.exit(failed ? 1 : 0);
}
