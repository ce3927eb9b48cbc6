/** The views beside the text, as tabs: arrow keys move between them (WAI-ARIA pattern "tabs"). */

import { t, type Message } from "../messages";
import { view, VIEWS, type View } from "../state/selection";
import { Cases } from "./Cases";
import { Compare } from "./Compare";
import { Situation } from "./Situation";
import { Timeline } from "./Timeline";

const PANELS: Record<View, { title: Message; panel: () => preact.JSX.Element }> = {
  situation: { title: "situation", panel: Situation },
  timeline: { title: "timeline", panel: Timeline },
  compare: { title: "compare", panel: Compare },
  cases: { title: "cases", panel: Cases },
};

export function Tabs() {
  const Panel = PANELS[view.value].panel;
  return (
    <section class="views">
      <div role="tablist" aria-label={t("panels")} onKeyDown={key}>
        {VIEWS.map((one) => (
          <button
            key={one}
            type="button"
            role="tab"
            id={`tab-${one}`}
            aria-selected={one === view.value}
            aria-controls="panel"
            tabIndex={one === view.value ? 0 : -1}
            onClick={() => (view.value = one)}
          >
            {t(PANELS[one].title)}
          </button>
        ))}
      </div>
      <div role="tabpanel" id="panel" aria-labelledby={`tab-${view.value}`} tabIndex={0}>
        <Panel />
      </div>
    </section>
  );
}

function key(event: KeyboardEvent): void {
  const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
  if (step === undefined) return;
  const next = VIEWS[(VIEWS.indexOf(view.value) + step + VIEWS.length) % VIEWS.length] ?? "situation";
  view.value = next;
  document.getElementById(`tab-${next}`)?.focus();
  event.preventDefault();
}
