/** "Show me a situation in which …": a question for the solver, whose answer sets the switches. */

import { useMemo, useState } from "preact/hooks";
import type { Question } from "../api/types";
import { t } from "../messages";
import { names, rules } from "../state/analysis";
import { search, searchAnswer } from "../state/situation";
import { spoken } from "../words";
import { inWords, Sentence } from "./Sentence";

type Kind = Question["kind"];
const KINDS: Record<Kind, "searchObligation" | "searchTogether" | "searchException" | "searchReadings"> = {
  obligation: "searchObligation",
  together: "searchTogether",
  exception: "searchException",
  readings: "searchReadings",
};

export function Search() {
  const [kind, setKind] = useState<Kind>("obligation");
  const [obligation, setObligation] = useState("");
  const [first, setFirst] = useState("");
  const [second, setSecond] = useState("");
  const [clause, setClause] = useState(1);
  const askable = kind === "exception" ? rules.value.filter((rule) => rule.clauses.length > 1) : rules.value;
  const labels = askable.map((rule) => rule.label);
  const duties = names.value.obligations;
  const chosenDuty = duties.includes(obligation) ? obligation : duties[0];
  const chosenRule = askable.find((rule) => rule.label === first) ?? askable[0];
  const others = labels.filter((label) => label !== chosenRule?.label);
  const other = others.includes(second) ? second : (others[0] ?? "");
  const exceptions = chosenRule?.clauses.filter((one) => one.number > 0) ?? [];
  const chosenClause = exceptions.find((one) => one.number === clause) ?? exceptions[0];

  function question(): Question | null {
    const rule = chosenRule?.label;
    switch (kind) {
      case "obligation":
        return chosenDuty === undefined ? null : { kind, obligation: chosenDuty };
      case "together":
        return rule === undefined || !other ? null : { kind, rules: [rule, other] };
      case "exception":
        return rule === undefined || !chosenClause ? null : { kind, rule, clause: chosenClause.number };
      case "readings":
        return { kind };
    }
  }

  const asked = question();
  return (
    <form
      class="search"
      onSubmit={(event) => {
        event.preventDefault();
        if (asked) void search(asked);
      }}
    >
      <fieldset>
        <legend>{t("searchTitle")}</legend>
        <div class="toolbar">
          <Select label={t("searchKind")} value={kind} set={(value) => setKind(value as Kind)} options={Object.keys(KINDS)} words={(one) => t(KINDS[one as Kind])} />
          {kind === "obligation" && (
            <Select label={t("searchObligationField")} value={chosenDuty ?? ""} set={setObligation} options={duties} words={spoken} />
          )}
          {(kind === "together" || kind === "exception") && (
            <Select label={t("searchRule")} value={chosenRule?.label ?? ""} set={setFirst} options={labels} words={spoken} />
          )}
          {kind === "together" && (
            <Select label={t("searchSecondRule")} value={other} set={setSecond} options={others} words={spoken} />
          )}
          {kind === "exception" && (
            <Select
              label={t("searchClause")}
              value={String(chosenClause?.number ?? "")}
              set={(value) => setClause(Number(value))}
              options={exceptions.map((one) => String(one.number))}
              words={(one) => `${one}: ${inWords(exceptions.find((each) => String(each.number) === one)?.condition ?? "")}`}
            />
          )}
          <button type="submit" class="main" disabled={asked === null}>
            {t("searchGo")}
          </button>
        </div>
      </fieldset>
      {kind === "exception" && labels.length === 0 && <p class="hint">{t("searchNoExceptions")}</p>}
      {kind === "together" && labels.length < 2 && <p class="hint">{t("searchOneRule")}</p>}
      {searchAnswer.value && <p class={`search-answer ${searchAnswer.value.answer}`}><Sentence text={searchAnswer.value.sentence} /></p>}
    </form>
  );
}

interface SelectProps {
  label: string;
  value: string;
  set: (value: string) => void;
  options: readonly string[];
  words: (option: string) => string;
}

function Select({ label, value, set, options, words }: SelectProps) {
  // Thousands of options are drawn again only if they change.
  const drawn = useMemo(
    () =>
      options.map((option) => (
        <option key={option} value={option} title={option}>
          {words(option)}
        </option>
      )),
    [options, words],
  );
  return (
    <label>
      {label}
      <select value={value} onChange={(event) => set(event.currentTarget.value)}>
        {drawn}
      </select>
    </label>
  );
}
