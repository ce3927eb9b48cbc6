/** A long list, of which a part is shown at first, so that thousands of entries stay fast. */

import type { ComponentChildren } from "preact";
import { useState } from "preact/hooks";
import { t } from "../messages";

const STEP = 40;

export function Paged<T>({ items, render, kind }: { items: readonly T[]; render: (item: T) => ComponentChildren; kind: string }) {
  const [shown, setShown] = useState(STEP);
  const rest = items.length - shown;
  return (
    <>
      <ul class={kind}>{items.slice(0, shown).map(render)}</ul>
      {rest > 0 && (
        <p class="more">
          <button type="button" onClick={() => setShown(shown + STEP)}>
            {t("more", { number: Math.min(rest, STEP) })}
          </button>{" "}
          {t("shownOf", { shown, all: items.length })}
        </p>
      )}
    </>
  );
}
