/** Two texts side by side, read-only, with their differences marked. */

import { MergeView } from "@codemirror/merge";
import { EditorState } from "@codemirror/state";
import { EditorView, lineNumbers } from "@codemirror/view";
import { highlighting } from "./highlighting";
import { phrases } from "./phrases";
import { theme } from "./theme";
import { unusualCharacters } from "./unusual_characters";

export function sideBySide(host: HTMLElement, before: string, after: string, titles: readonly [string, string]): () => void {
  const root = host.shadowRoot ?? host.attachShadow({ mode: "open" });
  const side = (doc: string, label: string) => ({
    doc,
    extensions: [
      lineNumbers(),
      highlighting,
      unusualCharacters,
      theme,
      phrases(),
      EditorView.lineWrapping,
      EditorState.readOnly.of(true),
      EditorView.contentAttributes.of({ "aria-label": label, tabindex: "0" }),
    ],
  });
  const view = new MergeView({
    a: side(before, titles[0]),
    b: side(after, titles[1]),
    parent: root,
    root,
    gutter: true,
    collapseUnchanged: { margin: 2, minSize: 5 },
  });
  return () => view.destroy();
}
