import type { ProjectBodyPatch } from "tetrafront/project";

/** Returns whether a patch has a colour, as in its file. */
const hasColors = (patches: readonly ProjectBodyPatch[]): boolean =>
  patches.some(({ color }) => color !== undefined);

/** Meaning of the values that the view draws: indices of patches, or the colours of patches that have one. */
export type PatchMeaning = "patch" | "color";

/**
 * Returns the values that the view draws, one per triangle; null if there is nothing to tell apart. With the meaning
 * `color`, a value is a packed colour, or for a patch p without one -1 - p.
 */
export function patchValues(
  trianglePatch: Uint32Array,
  patches: readonly ProjectBodyPatch[],
  meaning: PatchMeaning,
): Float32Array | Uint32Array | null {
  if (meaning === "patch") return patches.length > 1 ? trianglePatch : null;
  const colors = patches.map(({ color }, p) => (color ? packedColor(color) : -1 - p));
  return Float32Array.from(trianglePatch, (patch) => colors[patch] ?? 0);
}

/** Returns a colour as a number below 2^24, which a float represents exactly: the view passes it as a value. */
function packedColor(color: NonNullable<ProjectBodyPatch["color"]>): number {
  const [red, green, blue] = color.map((part) => Math.round(255 * part)) as [number, number, number];
  return (red << 16) | (green << 8) | blue;
}

/** Returns the meaning of the values of a body: colours if a patch has one. */
export const meaningOf = (patches: readonly ProjectBodyPatch[]): PatchMeaning =>
  hasColors(patches) ? "color" : "patch";
