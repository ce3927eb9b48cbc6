/** What is selected: the finding, the place of the cursor, and the view. */

import { computed, signal } from "@preact/signals";
import type { Rule } from "../api/types";
import { rules } from "./analysis";

export const VIEWS = ["situation", "timeline", "compare", "cases"] as const;
export type View = (typeof VIEWS)[number];

export const view = signal<View>("situation");
export const selectedFinding = signal<string | null>(null);
/** The place of the cursor in the present text. */
export const cursor = signal(0);
/** The rule at the cursor. While the text has problems, its place may be a few characters off. */
export const ruleAtCursor = computed<Rule | null>(
  () => rules.value.find((rule) => rule.start <= cursor.value && cursor.value <= rule.end) ?? null,
);
