/** All texts of the page, by language. Nothing else in the page has a text of its own. */

import { signal } from "@preact/signals";
import { de } from "./de";
import { en } from "./en";
import { it } from "./it";

export type Message = keyof typeof en;
export type Messages = Record<Message, string>;

export const LANGUAGES = { en: "English", it: "Italiano", de: "Deutsch" } as const;
export type Language = keyof typeof LANGUAGES;

const MESSAGES: Record<Language, Messages> = { en, it, de };
const KEPT = "sleec-verify language";

function isLanguage(name: string | null): name is Language {
  return name !== null && name in MESSAGES;
}

const kept = localStorage.getItem(KEPT);
export const language = signal<Language>(isLanguage(kept) ? kept : "en");

export function setLanguage(name: string): void {
  if (!isLanguage(name)) return;
  language.value = name;
  localStorage.setItem(KEPT, name);
}

/** The text in the language of the page, with values in place of `{placeholders}`. */
export function t(message: Message, values: Record<string, string | number> = {}): string {
  return MESSAGES[language.value][message].replace(/\{(\w+)\}/g, (whole, name: string) => String(values[name] ?? whole));
}
