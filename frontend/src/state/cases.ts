/** The expected cases: the file of cases, and the results of the last run. */

import { batch, computed, effect, signal } from "@preact/signals";
import { Latest } from "../api/latest";
import { ask, Gone, Refusal, server } from "../api/requests";
import type { Case, CaseResult, SituationAnswer } from "../api/types";
import { language, t } from "../messages";
import { goodText } from "./analysis";
import { speak } from "./announcements";
import { casesDigest } from "./document";
import { scope, situation } from "./situation";

/** The cases, as they fit the last complete text; null before the first answer. */
export const cases = signal<Case[] | null>(null);
/** The file of the cases, and why it cannot be read. */
export const casesFile = signal<{ path: string; problem: string | null }>({ path: "", problem: null });
/** Why the last case could not be saved, or cases could not be run. */
export const refusal = signal<string | null>(null);
/** The name of the case that was saved last. */
export const savedCase = signal<string | null>(null);

const lastRun = signal<{ text: string | null; language: string; digest: string | null; results: Record<string, CaseResult> }>({
  text: null,
  language: "",
  digest: null,
  results: {},
});
/** The results for the last complete text and the present file of cases, by the name of the case. */
export const results = computed(() => {
  const { text, language: spoken, digest, results: found } = lastRun.value;
  return text === goodText.value && spoken === language.value && digest === casesDigest.value ? found : {};
});

/** Whether the server did it. */
async function attempt(action: () => Promise<void>): Promise<boolean> {
  refusal.value = null;
  try {
    await action();
    return true;
  } catch (error) {
    if (error instanceof Refusal) refusal.value = error.hint ? `${error.message} (${error.hint})` : error.message;
    else if (!(error instanceof Gone)) throw error;
    return false;
  }
}

const latest = new Latest();

/** Keeps the list up to date while it is shown. */
export function keepCases(): () => void {
  refusal.value = null;
  return effect(() => {
    const asked = { text: goodText.value, language: language.value, digest: casesDigest.value };
    if (asked.text === null || server.value !== "here") return;
    void latest.ask<{ path: string; cases: Case[]; problem: string | null }>("cases", asked).then((found) => {
      if (!found) return;
      cases.value = found.cases;
      casesFile.value = found;
    });
  });
}

/** Saves the situation with what the rules require in it as an expected case. */
export function saveCase(name: string): Promise<boolean> {
  savedCase.value = null;
  return attempt(async () => {
    // The answer on the page may belong to the situation before the last switch.
    const asked = { text: goodText.value, ...situation.value, ...scope.value };
    const { obligations, prohibitions, consistent } = await ask<SituationAnswer>("situation", asked);
    await ask("cases/add", { ...asked, name, obligations, prohibitions, conflict: consistent === false });
    savedCase.value = name;
  });
}

export function runCases(): Promise<boolean> {
  return attempt(async () => {
    const run = { text: goodText.value, language: language.value };
    const { results: found, digest } = await ask<{ results: CaseResult[]; digest: string | null }>("cases/run", run);
    batch(() => {
      casesDigest.value = digest;
      lastRun.value = { ...run, digest, results: Object.fromEntries(found.map((result) => [result.name, result])) };
    });
    speak(t("casesResult", { passed: found.filter((result) => result.passed).length, all: found.length }));
  });
}
