/** Numbers as the app shows them; the same on every machine. */

export function formatCount(value: number): string {
  return value.toLocaleString("en-US");
}

/** A coordinate or size as briefly as it can be said to nine digits: 0.1, 1.25, 1e-7. */
export function formatNumber(value: number): string {
  return String(Number(value.toPrecision(9)));
}

/** For narrow columns: four digits. */
export function formatShort(value: number): string {
  return String(Number(value.toPrecision(4)));
}

export function formatPlace(at: readonly number[]): string {
  return at.map(formatShort).join(", ");
}

export function formatSeconds(seconds: number): string {
  return seconds < 10 ? `${seconds.toFixed(2)} s` : `${seconds.toFixed(1)} s`;
}

export function formatShare(share: number): string {
  return `${(100 * share).toFixed(1)} %`;
}

export function formatAngle(degrees: number): string {
  return `${degrees.toFixed(1)}°`;
}
