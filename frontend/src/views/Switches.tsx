/** Switches for triggers and conditions, sliders for numbers, and choices for scales. */

import { useState } from "preact/hooks";
import type { Condition, Rule } from "../api/types";
import { t } from "../messages";
import { names } from "../state/analysis";
import { nearest, setValue, toggle, triggers, valueOf } from "../state/situation";
import { spoken } from "../words";
import { Paged } from "./Paged";

export function Switches({ filter, rule }: { filter: string; rule: Rule | null }) {
  const wanted = filter.trim().toLowerCase();
  const fits = (name: string): boolean =>
    (name.toLowerCase().includes(wanted) || spoken(name).toLowerCase().includes(wanted)) && (rule === null || mentions(rule, name));
  const occurring = names.value.triggers.filter(fits);
  const conditions = names.value.conditions.filter((one) => fits(one.name));
  const booleans = conditions.filter((one) => one.kind === "boolean");
  const measures = conditions.filter((one) => one.kind !== "boolean");
  return (
    <div class="switches">
      <fieldset>
        <legend>{t("happens")}</legend>
        <Paged
          kind="plain"
          items={occurring}
          render={(name) => (
            <li key={name}>
              <Switch name={name} on={triggers.value.has(name)} change={(on) => toggle(name, on)} />
            </li>
          )}
        />
      </fieldset>
      {booleans.length > 0 && (
        <fieldset>
          <legend>{t("isTrue")}</legend>
          <Paged
            kind="plain"
            items={booleans}
            render={(one) => (
              <li key={one.name}>
                <Switch name={one.name} on={valueOf(one) === true} change={(on) => setValue(one.name, on)} />
              </li>
            )}
          />
        </fieldset>
      )}
      {measures.length > 0 && (
        <fieldset>
          <legend>{t("measures")}</legend>
          <Paged kind="plain" items={measures} render={(one) => <li key={one.name}>{<Measure measure={one} />}</li>} />
        </fieldset>
      )}
    </div>
  );
}

/** The rule has the name as a whole word in its trigger, guard or conditions. */
function mentions(rule: Rule, name: string): boolean {
  if (rule.trigger === name) return true;
  const formulas = [rule.guard, ...rule.clauses.map((clause) => clause.condition)];
  return formulas.some((formula) => formula !== null && ` ${formula.replace(/[()]/g, " ")} `.includes(` ${name} `));
}

function Switch({ name, on, change }: { name: string; on: boolean; change: (on: boolean) => void }) {
  return (
    <label class="switch" title={name}>
      <input type="checkbox" role="switch" checked={on} onChange={(event) => change(event.currentTarget.checked)} />
      <span class="track" aria-hidden="true" />
      <span>{spoken(name)}</span>
    </label>
  );
}

function Measure({ measure }: { measure: Condition }) {
  // What the user is typing: "36." is not a number yet, and must stay as it is.
  const [typed, setTyped] = useState<string | null>(null);
  const value = valueOf(measure);
  if (measure.kind === "scale")
    return (
      <label class="measure" title={measure.name}>
        <span>{spoken(measure.name)}</span>
        <select value={String(value ?? "")} onChange={(event) => setValue(measure.name, event.currentTarget.value || null)}>
          <option value="">{t("notGiven")}</option>
          {measure.values?.map((one) => (
            <option key={one} value={one} title={String(one)}>
              {spoken(String(one))}
            </option>
          ))}
        </select>
      </label>
    );
  const set = (text: string): void => {
    const number = Number(text);
    if (!text.trim()) setValue(measure.name, null);
    else if (Number.isFinite(number)) setValue(measure.name, measure.whole ? Math.round(number) : number);
  };
  const step = measure.whole ? 1 : "any";
  const label = spoken(measure.name);
  return (
    <div class="measure" title={measure.name} role="group" aria-label={label}>
      <span>{label}</span>
      <input
        type="range"
        aria-label={label}
        min={measure.minimum ?? 0}
        max={measure.maximum ?? 100}
        step={measure.whole ? 1 : 0.5}
        value={nearest(value ?? measure.minimum ?? 0)}
        aria-valuetext={value === null ? t("notGiven") : String(value)}
        onInput={(event) => set(event.currentTarget.value)}
      />
      <input
        type="number"
        aria-label={label}
        placeholder={t("notGiven")}
        step={step}
        value={typed ?? (value === null ? "" : nearest(value))}
        onInput={(event) => {
          setTyped(event.currentTarget.value);
          set(event.currentTarget.value);
        }}
        onBlur={(event) => {
          if (event.currentTarget.validity.badInput) event.currentTarget.value = "";
          setTyped(null);
        }}
      />
    </div>
  );
}
