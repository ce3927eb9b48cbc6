/** The verified repairs of a finding: what each does, the change in the text, and a button that applies it. */

import type { Finding, Repair } from "../api/types";
import { t } from "../messages";
import { old } from "../state/analysis";
import { apply, repairs, repairsRefusal } from "../state/repairs";
import { Sentence } from "./Sentence";

export function Repairs({ finding }: { finding: Finding }) {
  const found = repairs.value;
  return (
    <div class="repairs" aria-label={`${t("repairsOf")}: ${finding.sentence}`} role="group">
      {repairsRefusal.value !== null ? (
        <p>{repairsRefusal.value}</p>
      ) : found === null ? (
        <p>{t("searchingRepairs")}</p>
      ) : found.length === 0 ? (
        <p>{t("noRepairs")}</p>
      ) : (
        <ol>
          {found.map((repair, number) => (
            <RepairItem key={number} repair={repair} />
          ))}
        </ol>
      )}
    </div>
  );
}

function RepairItem({ repair }: { repair: Repair }) {
  return (
    <li>
      <p class="repair-title"><Sentence text={repair.title} /></p>
      {repair.effect.length > 0 && (
        <>
          <h3>{t("effect")}</h3>
          <ul>
            {repair.effect.map((sentence) => (
              <li key={sentence}><Sentence text={sentence} /></li>
            ))}
          </ul>
        </>
      )}
      <h3>{t("change")}</h3>
      <Difference text={repair.diff} />
      <button type="button" class="main" disabled={old.value} onClick={() => apply(repair)}>
        {t("apply")}
      </button>
    </li>
  );
}

/** A unified diff. The signs + and - say what the colours say. */
export function Difference({ text }: { text: string }) {
  const lines = text.split("\n").filter((line) => line && !/^(---|\+\+\+|@@)/.test(line));
  return (
    <pre class="difference" tabIndex={0} role="group" aria-label={t("change")}>
      {lines.map((line, number) => (
        <div key={number} class={line.startsWith("+") ? "added" : line.startsWith("-") ? "removed" : ""}>
          {line}
        </div>
      ))}
    </pre>
  );
}
