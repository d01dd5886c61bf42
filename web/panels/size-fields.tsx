import type { Project } from "tetrafront";
import { smallestSize } from "../document/extent";
import { strings } from "../strings";
import { Unit } from "../ui/unit";

/** What fields for sizes and places have in common. */

/** A round step for coordinates: about a fiftieth of the size wanted here, at least of the model's. */
export function stepFor(project: Project): number {
  const smallest = smallestSize(project) ?? 1;
  return 10 ** Math.round(Math.log10(smallest / 10));
}

export const aboveZero = (value: number): string | null => (value > 0 ? null : strings.fields.aboveZero);
export const notNegative = (value: number): string | null => (value >= 0 ? null : strings.fields.notNegative);
/** As `refuse`, and up to what the engine takes, for a file with more could not be opened again. */
export const upTo =
  (most: number, refuse: (value: number) => string | null) =>
  (value: number): string | null =>
    refuse(value) ?? (value > most ? strings.fields.atMost(most) : null);
export const atLeastOne = (value: number): string | null => (value >= 1 ? null : strings.fields.atLeastOne);

/** A round step for a size: between a fiftieth and a fifth of it. */
export const sizeStep = (size: number): number => (size > 0 ? 10 ** Math.floor(Math.log10(size / 5)) : 0.1);

export const unitsOf = ({ units }: Project) =>
  units === undefined ? {} : { rightSection: <Unit>{units}</Unit> };
