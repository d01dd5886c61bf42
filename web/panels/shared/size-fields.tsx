import type { Project } from "tetrafront/project";
import { smallestSize } from "../../document/extent";
import { strings } from "../../strings";
import { Unit } from "../../ui/fields/unit";

/** Steps, checks and units of fields for sizes and positions. */

/** Returns a round step for coordinates: about a tenth of the smallest size of the project. */
export function stepFor(project: Project): number {
  const smallest = smallestSize(project) ?? 1;
  return 10 ** Math.round(Math.log10(smallest / 10));
}

export const aboveZero = (value: number): string | null => (value > 0 ? null : strings.fields.aboveZero);
export const notNegative = (value: number): string | null => (value >= 0 ? null : strings.fields.notNegative);
/** Adds an upper limit to `refuse`. The limits are those of the file format. */
export const upTo =
  (limit: number, refuse: (value: number) => string | null) =>
  (value: number): string | null =>
    refuse(value) ?? (value > limit ? strings.fields.atMost(limit) : null);
export const atLeastOne = (value: number): string | null => (value >= 1 ? null : strings.fields.atLeastOne);
/** Limits of a feature angle, in degrees. */
export const featureAngle = upTo(180, atLeastOne);

/** Returns a round step for a size: between a fiftieth and a fifth of it. */
export const sizeStep = (size: number): number => (size > 0 ? 10 ** Math.floor(Math.log10(size / 5)) : 0.1);

export const unitsOf = ({ units }: Project) =>
  units === undefined ? {} : { rightSection: <Unit>{units}</Unit> };
