/** The verdict and the findings as sentences, each linked with its place in the text. */

import { goTo, present } from "../editor/editor";
import { goToView } from "../focus";
import { t } from "../messages";
import { analysis, answeredText, findings, goodText, problems, stale, unanswered, undecided, waiting } from "../state/analysis";
import type { Finding, Problem } from "../api/types";
import { repairsFor } from "../state/repairs";
import { selectedFinding } from "../state/selection";
import { answerForDomain, show } from "../state/situation";
import { canShow, showEvents } from "../state/timeline";
import { Paged } from "./Paged";
import { Repairs } from "./Repairs";
import { Sentence } from "./Sentence";

const SIGNS = { error: "✖", warning: "▲", note: "ℹ" } as const;

export function Findings() {
  const verdict = goodText.value === null && problems.value.length === 0 ? t("checking") : analysis.value.verdict;
  return (
    <section class="findings" aria-labelledby="findings-title">
      <h2 id="findings-title">
        {t("findings")} {stale.value && goodText.value !== null && <span class="old">{t(unanswered.value ? "earlierMark" : "oldMark")}</span>}
      </h2>
      <div role="status">
        {waiting.value && <p class="problem-title">{t("problems")}</p>}
        <p class={stale.value ? "verdict stale" : "verdict"}><Sentence text={verdict} /></p>
      </div>
      {waiting.value && <Paged kind="list" items={problems.value} render={(problem) => <ProblemItem problem={problem} />} />}
      {undecided.value.length > 0 && (
        <ul class="list">
          {undecided.value.map((one) => (
            <li key={one.name} class="finding unknown">
              <p>
                <span class="severity">
                  <span aria-hidden="true">?</span> {t("unknown")}:
                </span>{" "}
                <Sentence text={one.statement} />
              </p>
              {one.reason && (
                <p class="hint">
                  <Sentence text={one.reason} />
                </p>
              )}
            </li>
          ))}
        </ul>
      )}
      <Paged kind="list" items={findings.value} render={(finding) => <FindingItem key={finding.id} finding={finding} />} />
    </section>
  );
}

function ProblemItem({ problem }: { problem: Problem }) {
  return (
    <li class="finding error">
      <button type="button" class="sentence" onClick={() => goTo(present(problem, answeredText.value))}>
        <span class="severity">✎</span> <Sentence text={problem.message} />
      </button>
      {problem.hint && <p class="hint"><Sentence text={problem.hint} /></p>}
    </li>
  );
}

function FindingItem({ finding }: { finding: Finding }) {
  const open = repairsFor.value === finding.id;
  return (
    <li class={`finding ${finding.severity}`}>
      <button
        type="button"
        class="sentence"
        onClick={() => {
          selectedFinding.value = finding.id;
          goTo(present(finding));
        }}
      >
        <span class="severity">
          <span aria-hidden="true">{SIGNS[finding.severity]}</span> {t(finding.severity)}:
        </span>{" "}
        <Sentence text={finding.sentence} /> <span class="code">{finding.code}</span>
      </button>
      {finding.help && <p class="hint"><Sentence text={finding.help} /></p>}
      <p class="actions">
        {finding.timeline && canShow(finding.timeline) && (
          <button
            type="button"
            onClick={() => {
              if (finding.timeline) showEvents(finding.timeline);
              answerForDomain(finding.domain);
              goToView("timeline");
            }}
          >
            {t("showTimeline")}
          </button>
        )}
        {finding.witness && !finding.timeline && (
          <button
            type="button"
            onClick={() => {
              if (finding.witness) show(finding.witness);
              answerForDomain(finding.domain);
              goToView("situation");
            }}
          >
            {t("showSituation")}
          </button>
        )}
        {finding.repairs && (
          <button type="button" aria-expanded={open} onClick={() => (repairsFor.value = open ? null : finding.id)}>
            {t(open ? "hideRepairs" : "showRepairs")}
          </button>
        )}
      </p>
      {open && <Repairs finding={finding} />}
    </li>
  );
}
