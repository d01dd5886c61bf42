import { UNITS, type BodyPlacement, type Project, type ProjectBody, type Unit } from "tetrafront";
import { bodyStepNames, stepNames } from "../strings";
import { setPlacement } from "./body-edits";
import type { ProjectEdit } from "./edit";

/** Micrometres per unit, all whole numbers: ratios of them are as exact as a double. */
const micrometres: Readonly<Record<Unit, number>> = {
  um: 1,
  mm: 1e3,
  cm: 1e4,
  m: 1e6,
  in: 25_400,
  ft: 304_800,
};

/** Factors that differ by less than this are one factor. */
const tolerance = 1e-9;

/** Returns the unit that a text names; undefined for any other text. */
export const unitOf = (text: string | undefined): Unit | undefined => UNITS.find((unit) => unit === text);

/** Returns the number of `to` in one `from`. */
export const unitFactor = (from: Unit, to: Unit): number => micrometres[from] / micrometres[to];

/** Returns the unit of the given coordinates of a body, from its scale; undefined if no unit has this scale. */
export function unitOfBody({ placement }: ProjectBody, units: Unit): Unit | undefined {
  const { scale = 1 } = placement ?? {};
  return UNITS.find((unit) => Math.abs(unitFactor(unit, units) / scale - 1) < tolerance);
}

/** Returns a placement with the scale of a unit: its position and rotation stay. */
export function placementInUnit(placement: BodyPlacement | undefined, from: Unit, to: Unit): BodyPlacement {
  return { ...placement, scale: unitFactor(from, to) };
}

/** Sets the unit of the coordinates of a body; the body is scaled to the unit of the project. */
export function setBodyUnit(body: ProjectBody, from: Unit, to: Unit): ProjectEdit {
  const { mergeKey: _, ...edit } = setPlacement(body.id, placementInUnit(body.placement, from, to));
  return { ...edit, label: bodyStepNames.setUnit(body.id) };
}

/** Sets the length unit of the project; its numbers stay. Null removes it. */
export function setProjectUnit(units: Unit | null): ProjectEdit {
  return {
    label: stepNames.setUnits,
    change: ({ project }) => {
      if (units === null) delete project.units;
      else project.units = units;
    },
  };
}

/** Returns bodies of a file in the unit of a project: scaled, if both units are known and differ. */
export function inProjectUnit<Made extends { readonly body: ProjectBody }>(
  made: readonly Made[],
  fileUnit: string | undefined,
  { units }: Project,
): readonly Made[] {
  const [from, to] = [unitOf(fileUnit), unitOf(units)];
  if (!from || !to || from === to) return made;
  return made.map((one) => ({
    ...one,
    body: { ...one.body, placement: placementInUnit(one.body.placement, from, to) },
  }));
}
