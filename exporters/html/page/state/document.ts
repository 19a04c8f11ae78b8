/** The text of the scene: the only state of a page that is worth keeping. All panes change it through here, so that there is one history. */
import { history, isolateHistory, redo, redoDepth, undo, undoDepth } from '@codemirror/commands';
import { EditorState, Transaction, type Extension, type TransactionSpec } from '@codemirror/state';
import type { EditorView } from '@codemirror/view';
import { signal } from '@preact/signals';
import type { Splice } from './splice';

export class SceneText {
  private state: EditorState;
  private view: EditorView | null = null;
  private held: string | null = null;
  readonly text = signal('');
  readonly canUndo = signal(false);
  readonly canRedo = signal(false);

  constructor(text: string, readonly extensions: Extension[] = []) {
    this.state = EditorState.create({ doc: text, extensions: [history({ newGroupDelay: 400 }), ...extensions] });
    this.text.value = text;
  }

  /** Begins with a text, without a history. */
  start(text: string): void {
    this.state = EditorState.create({ doc: text, extensions: [history({ newGroupDelay: 400 }), ...this.extensions] });
    this.noticed(this.state);
  }

  /** One step of the history. */
  apply(splice: Splice | undefined): void {
    if (!splice) return;
    this.dispatch({ changes: splice, annotations: isolateHistory.of('full'), scrollIntoView: true });
  }
  replaceAll(text: string): void {
    this.dispatch({ changes: { from: 0, to: this.text.value.length, insert: text }, annotations: isolateHistory.of('full') });
  }
  /** While something is dragged: changes that are no steps of their own. `release` makes one step of them, `cancel` takes them back. */
  drag(make: (text: string) => Splice | undefined): void {
    this.held ??= this.text.value;
    const splice = make(this.held);
    if (!splice) return;
    const whole = this.held.slice(0, splice.from) + splice.insert + this.held.slice(splice.to);
    this.silently(whole);
  }
  /** The text as it was before the drag; null: nothing is dragged. */
  heldText(): string | null {
    return this.held;
  }
  release(): void {
    if (this.held === null) return;
    const final = this.text.value, before = this.held;
    this.held = null;
    if (final === before) return;
    this.silently(before);
    const splice = difference(before, final);
    this.dispatch({ changes: splice, annotations: isolateHistory.of('full') });
  }
  cancel(): void {
    if (this.held === null) return;
    const before = this.held;
    this.held = null;
    this.silently(before);
  }
  undo(): void {
    undo({ state: this.current(), dispatch: (t) => this.take(t) });
  }
  redo(): void {
    redo({ state: this.current(), dispatch: (t) => this.take(t) });
  }

  /** The editor shows the text from now on; null: it is closed. */
  attach(view: EditorView | null): void {
    if (this.view && !view) this.state = this.view.state;
    this.view = view;
  }
  current(): EditorState {
    return this.view ? this.view.state : this.state;
  }
  /** Of an editor: what it has changed. */
  noticed(state: EditorState): void {
    this.state = state;
    this.text.value = state.doc.toString();
    this.canUndo.value = undoDepth(state) > 0;
    this.canRedo.value = redoDepth(state) > 0;
  }

  private silently(text: string): void {
    this.dispatch({ changes: difference(this.text.value, text), annotations: Transaction.addToHistory.of(false) });
  }
  private dispatch(spec: TransactionSpec): void {
    this.take(this.current().update(spec));
  }
  private take(transaction: Transaction): void {
    if (this.view) this.view.dispatch(transaction);
    else this.noticed(transaction.state);
  }
}

/** The one change that leads from a text to another. */
export function difference(before: string, after: string): Splice {
  let from = 0;
  while (from < before.length && from < after.length && before[from] === after[from]) ++from;
  let end = before.length, to = after.length;
  while (end > from && to > from && before[end - 1] === after[to - 1]) --end, --to;
  return { from, to: end, insert: after.slice(from, to) };
}
