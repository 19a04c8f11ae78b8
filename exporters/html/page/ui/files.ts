/** Files out of the page. All stays on this machine. */
import * as app from '../state/app';
import { eyeNumbers } from '../room/eye';
import { deflated } from '../state/share';
import { zip } from './zip';

export function saveFile(name: string, content: BlobPart, type: string): void {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob([content], { type }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}
export function savePicture(): void {
  app.view?.canvas.toBlob((blob) => blob && saveFile('room.png', blob, 'image/png'));
}

/** The page as it came, with the scene of now and the files that were dropped on it. */
export async function savePage(): Promise<void> {
  const put = (page: string, id: string, value: unknown): string =>
    page.replace(new RegExp(`(<script type="application/json" id="${id}">)[\\s\\S]*?(</script>)`), (_, a: string, b: string) => a + JSON.stringify(value).replace(/</g, '\\u003c') + b);
  let copy = put(pristine, 'scene', app.text.value);
  if (app.filesChanged) copy = put(copy, 'assets', await Promise.all([...app.files()].map(async ([name, bytes]) => [name, base64(await deflated(bytes))])));
  saveFile('room.html', copy, 'text/html');
}
function base64(bytes: Uint8Array): string {
  let binary = '';
  for (let i = 0; i < bytes.length; i += 0x8000) binary += String.fromCharCode(...bytes.subarray(i, i + 0x8000));
  return btoa(binary);
}
let pristine = '';
export function rememberPage(): void {
  pristine = '<!doctype html>\n' + document.documentElement.outerHTML;
}

/** What the core writes, seen by the eye of now; what has several files becomes an archive. */
export async function saveExport(format: 'glb' | 'pov' | 'svg'): Promise<void> {
  const eye = app.eye.value;
  const moved = eye !== null && eye !== app.home;
  try {
    const reply = await app.exportScene(format, moved ? eyeNumbers(eye) : null);
    const [main, ...beside] = reply.files;
    if (!main) {
      const wrong = reply.diagnostics.find((d) => d.severity === 'error');
      app.message.value = `No ${format.toUpperCase()} was made: ${wrong ? [wrong.message, wrong.hint].filter(Boolean).join('; ') : 'the scene has errors'}.`;
    } else if (beside.length === 0) saveFile(`scene.${format}`, main.bytes as BlobPart, { glb: 'model/gltf-binary', pov: 'text/plain', svg: 'image/svg+xml' }[format]);
    else saveFile(`scene-${format}.zip`, zip([{ name: `scene.${format}`, bytes: main.bytes }, ...beside]), 'application/zip');
  } catch (error) {
    app.message.value = `No ${format.toUpperCase()} was made: ${String(error instanceof Error ? error.message : error)}. Your scene is safe; the program orbc has more memory than a page.`;
  }
}
