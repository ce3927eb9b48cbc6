/** A sentence of the server. Names in it are in backticks; they read as words, with the identifier as a tooltip. */

import { computed } from "@preact/signals";
import { t } from "../messages";
import { names, rules } from "../state/analysis";
import { spoken } from "../words";

const known = computed(
  () =>
    new Set([
      ...names.value.triggers,
      ...names.value.obligations,
      ...names.value.conditions.map((one) => one.name),
      ...rules.value.map((rule) => rule.label),
    ]),
);

export function Sentence({ text }: { text: string | null }) {
  const parts = (text ?? "").split("`");
  return (
    <>
      {parts.map((part, number) =>
        number % 2 === 0 ? (
          number === 0 ? begun(part) : part
        ) : (
          <span key={number} class="quoted" title={part}>
            {t("quoted", { name: inWords(part) })}
          </span>
        ),
      )}
    </>
  );
}

/** A name as words, or a piece of the text of the rules with its names as words. */
export function inWords(part: string): string {
  if (known.value.has(part)) return spoken(part);
  return part.replace(/[\p{L}_][\p{L}\p{M}\p{N}_]*/gu, (word) => (known.value.has(word) ? spoken(word) : word));
}

/** The first letter is a capital. */
function begun(part: string): string {
  return part.charAt(0).toUpperCase() + part.slice(1);
}
