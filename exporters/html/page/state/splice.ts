/** Edits of a scene's text by keys: each is one splice, which leaves all else as the author wrote it, comments and order included. */
import { parser } from '@lezer/yaml';
import type { SyntaxNode } from '@lezer/common';

export interface Splice {
  from: number;
  to: number;
  insert: string;
}
export type Path = (string | number)[];

const isMap = (n: SyntaxNode) => n.name === 'BlockMapping' || n.name === 'FlowMapping';
const isList = (n: SyntaxNode) => n.name === 'BlockSequence' || n.name === 'FlowSequence';
const values = new Set(['Literal', 'QuotedLiteral', 'BlockLiteral', 'BlockMapping', 'FlowMapping', 'BlockSequence', 'FlowSequence']);

function children(n: SyntaxNode, wanted: (child: SyntaxNode) => boolean): SyntaxNode[] {
  const out: SyntaxNode[] = [];
  for (let c = n.firstChild; c; c = c.nextSibling) if (wanted(c)) out.push(c);
  return out;
}
const unquoted = (text: string) => text.replace(/^(["'])(.*)\1$/, '$2');
const keyOf = (text: string, pair: SyntaxNode) => {
  const key = pair.getChild('Key');
  return key ? unquoted(text.slice(key.from, key.to).trim()) : '';
};
const valueOf = (pair: SyntaxNode): SyntaxNode | null => children(pair, (c) => values.has(c.name)).pop() ?? null;

function root(text: string): SyntaxNode | null {
  const document = parser.parse(text).topNode.getChild('Document');
  return document ? (children(document, (c) => values.has(c.name))[0] ?? null) : null;
}
function entries(text: string, n: SyntaxNode): { name: string | number; node: SyntaxNode; value: SyntaxNode | null }[] {
  if (isMap(n)) return children(n, (c) => c.name === 'Pair').map((pair) => ({ name: keyOf(text, pair), node: pair, value: valueOf(pair) }));
  if (!isList(n)) return [];
  return children(n, (c) => c.name === 'Item').map((item, i) => ({ name: i, node: item, value: children(item, (c) => values.has(c.name))[0] ?? null }));
}

/** The text of a value, or undefined. */
export function get(text: string, path: Path): string | undefined {
  let n = root(text);
  for (const key of path) {
    if (!n) return undefined;
    n = entries(text, n).find((e) => e.name === key)?.value ?? null;
  }
  return n ? text.slice(n.from, n.to).trim() : undefined;
}
/** The scalar of a value without its quotes, or undefined. */
export const getScalar = (text: string, path: Path): string | undefined => {
  const value = get(text, path);
  return value === undefined ? undefined : unquoted(value);
};
/** The range of a value. */
export function rangeOf(text: string, path: Path): { from: number; to: number } | undefined {
  let n = root(text);
  for (const key of path) n = n ? (entries(text, n).find((e) => e.name === key)?.value ?? null) : null;
  return n ? { from: n.from, to: n.to } : undefined;
}
/** The keys of a map, or the indices of a list. */
export function keysAt(text: string, path: Path): (string | number)[] {
  let n = root(text);
  for (const key of path) n = n ? (entries(text, n).find((e) => e.name === key)?.value ?? null) : null;
  return n ? entries(text, n).map((e) => e.name) : [];
}

const columnOf = (text: string, at: number) => at - (text.lastIndexOf('\n', at - 1) + 1);
const firstLetter = (text: string, n: SyntaxNode) => n.from + (/^\s*/.exec(text.slice(n.from, n.to))?.[0].length ?? 0);
const lineEnd = (text: string, at: number) => {
  const end = text.indexOf('\n', at);
  return end < 0 ? text.length : end;
};
/** Where a block value ends: without the blank lines and comments that follow it. */
const trimmedEnd = (text: string, n: SyntaxNode) => n.from + text.slice(n.from, n.to).trimEnd().length;

function nested(path: Path, value: string): string {
  return path.length === 0 ? value : `{${path.map((key, i) => (i === 0 ? `${key}: ` : `{${key}: `)).join('')}${value}${'}'.repeat(path.length)}`;
}

/** Sets a value; maps that are missing on the way are made. In: `value` as YAML, on one line. Makes: undefined where the path leads into
 *  something that is no map. */
export function set(text: string, path: Path, value: string): Splice | undefined {
  const whole = root(text);
  if (!whole) return path.length === 0 ? undefined : { from: text.length, to: text.length, insert: `${text === '' || text.endsWith('\n') ? '' : '\n'}${path[0]}: ${nested(path.slice(1), value)}\n` };
  let n: SyntaxNode = whole;
  for (let depth = 0; depth < path.length; ++depth) {
    const entry: ReturnType<typeof entries>[number] | undefined = entries(text, n).find((e) => e.name === path[depth]);
    const rest = path.slice(depth + 1);
    if (!entry) return insertInto(text, n, path[depth]!, nested(rest, value));
    if (!entry.value) {
      const colon = entry.node.to;
      return { from: colon, to: colon, insert: ` ${nested(rest, value)}` };
    }
    if (depth === path.length - 1) {
      const begin = firstLetter(text, entry.value);
      const block = entry.value.name.startsWith('Block');
      if (!block) return { from: begin, to: entry.value.to, insert: value };
      // A block becomes a value on the line of its key.
      const colon = isMap(n) ? text.indexOf(':', entry.node.getChild('Key')!.to) + 1 : entry.node.from;
      return { from: colon, to: trimmedEnd(text, entry.value), insert: ` ${value}` };
    }
    if (!isMap(entry.value) && !isList(entry.value)) return { from: entry.value.from, to: entry.value.to, insert: nested(rest, value) };
    n = entry.value;
  }
  return undefined;
}

function insertInto(text: string, n: SyntaxNode, key: string | number, value: string): Splice | undefined {
  const own = entries(text, n);
  if (n.name === 'FlowMapping' || n.name === 'FlowSequence') {
    const close = n.to - 1;
    const end = n.from + text.slice(n.from, close).trimEnd().length;
    const entry = n.name === 'FlowMapping' ? `${key}: ${value}` : value;
    return { from: end, to: close, insert: own.length > 0 ? `, ${entry}` : entry };
  }
  if (own.length === 0) return undefined;
  const last = own[own.length - 1]!.node;
  const indent = ' '.repeat(columnOf(text, n.name === 'BlockMapping' ? firstLetter(text, own[0]!.node) : text.lastIndexOf('-', own[0]!.node.from)));
  const at = lineEnd(text, trimmedEnd(text, last));
  const entry = n.name === 'BlockMapping' ? `${key}: ${value}` : `- ${value}`;
  return { from: at, to: at, insert: `\n${indent}${entry}` };
}

/** Adds an entry to a list at the end; the list is made if it is missing. */
export function append(text: string, path: Path, value: string): Splice | undefined {
  const count = keysAt(text, path).length;
  if (count > 0) return set(text, [...path, count], value);
  const there = get(text, path);
  if (there === undefined && path.length === 1) {
    const gap = text === '' || text.endsWith('\n') ? '' : '\n';
    return { from: text.length, to: text.length, insert: `${gap}${path[0]}:\n  - ${value}\n` };
  }
  return set(text, path, `[${value}]`);
}

/** Removes an entry with its lines or its comma; a list or map that would be empty goes too. */
export function remove(text: string, path: Path): Splice | undefined {
  let n = root(text);
  for (const key of path.slice(0, -1)) n = n ? (entries(text, n).find((e) => e.name === key)?.value ?? null) : null;
  if (!n) return undefined;
  const own = entries(text, n);
  const i = own.findIndex((e) => e.name === path[path.length - 1]);
  if (i < 0) return undefined;
  if (own.length === 1 && path.length > 1) return remove(text, path.slice(0, -1));
  if (n.name.startsWith('Flow')) {
    const begin = i > 0 ? own[i - 1]!.node.to : own[0]!.node.from;
    return { from: begin, to: i > 0 ? own[i]!.node.to : firstLetter(text, own[1]!.node), insert: '' };
  }
  const start = n.name === 'BlockMapping' ? firstLetter(text, own[i]!.node) : text.lastIndexOf('-', own[i]!.node.from);
  const end = lineEnd(text, trimmedEnd(text, own[i]!.node));
  const lineStart = text.lastIndexOf('\n', start - 1) + 1;
  // The first key of a map in a list stands on the line of the dash: the next key moves there.
  if (text.slice(lineStart, start).trim() !== '' && own[i + 1]) return { from: start, to: firstLetter(text, own[i + 1]!.node), insert: '' };
  return { from: lineStart, to: Math.min(text.length, end + 1), insert: '' };
}

export const applied = (text: string, splice: Splice): string => text.slice(0, splice.from) + splice.insert + text.slice(splice.to);

/** A number as it is written into scenes: four digits, without zeros at the end. */
export function written(x: number): string {
  const rounded = Number(x.toPrecision(4));
  return Math.abs(rounded) < 1e-9 ? '0' : String(Math.abs(rounded) < 1e-3 ? Number(rounded.toFixed(6)) : rounded);
}
