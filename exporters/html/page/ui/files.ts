/** Files in and out. All stays on this machine. */
import * as app from '../state/app';

const largestScene = 4 << 20;

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
/** The page as it came, with the scene of now. */
export function savePage(): void {
  const copy = pristine.replace(/(<script type="application\/json" id="scene">)[\s\S]*?(<\/script>)/, (_, a: string, b: string) => a + JSON.stringify(app.text.value).replace(/</g, '\\u003c') + b);
  saveFile('room.html', copy, 'text/html');
}
let pristine = '';
export const rememberPage = (): void => void (pristine = '<!doctype html>\n' + document.documentElement.outerHTML);

export function openFile(): void {
  const input = document.createElement('input');
  input.type = 'file';
  input.accept = '.yaml,.yml,text/yaml';
  input.onchange = () => input.files?.[0] && void take(input.files[0]);
  input.click();
}
export async function take(file: File): Promise<void> {
  if (file.size > largestScene) {
    app.message.value = `“${file.name}” has ${(file.size / (1 << 20)).toFixed(0)} MB; a scene has at most 4 MB. Nothing was changed.`;
    return;
  }
  if (!/\.ya?ml$/i.test(file.name)) {
    app.message.value = `“${file.name}” is no scene (YAML). Meshes belong into the scene's folder: orbc compile scene.yaml -o scene.html. Nothing was changed.`;
    return;
  }
  const text = await file.text();
  app.message.value = '';
  app.document_.replaceAll(text);
}
