/** Python counts characters, JavaScript counts UTF-16 units. They differ after each character above U+FFFF. */

import type { Span } from "./types";

const HIGH = /[\ud800-\udbff]/;

/** Changes all spans in `value`, at any depth, from characters of `text` to offsets of a JavaScript string. */
export function withOffsets<T>(value: T, text: string): T {
  if (!HIGH.test(text)) return value;
  const offsets: number[] = [];
  let offset = 0;
  for (const character of text) {
    offsets.push(offset);
    offset += character.length;
  }
  offsets.push(offset);
  change(value, (place) => offsets[Math.min(place, offsets.length - 1)] ?? text.length);
  return value;
}

function change(value: unknown, offset: (place: number) => number): void {
  if (typeof value !== "object" || value === null) return;
  if (isSpan(value)) {
    value.start = offset(value.start);
    value.end = offset(value.end);
  }
  Object.values(value).forEach((part) => change(part, offset));
}

function isSpan(value: object): value is Span {
  return "start" in value && "end" in value && typeof value.start === "number" && typeof value.end === "number";
}
