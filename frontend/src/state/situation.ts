/** The situation: which triggers occur, which conditions are true, and what the rules then require. */

import { batch, computed, effect, signal } from "@preact/signals";
import { Latest } from "../api/latest";
import { withOffsets } from "../api/offsets";
import type { Condition, Question, SearchAnswer, SituationAnswer, Value, Witness } from "../api/types";
import { language, t } from "../messages";
import { Refusal, server } from "../api/requests";
import { analysis, goodText, names } from "./analysis";
import { speak } from "./announcements";

export const triggers = signal<ReadonlySet<string>>(new Set());
/** The values that the user or a search set. Other conditions are false, and other measures are not given. */
export const values = signal<Readonly<Record<string, Value>>>({});
export const reading = signal<string | null>(null);
export const domain = signal<string | null>(null);
export const answer = signal<SituationAnswer | null>(null);
export const refusal = signal<string | null>(null);
interface Search {
  answer: SearchAnswer["answer"] | "asked";
  sentence: string;
  /** What was asked about: the text, the language, the reading and the domain. */
  about: object;
  /** The switches that show the situation that was found. */
  shown: object | null;
}

const lastSearch = signal<Search | null>(null);
/** The answer to the last search, while it holds: the text is the same, and the switches show what was found. */
export const searchAnswer = computed(() => {
  const last = lastSearch.value;
  if (!last || !sameValues(last.about, about.value)) return null;
  return last.shown === null || sameValues(last.shown, switches.value) ? last : null;
});

/** Null is a measure that is not given. */
export function valueOf(condition: Condition): Value | null {
  const value = values.value[condition.name];
  if (condition.kind === "boolean") return value === true;
  if (condition.kind === "scale") return condition.values?.includes(value as string) ? (value as string) : null;
  return typeof value === "number" || (typeof value === "string" && EXACT.test(value)) ? value : null;
}

/** A number that the server sent as text, because JavaScript cannot represent it exactly: 1/3, or a large integer. */
const EXACT = /^-?\d+(\/\d+)?$/;

/** The nearest number that JavaScript represents. */
export function nearest(value: Value): number {
  const [numerator, denominator] = String(value).split("/");
  return Number(numerator) / Number(denominator ?? 1);
}

/** The situation with only the names of the current rules. Conditions that are false are left out. */
export const situation = computed<Witness>(() => ({
  triggers: names.value.triggers.filter((name) => triggers.value.has(name)),
  conditions: Object.fromEntries(
    names.value.conditions
      .map((condition) => [condition.name, valueOf(condition)] as const)
      .filter((entry): entry is [string, Value] => entry[1] !== false && entry[1] !== null),
  ),
}));

/** The reading and the domain; null means that of the text, and all domains. */
export const scope = computed(() => ({
  reading: reading.value,
  domain: analysis.value.domains?.includes(domain.value ?? "") ? domain.value : null,
}));

export function toggle(trigger: string, occurs: boolean): void {
  const next = new Set(triggers.value);
  if (occurs) next.add(trigger);
  else next.delete(trigger);
  triggers.value = next;
}

/** Null takes the value away. */
export function setValue(name: string, value: Value | null): void {
  const { [name]: _before, ...others } = values.value;
  values.value = value === null ? others : { ...others, [name]: value };
}

/** Sets the switches to a situation, such as the witness of a finding. */
export function show(found: Witness): void {
  batch(() => {
    triggers.value = new Set(found.triggers);
    values.value = { ...found.conditions };
  });
}

/** Asks for the domain of a finding or case, and for the reading of the text; both are about these. */
export function answerForDomain(wanted: string | null): void {
  reading.value = null;
  domain.value = wanted;
}

export function clear(): void {
  show({ triggers: [], conditions: {} });
}

/** What an answer of a search depends on, besides the question. */
const about = computed(() => ({ text: goodText.value, language: language.value, ...scope.value }));
const switches = computed(() => ({ triggers: triggers.value, values: values.value }));

function sameValues(one: object, other: object): boolean {
  const [ones, others] = [Object.values(one), Object.values(other)];
  return ones.every((value, number) => value === others[number]);
}

const latest = new Latest();

export function keepAnswering(): void {
  effect(() => {
    const text = goodText.value;
    const asked = { ...situation.value, ...scope.value, language: language.value };
    if (text === null || server.value !== "here") return;
    if (asked.triggers.length > 0) return void answerFor(text, asked);
    latest.cancel();
    answer.value = null;
    refusal.value = null;
  });
}

async function answerFor(text: string, asked: object): Promise<void> {
  try {
    const found = await latest.ask<SituationAnswer>("situation", { of: analysis.peek().of, ...asked }).catch((error: unknown) => {
      // The server was started again, or other pages have sent it many texts since.
      if (error instanceof Refusal && error.status === 410) return latest.ask<SituationAnswer>("situation", { text, ...asked });
      throw error;
    });
    if (!found) return;
    batch(() => {
      refusal.value = null;
      answer.value = withOffsets(found, text);
    });
  } catch (error) {
    if (!(error instanceof Refusal)) throw error;
    refusal.value = error.message;
  }
}

const latestSearch = new Latest();

export async function search(question: Question): Promise<void> {
  const asked = about.value;
  if (asked.text === null) return;
  const pending: Search = { answer: "asked", sentence: t("checking"), about: asked, shown: null };
  lastSearch.value = pending;
  try {
    const found = await latestSearch.ask<SearchAnswer>("search", { ...asked, question });
    if (!found || !sameValues(asked, about.value)) return;
    batch(() => {
      if (found.situation) show(found.situation);
      const { answer, sentence, situation } = found;
      lastSearch.value = { answer, sentence, about: asked, shown: situation && switches.value };
    });
    speak(found.sentence);
  } catch (error) {
    if (!(error instanceof Refusal)) throw error;
    lastSearch.value = { answer: "unknown", sentence: error.message, about: asked, shown: null };
  } finally {
    if (lastSearch.value === pending) lastSearch.value = null;
  }
}
