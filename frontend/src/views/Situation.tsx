/** The situation with its switches, and what the rules require in it. */

import { useState } from "preact/hooks";
import { t } from "../messages";
import { names } from "../state/analysis";
import { ruleAtCursor } from "../state/selection";
import { clear, situation } from "../state/situation";
import { Chosen } from "./Chosen";
import { Obligations } from "./Obligations";
import { Old } from "./Old";
import { SaveCase } from "./SaveCase";
import { Scope } from "./Scope";
import { Search } from "./Search";
import { Switches } from "./Switches";

const MANY_NAMES = 16;

export function Situation() {
  const [filter, setFilter] = useState("");
  const [local, setLocal] = useState(false);
  const all = names.value;
  const many = all.triggers.length + all.conditions.length > MANY_NAMES;
  return (
    <div class="situation">
      <Search />
      <p class="intro">{t("situationIntro")}</p>
      <div class="toolbar">
        {many && (
          <>
            <label>
              {t("filter")}
              <input type="search" value={filter} onInput={(event) => setFilter(event.currentTarget.value)} />
            </label>
            <label>
              {t("ruleFilter")}
              <select value={local ? "cursor" : "all"} onChange={(event) => setLocal(event.currentTarget.value === "cursor")}>
                <option value="all">{t("allNames")}</option>
                <option value="cursor">{t("atCursor")}</option>
              </select>
            </label>
          </>
        )}
        <button type="button" disabled={situation.value.triggers.length + Object.keys(situation.value.conditions).length === 0} onClick={clear}>
          {t("clear")}
        </button>
      </div>
      <Chosen />
      <div class="columns">
        <Switches filter={filter} rule={local ? ruleAtCursor.value : null} />
        <section class="answer" aria-label={t("answer")}>
          <Old />
          <Obligations />
        </section>
      </div>
      <Scope />
      <SaveCase />
    </div>
  );
}
