/** The editor: CodeMirror in a shadow tree, joined with the state of the page. */

import { defaultKeymap, history, historyKeymap, redo, undo } from "@codemirror/commands";
import { highlightSelectionMatches, searchKeymap } from "@codemirror/search";
import { Compartment, EditorState, Transaction, type Extension } from "@codemirror/state";
import { drawSelection, EditorView, highlightActiveLine, highlightActiveLineGutter, keymap, lineNumbers } from "@codemirror/view";
import { effect } from "@preact/signals";
import type { Span } from "../api/types";
import { language, t } from "../messages";
import { analysis, answeredText, goodText, problems, sentText } from "../state/analysis";
import { editorHooks, save, text } from "../state/document";
import { cursor, selectedFinding } from "../state/selection";
import { answer } from "../state/situation";
import { highlighting } from "./highlighting";
import { marking, setMarks, type Mark } from "./marks";
import { Positions } from "./positions";
import { phrases } from "./phrases";
import { theme } from "./theme";
import { unusualCharacters } from "./unusual_characters";

let view: EditorView | null = null;
const positions = new Positions(() => [sentText, goodText.peek(), answeredText.peek(), text.peek()]);

const languageOf = new Compartment();

/** What of the editor depends on the language of the page. */
function localized(): Extension {
  return [EditorView.contentAttributes.of({ "aria-label": t("editorLabel") }), phrases()];
}

/** Puts the editor into `host`, with the text of the page. */
export function mount(host: HTMLElement): () => void {
  const root = host.attachShadow({ mode: "open" });
  const editor = new EditorView({
    root,
    parent: root,
    state: EditorState.create({
      doc: text.value,
      extensions: [
        lineNumbers(),
        history(),
        drawSelection(),
        highlightActiveLine(),
        highlightActiveLineGutter(),
        highlightSelectionMatches(),
        EditorView.lineWrapping,
        highlighting,
        unusualCharacters,
        marking,
        theme,
        keymap.of([
          { key: "Mod-s", run: () => (void save(), true), preventDefault: true },
          ...defaultKeymap,
          ...historyKeymap,
          ...searchKeymap,
        ]),
        languageOf.of(localized()),
        EditorView.contentAttributes.of({ spellcheck: "false", tabindex: "0" }),
        EditorView.updateListener.of((update) => {
          if (update.docChanged) {
            const after = update.state.doc.toString();
            positions.change(text.peek(), after, update.changes);
            text.value = after;
          }
          if (update.docChanged || update.selectionSet) cursor.value = update.state.selection.main.head;
        }),
      ],
    }),
  });
  view = editor;
  editorHooks.replace = replace;
  let frame = 0;
  editorHooks.focus = () => editor.focus();
  const follow = effect(() => {
    const inLanguage = localized();
    queueMicrotask(() => editor.dispatch({ effects: languageOf.reconfigure(inLanguage) }));
  });
  const stop = effect(() => {
    // What the marks depend on. They change with the next frame, so that the lists beside the editor come first.
    void [answer.value, analysis.value, problems.value, selectedFinding.value, language.value];
    cancelAnimationFrame(frame);
    frame = requestAnimationFrame(() => editor.dispatch({ effects: setMarks.of(currentMarks()) }));
  });
  return () => {
    stop();
    cancelAnimationFrame(frame);
    follow();
    editor.destroy();
  };
}

function currentMarks(): Mark[] {
  const length = text.peek().length;
  const good = goodText.value;
  const deciding: Mark[] = (answer.value?.rules ?? [])
    .filter((rule) => rule.clause !== null)
    .map((rule) => ({ ...positions.present(good, rule, length), kind: "deciding", text: "" }));
  const found: Mark[] = analysis.value.findings.map((finding) => ({
    ...positions.present(good, finding, length),
    kind: finding.severity,
    text: `${t(finding.severity)}: ${finding.sentence}`,
  }));
  const wrong: Mark[] = problems.value.map((problem) => ({
    ...positions.present(answeredText.value, problem, length),
    kind: "problem",
    text: problem.hint ? `${problem.message}\n${problem.hint}` : problem.message,
  }));
  const selected = analysis.value.findings.find((finding) => finding.id === selectedFinding.value);
  const chosen: Mark[] = selected ? [{ ...positions.present(good, selected, length), kind: "selected", text: "" }] : [];
  return [...deciding, ...found, ...wrong, ...chosen];
}

/** The present place of a span of the last good text. */
export function present(span: Span, of: string | null = goodText.value): Span {
  return positions.present(of, span, text.value.length);
}

/** Scrolls to a place in the present text, and puts the cursor there. */
export function goTo({ start, end }: Span): void {
  view?.dispatch({
    selection: { anchor: start, head: end },
    effects: EditorView.scrollIntoView(start, { y: "center" }),
  });
  view?.focus();
}

/** Replaces the text by one step that undo takes back. Only what differs changes, so that marks stay. */
function replace(next: string): void {
  if (!view) return;
  const now = view.state.doc.toString();
  let start = 0;
  while (start < Math.min(now.length, next.length) && now[start] === next[start]) start += 1;
  let end = 0;
  while (end < Math.min(now.length, next.length) - start && now[now.length - 1 - end] === next[next.length - 1 - end]) end += 1;
  view.dispatch({
    changes: { from: start, to: now.length - end, insert: next.slice(start, next.length - end) },
    annotations: Transaction.userEvent.of("input.replace"),
    effects: EditorView.scrollIntoView(start, { y: "center" }),
  });
}

export const undoChange = (): void => void (view && undo(view));
export const redoChange = (): void => void (view && redo(view));
