/**
 * Colours of regions, in the order of their numbers: seven of Okabe and Ito's (2008), then five as far from
 * these and each other as could be found. Any two differ by 16 or more in CIE L*a*b*, also for eyes that lack
 * one kind of cone, and none is near the view's background in either scheme.
 */
export const regionColors = [
  "#0072b2",
  "#e69f00",
  "#009e73",
  "#cc79a7",
  "#56b4e9",
  "#d55e00",
  "#f0e442",
  "#8800ff",
  "#773311",
  "#bbee99",
  "#00ffdd",
  "#ff0055",
] as const;

/** Returns the colour of a region, given its index. The colours repeat. */
export function regionColor(region: number): string {
  return regionColors[region % regionColors.length] ?? regionColors[0];
}
