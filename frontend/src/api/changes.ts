/** The answer to "check" leaves out what the page has: lists of names, and what it knows of each rule and finding. */

import type { Analysis, Finding, Rule, Span } from "./types";

type Placed<T, Name extends keyof T> = Span & Pick<T, Name>;

/** What is left out is in the analysis whose version the request named. */
export type AnalysisChange = Omit<Analysis, "names" | "rules" | "findings"> & {
  names: Partial<Analysis["names"]>;
  rules: (Rule | Placed<Rule, "label">)[];
  findings: (Finding | Placed<Finding, "id">)[];
};

/** The whole analysis. A rule or finding that has neither changed nor moved is the same object as in `before`. */
export function completed(change: AnalysisChange, before: Analysis): Analysis {
  const rules = new Map(before.rules.map((rule) => [rule.label, rule]));
  const findings = new Map(before.findings.map((finding) => [finding.id, finding]));
  return {
    ...change,
    names: Object.keys(change.names).length > 0 ? { ...before.names, ...change.names } : before.names,
    rules: change.rules.map((rule) => ("trigger" in rule ? rule : placed(rules.get(rule.label), rule))),
    findings: change.findings.map((finding) => ("code" in finding ? finding : placed(findings.get(finding.id), finding))),
  };
}

function placed<T extends Span>(known: T | undefined, { start, end }: Span): T {
  if (!known) throw new Error("the answer leaves out a part that the page does not have");
  return known.start === start && known.end === end ? known : { ...known, start, end };
}
