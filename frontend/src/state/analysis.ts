/** The analysis of the text: asked for after each change. The last good one stays while the text has problems. */

import { batch, computed, effect, signal } from "@preact/signals";
import { completed, type AnalysisChange } from "../api/changes";
import { Latest } from "../api/latest";
import { withOffsets } from "../api/offsets";
import { Refusal, server } from "../api/requests";
import type { Analysis, Check, Finding, Names, Problem, Rule } from "../api/types";
import { language } from "../messages";
import { failure, text } from "./document";

const SEVERITIES = ["error", "warning", "note"];

const NOTHING: Analysis = {
  sha256: "",
  version: null,
  of: null,
  problems: [],
  names: { triggers: [], conditions: [], obligations: [] },
  rules: [],
  findings: [],
  checks: [],
  verdict: null,
  seconds: 0,
};

/** The last good analysis. */
export const analysis = signal<Analysis>(NOTHING);
/** The text of that analysis. */
export const goodText = signal<string | null>(null);
/** The problems of the text that was sent last. */
export const problems = signal<Problem[]>([]);
/** The text whose problems are known: the last one with an answer. */
export const answeredText = signal<string | null>(null);
/** The analysis belongs to an earlier text. */
export const old = computed(() => goodText.value !== null && goodText.value !== text.value);
/** The answer takes long, or the server refused it. */
const late = signal(false);
/** The analysis is of an earlier text, and the page still waits for that of the present one. */
export const unanswered = computed(() => old.value && !waiting.value && (late.value || server.value !== "here"));
/** Without an answer, and for a text with problems, the findings are those of an earlier text. */
export const stale = computed(() => waiting.value || unanswered.value);
/** The text has problems, so its analysis waits. */
export const waiting = computed(() => problems.value.length > 0);

export const names = computed<Names>(() => analysis.value.names);
export const rules = computed<Rule[]>(() => analysis.value.rules);
/** The findings, errors first. */
export const findings = computed<Finding[]>(() =>
  [...analysis.value.findings].sort((a, b) => SEVERITIES.indexOf(a.severity) - SEVERITIES.indexOf(b.severity)),
);

/** What could not be decided. */
export const undecided = computed<Check[]>(() => analysis.value.checks.filter((one) => one.verdict === "unknown"));

/** The text that is being analysed, or was last. */
export let sentText: string | null = null;

/** How long the findings of an earlier text are shown without a mark, so that they do not flicker. */
const PATIENCE = 1000;

let sentLanguage = "";
let timer: number | null = null;
const latest = new Latest();

export function keepChecking(): void {
  effect(() => {
    const [sent, asked] = [text.value, language.value];
    if (server.value !== "here") sentText = null;
    else if (sent !== sentText || asked !== sentLanguage) void check(sent, asked);
  });
}

async function check(sent: string, asked: string): Promise<void> {
  sentText = sent;
  sentLanguage = asked;
  timer ??= window.setTimeout(() => (late.value = true), PATIENCE);
  let answer: AnalysisChange | null;
  try {
    answer = await latest.ask<AnalysisChange>("check", { text: sent, since: analysis.peek().version });
  } catch (error) {
    if (!(error instanceof Refusal)) throw error;
    late.value = true;
    failure.value = { message: error.message, hint: error.hint };
    return;
  }
  if (!answer) return;
  clearTimeout(timer);
  timer = null;
  batch(() => {
    late.value = false;
    answeredText.value = sent;
    problems.value = withOffsets(answer.problems, sent);
    if (answer.problems.length === 0) {
      analysis.value = completed(withOffsets(answer, sent), analysis.peek());
      goodText.value = sent;
    } else if (goodText.value !== null && answer.of === analysis.value.of) {
      // The same analysis, perhaps in another language.
      analysis.value = completed(withOffsets({ ...answer, problems: [] }, goodText.value), analysis.peek());
    } else if (goodText.value === null)
      analysis.value = { ...completed(answer, NOTHING), version: null, problems: [], rules: [], findings: [] };
  });
}
