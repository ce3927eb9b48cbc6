/** A time in seconds as people write it: 90 is "1 min 30 s". */

const UNITS: [number, string][] = [
  [86_400, "d"],
  [3600, "h"],
  [60, "min"],
];

export function duration(seconds: number): string {
  let rest = seconds;
  const parts: string[] = [];
  for (const [size, unit] of UNITS) {
    const number = Math.floor(rest / size);
    if (number > 0) parts.push(`${number} ${unit}`);
    rest -= number * size;
  }
  const last = Math.round(rest * 100) / 100;
  if (last > 0 || parts.length === 0) parts.push(`${last} s`);
  return parts.join(" ");
}
