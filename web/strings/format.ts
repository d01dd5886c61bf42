/** Formats numbers in the same way on every machine. */

export function formatCount(value: number): string {
  return value.toLocaleString("en-US");
}

/** Returns a number with its noun: "1 point", "1,200 points". `many`: the plural, by default with an s. */
export function formatCounted(count: number, one: string, many = `${one}s`): string {
  return `${formatCount(count)} ${count === 1 ? one : many}`;
}

/** Returns a coordinate or size with at most nine digits: 0.1, 1.25, 1e-7. */
export function formatNumber(value: number): string {
  return String(Number(value.toPrecision(9)));
}

/** Returns a number with at most four digits, for narrow columns. */
export function formatShort(value: number): string {
  return String(Number(value.toPrecision(4)));
}

const powers = { 1: "", 2: "²", 3: "³" } as const;

/** Numbers from here on have their digits in groups, up to those that are written with a power of ten. */
const grouped = { from: 1e4, to: 1e21 } as const;

/** Returns a length, area or volume with at most four digits and its unit, if the unit is known: 3,142,000 mm³. */
export function formatMeasure(
  value: number,
  unit: string | undefined,
  power: keyof typeof powers = 1,
): string {
  const size = Math.abs(value);
  const isLong = size >= grouped.from && size < grouped.to;
  const digits = isLong ? formatCount(Number(value.toPrecision(4))) : formatShort(value);
  return unit === undefined || unit === "" ? digits : `${digits} ${unit}${powers[power]}`;
}

export function formatPosition(position: readonly number[]): string {
  return position.map(formatShort).join(", ");
}

export function formatSeconds(seconds: number): string {
  return seconds < 10 ? `${seconds.toFixed(2)} s` : `${seconds.toFixed(1)} s`;
}

export function formatShare(share: number): string {
  return `${(100 * share).toFixed(1)} %`;
}

/** Returns a share with at most two digits: 62 %, 8.5 %. */
export function formatShortShare(share: number): string {
  return `${Number((100 * share).toPrecision(2))} %`;
}

export function formatAngle(degrees: number): string {
  return `${degrees.toFixed(1)}°`;
}

const units = [
  ["minute", 60],
  ["hour", 24],
  ["day", 7],
] as const;

/** Returns a past time, in milliseconds since 1970: "now", "5 minutes ago", "yesterday", or the date. */
export function formatTime(at: number, now: number): string {
  const relative = new Intl.RelativeTimeFormat("en", { numeric: "auto" });
  let amount = Math.floor(Math.max(0, now - at) / 60_000);
  if (amount === 0) return relative.format(0, "second");
  for (const [unit, count] of units) {
    if (amount < count) return relative.format(-amount, unit);
    amount = Math.floor(amount / count);
  }
  return new Intl.DateTimeFormat("en", { dateStyle: "medium" }).format(at);
}
