/** Where spans of an earlier text are in the present one, while the answer to a request is on its way. */

import { ChangeSet, type ChangeDesc } from "@codemirror/state";
import type { Span } from "../api/types";

/** Texts with the changes since each of them. Only those that an answer may still refer to are kept. */
export class Positions {
  private since = new Map<string, ChangeDesc>();

  constructor(private readonly inUse: () => readonly (string | null)[]) {}

  /** Notes a change from `before` to `after`. */
  change(before: string, after: string, changes: ChangeDesc): void {
    const used = this.inUse();
    const next = new Map<string, ChangeDesc>();
    for (const [text, earlier] of this.since) if (used.includes(text)) next.set(text, earlier.composeDesc(changes));
    if (!next.has(before) && used.includes(before)) next.set(before, changes);
    next.delete(after);
    this.since = next;
  }

  /** The span of `text` in the present text of this length. */
  present(text: string | null, span: Span, length: number): Span {
    const changes = (text !== null && this.since.get(text)) || ChangeSet.empty(length);
    const start = Math.min(changes.mapPos(Math.min(span.start, changes.length), 1), length);
    const end = Math.min(changes.mapPos(Math.min(span.end, changes.length), -1), length);
    return { start, end: Math.max(start, end) };
  }
}
