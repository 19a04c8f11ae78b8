/** The keys of scenes for completion, from the same schema that editors use. */
import schema from '../../../../schema/orbc-scene.schema.json';

interface Part {
  description?: string;
  properties?: Record<string, Part>;
  [key: string]: unknown;
}

function collect(part: unknown, into: Map<string, string>): void {
  if (Array.isArray(part)) return part.forEach((p) => collect(p, into));
  if (!part || typeof part !== 'object') return;
  for (const [key, value] of Object.entries((part as Part).properties ?? {})) if (!into.has(key)) into.set(key, value?.description ?? '');
  for (const value of Object.values(part)) collect(value, into);
}
const found = new Map<string, string>();
collect(schema, found);
export const schemaKeys = [...found].map(([key, info]) => ({ key, info })).sort((a, b) => (a.key < b.key ? -1 : 1));
