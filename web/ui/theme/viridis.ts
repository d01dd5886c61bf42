/**
 * The viridis colour map (Smith and van der Walt, 2015, public domain) at eleven even steps, from bad
 * (dark) to good (bright): even in lightness, and readable with colour-deficient sight.
 */
export const viridis = [
  "#440154",
  "#482475",
  "#414487",
  "#355f8d",
  "#2a788e",
  "#21918c",
  "#22a884",
  "#44bf70",
  "#7ad151",
  "#bddf26",
  "#fde725",
] as const;

/** Returns the nearest colour of the scale for a value from 0 to 1. */
export function viridisAt(value: number): string {
  const step = Math.round(Math.min(1, Math.max(0, value)) * (viridis.length - 1));
  return viridis[step] ?? viridis[0];
}
