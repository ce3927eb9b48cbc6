/** What happened: shown for a while, and spoken by a screen reader, also without a change of focus. */

import { signal } from "@preact/signals";
import { t, type Message } from "../messages";

const SHOWN_FOR = 8000;

export const announcement = signal({ text: "", isShown: false });
let timer = 0;

export function say(message: Message, values: Record<string, string | number> = {}): void {
  announce(t(message, values), true);
}

/** Speaks a sentence that the page shows anyway. */
export function speak(sentence: string): void {
  announce(sentence, false);
}

function announce(text: string, isShown: boolean): void {
  announcement.value = { text: "", isShown: false };
  clearTimeout(timer);
  setTimeout(() => (announcement.value = { text, isShown }), 50);
  timer = window.setTimeout(() => (announcement.value = { text: "", isShown: false }), SHOWN_FOR);
}
