/** How the text of a scene is shown and completed. */
import { autocompletion, completionKeymap, type CompletionContext, type CompletionResult } from '@codemirror/autocomplete';
import { defaultKeymap, historyKeymap } from '@codemirror/commands';
import { yaml } from '@codemirror/lang-yaml';
import { HighlightStyle, syntaxHighlighting } from '@codemirror/language';
import { lintGutter } from '@codemirror/lint';
import type { Extension } from '@codemirror/state';
import { EditorView, drawSelection, highlightActiveLine, keymap, lineNumbers } from '@codemirror/view';
import { tags } from '@lezer/highlight';
import { schemaKeys } from './schema';

const colors = HighlightStyle.define([
  { tag: [tags.propertyName, tags.definition(tags.propertyName)], color: 'var(--accent)' },
  { tag: [tags.string], color: 'var(--ok)' },
  { tag: [tags.content, tags.number], color: 'var(--warn)' },
  { tag: [tags.comment, tags.lineComment], color: 'var(--text2)' },
]);

function complete(context: CompletionContext): CompletionResult | null {
  const word = context.matchBefore(/[\w_]*/);
  if (!word || (word.from === word.to && !context.explicit)) return null;
  return { from: word.from, options: schemaKeys.map(({ key, info }) => ({ label: key, type: 'property', apply: key + ': ', info })), validFor: /^[\w_]*$/ };
}

/** The extensions of the text, whether or not it is shown; the history is SceneText's. */
export const textExtensions = (): Extension[] => [
  yaml(),
  syntaxHighlighting(colors),
  lineNumbers(),
  drawSelection(),
  highlightActiveLine(),
  lintGutter(),
  autocompletion({ override: [complete] }),
  keymap.of([...completionKeymap, ...historyKeymap, ...defaultKeymap]),
  EditorView.contentAttributes.of({ 'aria-label': 'The scene as YAML' }),
  EditorView.lineWrapping,
];
