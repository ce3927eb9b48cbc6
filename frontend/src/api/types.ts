/** The answers of the server, as `sleec_verify/serve/answers/` makes them. Offsets are those of JavaScript strings. */

export interface Span {
  start: number;
  end: number;
}

export interface FileAnswer {
  path: string;
  name: string;
  text: string;
  sha256: string | null;
  problem: string | null;
  draft: { text: string; based_on: string | null } | null;
}

export type Disk = { text: string | null; sha256: string | null; problem: string | null };

export interface Problem extends Span {
  message: string;
  hint: string | null;
}

export type Value = boolean | number | string;

export interface Condition {
  name: string;
  kind: "boolean" | "number" | "scale";
  values?: (number | string)[];
  whole?: boolean;
  minimum?: number;
  maximum?: number;
}

export interface Names {
  triggers: string[];
  conditions: Condition[];
  obligations: string[];
}

export interface Clause {
  number: number;
  condition: string | null;
}

export interface Rule extends Span {
  label: string;
  trigger: string;
  guard: string | null;
  clauses: Clause[];
}

export type Severity = "error" | "warning" | "note";

export interface Witness {
  triggers: string[];
  conditions: Record<string, Value>;
}

export interface Finding extends Span {
  id: string;
  code: string;
  severity: Severity;
  sentence: string;
  /** The first domain that the finding concerns; null if it concerns the rules of no domain. */
  domain: string | null;
  help: string | null;
  witness: Witness | null;
  timeline: { time: number; events: string[]; conditions: Record<string, Value> }[] | null;
  repairs: boolean;
}

export interface Check {
  name: string;
  statement: string;
  verdict: string;
  reason: string | null;
}

export interface Analysis {
  sha256: string;
  version: string | null;
  of: string | null;
  problems: Problem[];
  reading?: string;
  domains?: string[];
  timed?: boolean;
  names: Names;
  rules: Rule[];
  findings: Finding[];
  checks: Check[];
  verdict: string | null;
  seconds: number;
}

export interface DecidedRule extends Span {
  label: string;
  clause: number | null;
  layer: string | null;
  obligations: string[];
  steps: string[];
}

export interface SituationAnswer {
  obligations: string[];
  prohibitions: string[];
  /** Null: it is not known. */
  consistent: boolean | null;
  /** Obligations with alternatives, as sentences. */
  alternatives: string[];
  rules: DecidedRule[];
  conflicts: { sentence: string }[];
  sentence: string;
  notes: string[];
}

export type Question =
  | { kind: "obligation"; obligation: string }
  | { kind: "together"; rules: string[] }
  | { kind: "exception"; rule: string; clause: number }
  | { kind: "readings" };

export interface SearchAnswer {
  answer: "found" | "none" | "unknown";
  situation: Witness | null;
  sentence: string;
}

export interface Repair {
  title: string;
  kind: string;
  effect: string[];
  text: string;
  diff: string;
}

export interface TimedEvent {
  time: number;
  triggers: string[];
  conditions: Record<string, Value>;
  executed: string[];
}

export interface Window {
  obligation: string;
  negated: boolean;
  from: number;
  to: number | null;
  rule: string;
  clause: number | null;
  state: "open" | "fulfilled" | "missed" | "broken" | "impossible";
  instead_of: string | null;
}

export interface TimelineAnswer {
  windows: Window[];
  problems: string[];
  /** The time in seconds from which it is impossible to follow every rule. */
  impossible: number | null;
}

/** Without a situation, it is a sequence of events, or does not fit the rules. */
export interface Case {
  name: string;
  situation: Witness | null;
  sentence: string;
  domain?: string | null;
}

export interface CaseResult {
  name: string;
  passed: boolean;
  sentence: string;
}
