/** The verified repairs of the finding that is open. */

import { effect, signal } from "@preact/signals";
import { Latest } from "../api/latest";
import { Refusal, server } from "../api/requests";
import { language, t } from "../messages";
import type { Repair } from "../api/types";
import { findings, goodText, old } from "./analysis";
import { say, speak } from "./announcements";
import { editorHooks } from "./document";

/** The identifier of the finding whose repairs are shown. */
export const repairsFor = signal<string | null>(null);
/** Its repairs; null while they are searched for. */
export const repairs = signal<Repair[] | null>(null);
export const repairsRefusal = signal<string | null>(null);

const latest = new Latest();

export function keepRepairs(): void {
  effect(() => {
    const finding = repairsFor.value;
    const text = goodText.value;
    repairs.value = null;
    repairsRefusal.value = null;
    if (finding === null || text === null || server.value !== "here") return;
    if (findings.peek().every((one) => one.id !== finding)) return void (repairsFor.value = null);
    latest
      .ask<{ repairs: Repair[] }>("repairs", { text, finding, language: language.value })
      .then((answer) => {
        if (!answer) return;
        repairs.value = answer.repairs;
        speak(t("repairsFound", { number: answer.repairs.length }));
      })
      .catch((error: unknown) => {
        if (!(error instanceof Refusal)) throw error;
        repairsRefusal.value = error.message;
      });
  });
}

/** Replaces the text by the repaired one, if it is still the text for which the repair was found. */
export function apply(repair: Repair): void {
  if (old.value) return;
  editorHooks.replace(repair.text);
  editorHooks.focus();
  repairsFor.value = null;
  say("applied");
}
