/** Events on a timeline, and the windows in which obligations are due. */

import { batch, computed, effect, signal } from "@preact/signals";
import { Latest } from "../api/latest";
import { Refusal, server } from "../api/requests";
import { language } from "../messages";
import type { Finding, TimedEvent, TimelineAnswer, Value } from "../api/types";
import { goodText, names } from "./analysis";
import { scope, show, situation } from "./situation";

/** `wait` is a time at which nothing happens, to see what is missed until then. */
export type PlacedKind = "trigger" | "executed" | "true" | "false" | "wait";

/** Something at a time, in seconds. */
export interface Placed {
  id: number;
  kind: PlacedKind;
  name: string;
  time: number;
}

export const placed = signal<Placed[]>([]);
export const answer = signal<TimelineAnswer>({ windows: [], problems: [], impossible: null });

let last = 0;

export function place(kind: PlacedKind, name: string, time: number): void {
  last += 1;
  placed.value = [...placed.value, { id: last, kind, name, time }];
}

/** Places the events of a finding. The first values are those of the situation; later ones are placed. */
export function showEvents(moments: NonNullable<Finding["timeline"]>): void {
  const found: Omit<Placed, "id">[] = [];
  let values: Record<string, Value> = {};
  for (const { time, events, conditions } of moments) {
    for (const [name, value] of Object.entries(conditions))
      if (name in values && values[name] !== value) found.push({ kind: value === true ? "true" : "false", name, time });
    values = { ...values, ...conditions };
    for (const name of events) found.push({ kind: names.value.triggers.includes(name) ? "trigger" : "executed", name, time });
  }
  const first = moments.reduceRight<Record<string, Value>>((all, { conditions }) => ({ ...all, ...conditions }), {});
  batch(() => {
    show({ triggers: [], conditions: first });
    placed.value = found.map((one) => ({ ...one, id: ++last }));
  });
}

/** A placed event can make a condition true or false, but cannot give a measure another value. */
export function canShow(moments: NonNullable<Finding["timeline"]>): boolean {
  const seen: Record<string, Value> = {};
  return moments.every(({ conditions }) =>
    Object.entries(conditions).every(([name, value]) => typeof value === "boolean" || (seen[name] ??= value) === value),
  );
}

export function move(id: number, time: number): void {
  const rounded = Math.max(0, Math.round(time));
  placed.value = placed.value.map((one) => (one.id === id ? { ...one, time: rounded } : one));
}

export function remove(id: number): void {
  placed.value = placed.value.filter((one) => one.id !== id);
}

/** The end of the axis while an event is dragged, so that the axis stays as it is. */
export const fixedEnd = signal<number | null>(null);
/** The end of the axis: a little after the last event and the last end of a window. */
export const end = computed(() => {
  if (fixedEnd.value !== null) return fixedEnd.value;
  const ends = answer.value.windows.map((window) => window.to ?? window.from);
  return Math.max(10, ...placed.value.map((one) => one.time), ...ends) * 1.08;
});

/** The events in order of time. Conditions have the values of the situation, until an event changes them. */
const events = computed<TimedEvent[]>(() => {
  const known = new Set([...names.value.triggers, ...names.value.obligations, ...names.value.conditions.map((one) => one.name)]);
  const conditions: Record<string, Value> = { ...situation.value.conditions };
  const times = [...new Set(placed.value.map((one) => one.time))].sort((a, b) => a - b);
  return times.map((time) => {
    const now = placed.value.filter((one) => one.time === time && (one.kind === "wait" || known.has(one.name)));
    for (const one of now) if (one.kind === "true" || one.kind === "false") conditions[one.name] = one.kind === "true";
    const called = (kind: PlacedKind): string[] => now.filter((one) => one.kind === kind).map((one) => one.name);
    return { time, triggers: called("trigger"), executed: called("executed"), conditions: { ...conditions } };
  });
});

const latest = new Latest();

export function keepTiming(): void {
  effect(() => {
    const text = goodText.value;
    if (text === null || events.value.length === 0) return void (answer.value = { windows: [], problems: [], impossible: null });
    if (server.value !== "here") return;
    latest
      .ask<TimelineAnswer>("timeline", { text, events: events.value, ...scope.value, language: language.value })
      .then((found) => found && batch(() => (answer.value = found)))
      .catch((error: unknown) => {
        if (!(error instanceof Refusal)) throw error;
        answer.value = { ...answer.peek(), problems: [error.message] };
      });
  });
}
