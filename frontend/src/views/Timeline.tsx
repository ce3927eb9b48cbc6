/** A timeline: events that are placed and moved, and the windows of obligations as bars. */

import { useRef } from "preact/hooks";
import type { Window } from "../api/types";
import { focusNext } from "../focus";
import { t } from "../messages";
import { say } from "../state/announcements";
import { answer, end, fixedEnd, move, placed, remove, type Placed } from "../state/timeline";
import { spoken } from "../words";
import { AddEvent } from "./AddEvent";
import { duration } from "./duration";
import { Old } from "./Old";
import { Scope } from "./Scope";
import { Sentence } from "./Sentence";

const SIGNS: Record<Placed["kind"], string> = { trigger: "⚑", executed: "✓", true: "◉", false: "○", wait: "…" };
const STATES: Record<Window["state"], "windowOpen" | "windowFulfilled" | "windowMissed" | "windowBroken" | "windowImpossible"> = {
  open: "windowOpen",
  fulfilled: "windowFulfilled",
  missed: "windowMissed",
  broken: "windowBroken",
  impossible: "windowImpossible",
};
const TICKS = 6;

export function Timeline() {
  const { windows, problems, impossible } = answer.value;
  return (
    <div class="timeline">
      <p class="intro">{t("timelineIntro")}</p>
      <AddEvent />
      <h3 id="timeline-events">{t("timelineEvents")}</h3>
      <p class="hint">{t("timelineConditions")}</p>
      <Scope />
      {placed.value.length === 0 ? <p class="empty">{t("timelineEmpty")}</p> : <p class="hint">{t("timelineHelp")}</p>}
      {placed.value.length > 0 && (
        <div class="axis" role="group" aria-labelledby="timeline-events">
          <Ticks />
          <div class="lanes">
            {impossible !== null && <Impossible time={impossible} />}
            {placed.value.map((one) => (
              <Marker key={one.id} one={one} />
            ))}
          </div>
          <h3>{t("timelineWindows")}</h3>
          <Old />
          {windows.length === 0 && <p class="empty">{t("timelineNoWindows")}</p>}
          <ul class="windows">
            {windows.map((window, number) => (
              <Bar key={number} window={window} />
            ))}
          </ul>
        </div>
      )}
      <div role="status">
        {problems.map((problem) => (
          <p key={problem} class="refusal">
            <Sentence text={problem} />
          </p>
        ))}
      </div>
    </div>
  );
}

/** The moment from which it is impossible to follow every rule. */
function Impossible({ time }: { time: number }) {
  return <div class="impossible-from" style={{ left: percent(time) }} title={t("windowImpossible")} />;
}

function percent(time: number): string {
  return `${(100 * time) / end.value}%`;
}

function Ticks() {
  const step = niceStep(end.value / TICKS);
  const times = Array.from({ length: Math.floor(end.value / step) + 1 }, (_, number) => number * step);
  return (
    <div class="ticks" aria-hidden="true">
      {times.filter((time) => time < 0.93 * end.value).map((time) => (
        <span key={time} style={{ left: percent(time) }}>
          {duration(time)}
        </span>
      ))}
    </div>
  );
}

/** The least of 1, 2, 5, 10, 15, 30 seconds, minutes, hours and so on that is at least `wanted` seconds. */
function niceStep(wanted: number): number {
  const steps = [1, 60, 3600].flatMap((unit) => [1, 2, 5, 10, 15, 30].map((number) => number * unit));
  return steps.find((step) => step >= wanted) ?? Math.ceil(wanted / 86_400) * 86_400;
}

function Marker({ one }: { one: Placed }) {
  const lane = useRef<HTMLDivElement>(null);
  const name = one.kind === "wait" ? t("timelineWait") : spoken(one.name);
  const drag = (event: PointerEvent): void => {
    const box = lane.current?.getBoundingClientRect();
    const button = event.currentTarget as HTMLElement;
    if (!box || !button.hasPointerCapture(event.pointerId)) return;
    move(one.id, Math.min(((event.clientX - box.left) / box.width) * end.value, end.value));
  };
  const takeAway = (): void => {
    remove(one.id);
    focusNext(".marker", ".timeline select");
  };
  const key = (event: KeyboardEvent): void => {
    const step = event.shiftKey ? 10 : 1;
    const steps: Record<string, number> = {
      ArrowLeft: -step,
      ArrowRight: step,
      ArrowDown: -step,
      ArrowUp: step,
      PageDown: -60,
      PageUp: 60,
    };
    const by = steps[event.key];
    if (event.key === "Delete" || event.key === "Backspace") takeAway();
    else if (event.key === "Home") move(one.id, 0);
    else if (by !== undefined) move(one.id, one.time + by);
    else return;
    event.preventDefault();
  };
  return (
    <div class="lane" ref={lane}>
      <button
        type="button"
        class={`marker ${one.kind} ${one.time > end.value / 2 ? "leftward" : ""}`}
        role="slider"
        aria-label={name}
        aria-valuemin={0}
        aria-valuemax={Math.ceil(end.value)}
        aria-valuenow={one.time}
        aria-valuetext={duration(one.time)}
        title={one.name}
        style={{ left: percent(one.time) }}
        onPointerDown={(event) => {
          event.currentTarget.setPointerCapture(event.pointerId);
          fixedEnd.value = end.value;
        }}
        onPointerMove={drag}
        onLostPointerCapture={() => {
          fixedEnd.value = null;
          say("timelineMoved", { name, time: duration(one.time) });
        }}
        onKeyDown={key}
      >
        <span aria-hidden="true">{SIGNS[one.kind]}</span>
        <span class="marker-name">
          {name} · {duration(one.time)}
        </span>
      </button>
      <button
        type="button"
        class="remove"
        aria-label={t("timelineRemove", { name, time: duration(one.time) })}
        onClick={takeAway}
      >
        ×
      </button>
    </div>
  );
}

function Bar({ window }: { window: Window }) {
  const name = window.negated ? t("windowNot", { name: spoken(window.obligation) }) : spoken(window.obligation);
  const span =
    window.to === window.from
      ? t("windowAt", { from: duration(window.from) })
      : window.to === null
      ? t("windowSince", { from: duration(window.from) })
      : t("windowSpan", { from: duration(window.from), to: duration(window.to) });
  const width = `max(6px, ${(100 * ((window.to ?? end.value) - window.from)) / end.value}%)`;
  return (
    <li title={`${window.rule}${window.clause ? `, ${t("searchClause")} ${window.clause}` : ""}`}>
      <p>
        <strong>{name}</strong> ({spoken(window.rule)}): {span}, <span class={`window-state ${window.state}`}>{t(STATES[window.state])}</span>
        {window.instead_of && ` (${t("windowInstead", { name: spoken(window.instead_of) })})`}
      </p>
      <div class="track" aria-hidden="true">
        {window.state === "impossible" && answer.value.impossible !== null && <Impossible time={answer.value.impossible} />}
        <div class={`bar ${window.state}`} style={{ left: percent(window.from), width }} />
      </div>
    </li>
  );
}
