/** Marks in the text: findings, problems, the clauses that decide, and the finding that is selected. */

import { Decoration, EditorView, hoverTooltip, type DecorationSet } from "@codemirror/view";
import { StateEffect, StateField } from "@codemirror/state";
import type { Severity, Span } from "../api/types";

export interface Mark extends Span {
  kind: Severity | "problem" | "deciding" | "selected";
  text: string;
}

export const setMarks = StateEffect.define<Mark[]>();

function decorations(marks: Mark[], length: number): DecorationSet {
  return Decoration.set(
    marks
      .filter((mark) => mark.start <= length)
      .map((mark) => {
        const to = Math.min(mark.end, length);
        const from = mark.start < to ? mark.start : Math.max(0, Math.min(mark.start, length) - 1);
        return { from, to: Math.max(to, Math.min(from + 1, length)), mark };
      })
      .filter(({ from, to }) => from < to)
      .map(({ from, to, mark }) => Decoration.mark({ class: `mark-${mark.kind}`, mark }).range(from, to)),
    true,
  );
}

const marks = StateField.define<DecorationSet>({
  create: () => Decoration.none,
  update(current, transaction) {
    const mapped = current.map(transaction.changes);
    const set = transaction.effects.find((effect) => effect.is(setMarks));
    return set ? decorations(set.value as Mark[], transaction.newDoc.length) : mapped;
  },
  provide: (field) => EditorView.decorations.from(field),
});

const tooltip = hoverTooltip((view, position) => {
  const found: Mark[] = [];
  view.state.field(marks).between(position, position, (_from, _to, value) => {
    const mark = value.spec.mark as Mark;
    if (mark.text) found.push(mark);
  });
  if (found.length === 0) return null;
  return {
    pos: Math.min(...found.map((mark) => mark.start), position),
    above: true,
    create() {
      const dom = document.createElement("div");
      dom.className = "tooltip";
      for (const mark of found) {
        const line = document.createElement("p");
        line.textContent = mark.text;
        dom.append(line);
      }
      return { dom };
    },
  };
});

export const marking = [marks, tooltip];
