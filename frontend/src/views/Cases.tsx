/** The expected cases, and whether the rules do what each expects. */

import { useEffect } from "preact/hooks";
import type { Case } from "../api/types";
import { goToView } from "../focus";
import { t } from "../messages";
import { cases, casesFile, keepCases, refusal, results, runCases } from "../state/cases";
import { answerForDomain, show } from "../state/situation";
import { Old } from "./Old";
import { Paged } from "./Paged";
import { Sentence } from "./Sentence";

export function Cases() {
  useEffect(keepCases, []);
  const all = cases.value;
  const { path, problem } = casesFile.value;
  const run = Object.values(results.value);
  return (
    <div class="cases">
      <p class="intro">{t("casesIntro")}</p>
      {path && <p class="hint">{t("casesFile", { path })}</p>}
      <div class="toolbar">
        <button type="button" class="main" disabled={!all?.length} onClick={() => void runCases()}>
          {t("casesRun")}
        </button>
        {run.length > 0 && (
          <p>{t("casesResult", { passed: run.filter((result) => result.passed).length, all: run.length })}</p>
        )}
      </div>
      <Old />
      {[problem, refusal.value].map((said) => said !== null && <p key={said} role="alert" class="refusal"><Sentence text={said} /></p>)}
      {all?.length === 0 && problem === null && <p class="empty">{t("casesNone")}</p>}
      {all && <Paged kind="list" items={all} render={(one) => <CaseItem key={one.name} one={one} />} />}
    </div>
  );
}

function CaseItem({ one }: { one: Case }) {
  const result = results.value[one.name];
  const state = !result ? "not-run" : result.passed ? "passed" : "failed";
  return (
    <li class={`case ${state}`}>
      <p>
        <strong>{one.name}</strong>{" "}
        <span class="verdict">
          {!result ? t("caseNotRun") : result.passed ? `✓ ${t("casePassed")}` : `✖ ${t("caseFailed")}`}
        </span>
      </p>
      <p class="hint">
        <Sentence text={one.sentence} />
      </p>
      {result && !result.passed && result.sentence !== one.sentence && (
        <p>
          <Sentence text={result.sentence} />
        </p>
      )}
      {one.situation && (
        <button
          type="button"
          aria-label={`${t("caseShow")}: ${one.name}`}
          onClick={() => {
            if (one.situation) show(one.situation);
            answerForDomain(one.domain ?? null);
            goToView("situation");
          }}
        >
          {t("caseShow")}
        </button>
      )}
    </li>
  );
}
