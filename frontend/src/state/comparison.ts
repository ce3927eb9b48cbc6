/** The comparison of the text with an earlier version. */

import { computed, signal } from "@preact/signals";
import { ask, Gone, Refusal } from "../api/requests";
import { base, conflict, text } from "./document";
import { language } from "../messages";
import { say } from "./announcements";

export interface Version {
  id: string;
  text: string;
  time: string;
}

/** The versions that the user kept, the newest first. */
export const kept = signal<Version[]>([]);
/** With what the text is compared: "saved", "disk", or the identifier of a kept version. */
export const against = signal("saved");
export const sentences = signal<{ old: string; new: string; language: string; lines: string[] } | null>(null);

export const earlier = computed(() => {
  if (against.value === "disk" && conflict.value) return conflict.value.text ?? "";
  return kept.value.find((version) => version.id === against.value)?.text ?? base.value.text;
});

export function keepVersion(): void {
  const time = new Date().toLocaleTimeString();
  kept.value = [{ id: `${kept.value.length + 1}`, text: text.value, time }, ...kept.value];
  against.value = kept.value[0]?.id ?? "saved";
  say("versionKept");
}

export async function compareMeaning(): Promise<void> {
  const compared = { old: earlier.value, new: text.value, language: language.value };
  try {
    const answer = await ask<{ sentences: string[] }>("compare", compared);
    sentences.value = { ...compared, lines: answer.sentences };
  } catch (error) {
    if (error instanceof Gone) return;
    if (!(error instanceof Refusal)) throw error;
    sentences.value = { ...compared, lines: [error.message] };
  }
}
