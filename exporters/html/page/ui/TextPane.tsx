import { setDiagnostics, type Diagnostic as Mark } from '@codemirror/lint';
import { EditorView } from '@codemirror/view';
import { effect } from '@preact/signals';
import { useEffect, useRef } from 'preact/hooks';
import * as app from '../state/app';
import type { Diagnostic } from '../state/reply';
import { Icon } from './icons';
import { upperFirst } from './words';

function range(view: EditorView, d: Diagnostic): { from: number; to: number } {
  const doc = view.state.doc;
  if (d.line < 1 || d.line > doc.lines) return { from: 0, to: Math.min(1, doc.length) };
  const line = doc.line(d.line);
  // Columns count code points.
  const points = [...line.text];
  const begin = points.slice(0, d.column - 1).join('').length;
  const length = points.slice(d.column - 1, d.column - 1 + Math.max(1, d.length)).join('').length;
  const from = Math.min(line.to, line.from + begin);
  return { from, to: Math.min(line.to, from + Math.max(1, length)) };
}

export function TextPane() {
  const host = useRef<HTMLDivElement>(null);
  useEffect(() => {
    const view = new EditorView({
      state: app.document_.current(),
      parent: host.current!,
      dispatchTransactions(transactions, self) {
        self.update(transactions);
        if (transactions.some((t) => t.docChanged)) app.document_.noticed(self.state);
      },
    });
    app.document_.attach(view);
    const stop = effect(() => {
      const marks: Mark[] = app.diagnostics.value.map((d) => ({
        ...range(view, d),
        severity: d.severity === 'note' ? 'info' : d.severity,
        message: upperFirst(d.message) + (d.hint ? `\n${upperFirst(d.hint)}` : ''),
        source: d.code,
      }));
      queueMicrotask(() => view.dispatch(setDiagnostics(view.state, marks)));
    });
    return () => {
      stop();
      app.document_.attach(null);
      view.destroy();
    };
  }, []);
  return (
    <div class="view text" role="tabpanel">
      <div ref={host} class="editor" />
      <div class="diagnostics" aria-live="polite">
        {app.diagnostics.value.slice(0, 6).map((d) => (
          <p class={d.severity} key={d.code + d.line + d.column}>
            <Icon name="warn" />
            <span>
              <b>{upperFirst(d.message)}</b>
              {d.hint && <span> {upperFirst(d.hint)}.</span>}
              <span class="dim caption">
                {' '}
                {d.code}
                {d.line > 0 && `, line ${d.line}`}
              </span>
            </span>
          </p>
        ))}
      </div>
    </div>
  );
}
