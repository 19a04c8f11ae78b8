/** Files into the page: scenes, meshes with what they refer to, pictures. What cannot be taken is said, and changes nothing. */
import * as app from '../state/app';
import { append, applied, set, type Path, type Splice } from '../state/splice';
import { difference } from '../state/document';

const megabyte = 1 << 20;
const limits = { scene: 4, mesh: 64, picture: 32, companion: 32 } as const; // megabytes
type Kind = keyof typeof limits;
const endings: [RegExp, Kind, string][] = [
  [/\.ya?ml$/i, 'scene', 'a scene'],
  [/\.(obj|ply|stl|off|glb|gltf)$/i, 'mesh', 'a mesh'],
  [/\.(png|jpe?g|webp|bmp|gif|avif)$/i, 'picture', 'a picture'],
  [/\.(mtl|bin)$/i, 'companion', 'such a file'],
];

export function openFile(): void {
  const input = document.createElement('input');
  input.type = 'file';
  input.multiple = true;
  input.accept = '.yaml,.yml,.obj,.ply,.stl,.off,.glb,.gltf,.mtl,.bin,.png,.jpg,.jpeg,.webp';
  input.onchange = () => input.files && void take([...input.files]);
  input.click();
}

interface Taken {
  file: File;
  kind: Kind;
}

/** Makes: why a file is refused by its name or size; nothing if it is not. */
function refusal(file: File): string | undefined {
  const found = endings.find(([ending]) => ending.test(file.name));
  if (!found) return `“${file.name}” is no scene (YAML), mesh (OBJ, PLY, STL, OFF, GLB, glTF) or picture (PNG, JPEG)`;
  const most = limits[found[1]];
  if (file.size > most * megabyte) return `“${file.name}” has ${(file.size / megabyte).toFixed(0)} MB; ${found[2]} has at most ${most} MB here`;
  return undefined;
}

export async function take(files: File[]): Promise<void> {
  app.message.value = '';
  const wrong = files.map(refusal).find((why) => why !== undefined);
  if (wrong) {
    app.message.value = `${wrong}. Nothing was changed.`;
    return;
  }
  const taken: Taken[] = files.map((file) => ({ file, kind: endings.find(([ending]) => ending.test(file.name))![1] }));
  const of = (kind: Kind) => taken.filter((t) => t.kind === kind).map((t) => t.file);
  try {
    // What meshes refer to comes first.
    const pictures: string[] = [];
    for (const file of of('picture')) {
      app.addFile(file.name, await pictureBytes(file));
      pictures.push(file.name);
    }
    for (const file of of('companion')) app.addFile(file.name, new Uint8Array(await file.arrayBuffer()));
    const meshes: string[] = [];
    for (const file of of('mesh')) if (await takeMesh(file)) meshes.push(file.name);
    if (meshes.length < of('mesh').length) return;
    const scenes = of('scene');
    if (scenes[0]) app.document_.replaceAll(await scenes[0].text());
    else if (meshes.length > 0) placeMeshes(meshes);
    else if (pictures[0] && !app.text.value.includes(pictures[0])) useTexture(pictures[0]);
    app.reread();
  } catch (error) {
    app.message.value = `${String(error instanceof Error ? error.message : error)}. Nothing was changed.`;
  }
}

/** A picture as the core reads it: PNG and JPEG as they are, all else through the browser. */
async function pictureBytes(file: File): Promise<Uint8Array> {
  let picture: ImageBitmap;
  try {
    picture = await createImageBitmap(file);
  } catch {
    throw new Error(`“${file.name}” is damaged, or no picture that this browser reads`);
  }
  if (/\.(png|jpe?g)$/i.test(file.name)) return new Uint8Array(await file.arrayBuffer());
  const canvas = new OffscreenCanvas(picture.width, picture.height);
  canvas.getContext('2d')!.drawImage(picture, 0, 0);
  return new Uint8Array(await (await canvas.convertToBlob({ type: 'image/png' })).arrayBuffer());
}

async function takeMesh(file: File): Promise<boolean> {
  const reply = await app.addMesh(file.name, new Uint8Array(await file.arrayBuffer()));
  const told = reply.diagnostics.find((d) => d.severity === 'error') ?? reply.diagnostics[0];
  if (told) {
    const sentence = [told.message, told.hint].filter(Boolean).join('; ');
    app.message.value = `${sentence}.${reply.triangles === undefined ? ' Nothing was changed.' : ''}`;
  }
  return reply.triangles !== undefined;
}

const after = (text: string, splice: Splice | undefined): string => (splice ? applied(text, splice) : text);

/** Meshes that the text does not name yet stand in the room, a quarter as large as it has space: the first in the middle, others around it,
 *  since of two alike in one place the core would leave out one. */
function placeMeshes(names: string[]): void {
  let next = app.text.value.trim() === '' ? 'orbc: 1\norbifold: "*22222"\n' : app.text.value;
  const height = app.scene.value?.room.height ?? 1;
  const size = Number((0.25 * Math.min(height, app.scene.value ? 2 * app.scene.value.room.inradius : 1)).toPrecision(2));
  let placed = 0, number = app.scene.value?.objects.length ?? 0;
  const around = Number((0.5 * (app.scene.value?.room.inradius ?? 0.5)).toPrecision(2));
  for (const name of names)
    if (!next.includes(name)) {
      const place = number === 0 ? 'centre' : `{polar: [${around}, ${(number * 137) % 360}deg]}`; // 137°: the golden angle
      ++number;
      next = after(next, append(next, ['objects'], `{mesh: ${JSON.stringify(name)}, size: ${size}, at: ${place}}`));
      ++placed;
    }
  if (placed === 0) return;
  const count = app.scene.value?.objects.length ?? 0;
  app.document_.apply(difference(app.text.value, next));
  app.selection.value = { kind: 'object', index: count };
}

/** A picture becomes the texture of the chosen object, else of the floor. */
function useTexture(name: string): void {
  const chosen = app.selection.value;
  const path: Path = chosen.kind === 'object' && app.mode.value === 'design' ? [...app.objectPath(chosen.index), 'material'] : ['room', 'floor'];
  if (app.text.value.trim() === '') {
    app.message.value = `“${name}” is kept: open a room first, and drop it on that. Nothing was changed.`;
    return;
  }
  app.document_.apply(set(app.text.value, path, `{texture: ${JSON.stringify(name)}}`));
}
