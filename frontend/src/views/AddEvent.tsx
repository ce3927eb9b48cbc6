/** The form that places an event on the timeline. */

import { useState } from "preact/hooks";
import { t, type Message } from "../messages";
import { names } from "../state/analysis";
import { place, type PlacedKind } from "../state/timeline";
import { spoken } from "../words";

const KINDS: Record<PlacedKind, Message> = {
  trigger: "timelineTrigger",
  executed: "timelineExecuted",
  true: "timelineCondition",
  false: "timelineConditionOff",
  wait: "timelineWait",
};

/** The greatest time in seconds. */
const MOST = 1e9;

const UNITS: [number, Message][] = [
  [1, "seconds"],
  [60, "minutes"],
  [3600, "hours"],
  [86_400, "days"],
];

export function AddEvent() {
  const [kind, setKind] = useState<PlacedKind>("trigger");
  const [name, setName] = useState("");
  const [time, setTime] = useState("0");
  const [unit, setUnit] = useState(1);
  const all: Record<PlacedKind, string[]> = {
    trigger: names.value.triggers,
    executed: names.value.obligations,
    true: names.value.conditions.filter((one) => one.kind === "boolean").map((one) => one.name),
    false: names.value.conditions.filter((one) => one.kind === "boolean").map((one) => one.name),
    wait: [""],
  };
  const options = all[kind];
  const chosen = options.includes(name) ? name : options[0];
  return (
    <form
      class="toolbar"
      onSubmit={(event) => {
        event.preventDefault();
        const seconds = Number(time) * unit;
        if (chosen === undefined || !time.trim() || !(seconds >= 0 && seconds <= MOST)) return;
        place(kind, chosen, Math.round(seconds));
        setTime(String(Number(time) + (unit === 1 ? 5 : 1)));
      }}
    >
      <label>
        {t("timelineKind")}
        <select value={kind} onChange={(event) => setKind(event.currentTarget.value as PlacedKind)}>
          {Object.entries(KINDS).map(([one, message]) => (
            <option key={one} value={one}>
              {t(message)}
            </option>
          ))}
        </select>
      </label>
      {kind !== "wait" && (
      <label>
        {t("timelineName")}
        <select value={chosen ?? ""} onChange={(event) => setName(event.currentTarget.value)}>
          {options.map((one) => (
            <option key={one} value={one} title={one}>
              {spoken(one)}
            </option>
          ))}
        </select>
      </label>
      )}
      <label>
        {t("timelineTime")}
        <input type="number" min="0" max={MOST / unit} step="any" required value={time} onInput={(event) => setTime(event.currentTarget.value)} />
      </label>
      <label>
        {t("timelineUnit")}
        <select value={unit} onChange={(event) => setUnit(Number(event.currentTarget.value))}>
          {UNITS.map(([seconds, message]) => (
            <option key={seconds} value={seconds}>
              {t(message)}
            </option>
          ))}
        </select>
      </label>
      <button type="submit" class="main" disabled={chosen === undefined}>
        {t("timelineAddButton")}
      </button>
    </form>
  );
}
