import type { ProjectBodyPatch } from "tetrafront";

/** Returns whether a patch has a colour, as in its file. */
export const hasColors = (patches: readonly ProjectBodyPatch[]): boolean =>
  patches.some(({ color }) => color !== undefined);

/** Colour of patches without one, beside others that have one. */
const grey = [0.75, 0.75, 0.75] as const;

/** Returns a colour as a number below 2^24, which a float represents exactly: the view passes it as a value. */
export function packedColor(color: ProjectBodyPatch["color"] = grey): number {
  const [red, green, blue] = color.map((part) => Math.round(255 * part)) as [number, number, number];
  return (red << 16) | (green << 8) | blue;
}
