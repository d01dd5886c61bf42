/** Faces of one colour are a patch: in formats without names it is all that tells them apart. */
import type { ByteReader } from "./byte-reader.js";
import type { GroupList } from "./mesh-builder.js";

/** What is left of a line as numbers, up to four of them; what is no number ends them. */
export function numbersInLine(reader: ByteReader): number[] {
  const numbers: number[] = [];
  for (let word = reader.wordInLine(); word !== "" && numbers.length < 4; word = reader.wordInLine()) {
    const value = Number(word);
    if (!Number.isFinite(value)) break;
    numbers.push(value);
  }
  return numbers;
}

/** The patch of a colour: red, green, blue and maybe more from 0 to 255, or, where one has a fraction, to 1. */
export function colorPatch(patches: GroupList, numbers: readonly number[]): number {
  const [red, green, blue] = numbers;
  if (red === undefined) return patches.of("surface", () => ({ name: "surface", tag: 1 }));
  if (green === undefined || blue === undefined) {
    return patches.of(`color ${red}`, () => ({ name: `color ${red}`, tag: patches.length + 1 }));
  }
  const given = [red, green, blue] as const;
  const scale = given.every((value) => Number.isInteger(value)) && given.some((value) => value > 1) ? 255 : 1;
  const [r, g, b] = given.map((value) => Math.min(1, Math.max(0, value / scale)));
  const color = [r ?? 0, g ?? 0, b ?? 0] as const;
  return patches.named(hexOf(color), color);
}

/** "#ff8000". */
export function hexOf(color: readonly number[]): string {
  return `#${color
    .map((value) =>
      Math.round(255 * value)
        .toString(16)
        .padStart(2, "0"),
    )
    .join("")}`;
}
