/** What is required in the situation, which clause decides in each rule, and why. */

import type { DecidedRule, SituationAnswer } from "../api/types";
import { goTo, present } from "../editor/editor";
import { t } from "../messages";
import { goodText, waiting } from "../state/analysis";
import { answer, refusal, situation } from "../state/situation";
import { spoken } from "../words";
import { NameList } from "./Name";
import { Sentence } from "./Sentence";

export function Obligations() {
  const found = answer.value;
  if (refusal.value !== null) return <p class="refusal">{refusal.value}</p>;
  if (goodText.value === null && waiting.value) return <p class="empty">{t("noRulesYet")}</p>;
  const nothing = situation.value.triggers.length === 0;
  return (
    <>
      <div role="status">
        {nothing ? <p class="empty">{t("nothingHappens")}</p> : found ? <Due found={found} /> : <p>{t("checking")}</p>}
      </div>
      {!nothing && found && <Reasons found={found} />}
    </>
  );
}

function Due({ found }: { found: SituationAnswer }) {
  return (
    <>
      {found.consistent === false && (
        <p class="contradiction">
          <span aria-hidden="true">✖</span> {t("contradiction")}
        </p>
      )}
      {found.conflicts.map((conflict, number) => (
        <p key={number} class="hint">
          <Sentence text={conflict.sentence} />
        </p>
      ))}
      <div class="due">
        {found.obligations.length + found.alternatives.length > 0 && (
          <div class="must">
            <h3>{t("mustDo")}</h3>
            {found.obligations.length > 0 && <NameList names={found.obligations} />}
            {found.alternatives.length > 0 && (
              <ul>
                {found.alternatives.map((alternative) => (
                  <li key={alternative}><Sentence text={alternative} /></li>
                ))}
              </ul>
            )}
          </div>
        )}
        {found.prohibitions.length > 0 && (
          <div class="must-not">
            <h3>{t("mustNot")}</h3>
            <NameList names={found.prohibitions} />
          </div>
        )}
        {found.consistent && found.obligations.length + found.alternatives.length + found.prohibitions.length === 0 && <p>{t("nothingDue")}</p>}
      </div>
    </>
  );
}

function Reasons({ found }: { found: SituationAnswer }) {
  return (
    <>
      {found.notes.map((note) => (
        <p key={note} class="hint">
          <Sentence text={note} />
        </p>
      ))}
      {found.rules.length > 0 && <h3>{t("why")}</h3>}
      <ul class="because">
        {found.rules.map((rule) => (
          <Because key={rule.label} rule={rule} />
        ))}
      </ul>
    </>
  );
}

function Because({ rule }: { rule: DecidedRule }) {
  const decision =
    rule.clause === null ? t("notActive") : rule.clause === 0 ? t("defaultDecides") : t("clauseDecides", { number: rule.clause });
  return (
    <li class={rule.clause === null ? "inactive" : ""}>
      <button type="button" class="sentence" title={rule.label} onClick={() => goTo(present(rule))}>
        <strong>{spoken(rule.label)}</strong>: {decision}
      </button>
      <ol class="steps">
        {rule.steps.map((step, number) => (
          <li key={number}><Sentence text={step} /></li>
        ))}
      </ol>
    </li>
  );
}
