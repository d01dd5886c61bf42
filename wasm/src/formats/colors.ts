/** Groups faces into patches by colour, in formats where colours are the only way to distinguish patches. */
import type { ByteReader } from "./byte-reader.js";
import type { GroupList } from "./mesh-builder.js";

/** Reads up to four numbers from the rest of the line; stops at the first word that is not a number. */
export function numbersInLine(reader: ByteReader): number[] {
  const numbers: number[] = [];
  for (let word = reader.wordInLine(); word !== "" && numbers.length < 4; word = reader.wordInLine()) {
    const value = Number(word);
    if (!Number.isFinite(value)) break;
    numbers.push(value);
  }
  return numbers;
}

/**
 * Returns the patch of a colour. The colour is red, green, blue and optional further numbers, from 0 to 255, or
 * from 0 to 1 if a component has a fraction. A single number is an index of a colour table.
 */
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

/** Returns a colour as text such as "#ff8000". */
export function hexOf(color: readonly number[]): string {
  return `#${color
    .map((value) =>
      Math.round(255 * value)
        .toString(16)
        .padStart(2, "0"),
    )
    .join("")}`;
}
