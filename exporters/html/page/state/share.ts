/** A scene as part of an address: `#s=` and the deflated text in base64url. Nothing is sent anywhere: browsers keep what follows the #. */
const largest = 1 << 20; // characters of a scene that a link may unfold to

async function through(bytes: Uint8Array, stream: CompressionStream | DecompressionStream, most = largest): Promise<Uint8Array> {
  const reader = new Blob([bytes as BlobPart]).stream().pipeThrough(stream as ReadableWritablePair<Uint8Array, Uint8Array>).getReader();
  const parts: Uint8Array[] = [];
  let size = 0;
  for (;;) {
    const { done, value } = await reader.read();
    if (done) break;
    size += value.length;
    if (size > most) throw new Error('the scene in this link is too large');
    parts.push(value);
  }
  const whole = new Uint8Array(size);
  let at = 0;
  for (const part of parts) whole.set(part, at), (at += part.length);
  return whole;
}

/** A raw deflate stream (RFC 1951). */
export const deflated = (bytes: Uint8Array): Promise<Uint8Array> => through(bytes, new CompressionStream('deflate-raw'), Infinity);

export async function linkOf(text: string): Promise<string> {
  const bytes = await deflated(new TextEncoder().encode(text));
  let binary = '';
  for (const byte of bytes) binary += String.fromCharCode(byte);
  return '#s=' + btoa(binary).replace(/\+/g, '-').replace(/\//g, '_').replace(/=+$/, '');
}

/** Makes: null for addresses without a scene. Throws for damaged ones. */
export async function sceneOf(hash: string): Promise<string | null> {
  const found = /^#s=([A-Za-z0-9_-]+)$/.exec(hash);
  if (!found) return null;
  const binary = atob(found[1]!.replace(/-/g, '+').replace(/_/g, '/'));
  const bytes = Uint8Array.from(binary, (c) => c.charCodeAt(0));
  return new TextDecoder('utf-8', { fatal: true }).decode(await through(bytes, new DecompressionStream('deflate-raw')));
}
