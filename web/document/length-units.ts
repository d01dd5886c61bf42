import { LIMITS, LENGTH_UNITS, type LengthUnit } from "tetrafront";
import type { BodyPlacement, Project, ProjectBody } from "tetrafront/project";
import { namesIn, readNumber, unitsIn, type NamedNumbers } from "../expressions/expression";
import { dependentParameters, parameterValues } from "../expressions/parameters";
import { bodyStepNames, stepNames } from "../strings";
import { setPlacement } from "./body-edits";
import type { ProjectEdit } from "./edit";

/** Micrometres per unit, all whole numbers: ratios of them are as exact as a double. */
const micrometres: Readonly<Record<LengthUnit, number>> = {
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
export const unitOf = (text: string | undefined): LengthUnit | undefined =>
  LENGTH_UNITS.find((unit) => unit === text);

/** Returns the number of `to` in one `from`. */
export const unitFactor = (from: LengthUnit, to: LengthUnit): number => micrometres[from] / micrometres[to];

/**
 * Returns the function that converts lengths: it multiplies by a whole number and divides by another one, so that millimetres
 * become metres like the decimal number.
 */
export function lengthConverter(from: LengthUnit, to: LengthUnit): (length: number) => number {
  const [numerator, denominator] = [micrometres[from], micrometres[to]];
  const divisor = greatestDivisor(numerator, denominator);
  return (length) => (length * (numerator / divisor)) / (denominator / divisor);
}

const greatestDivisor = (a: number, b: number): number => (b === 0 ? a : greatestDivisor(b, a % b));

/** The values of all units in a unit. */
const unitValues = new Map<LengthUnit, ReadonlyMap<string, number>>(
  LENGTH_UNITS.map((to) => [to, new Map(LENGTH_UNITS.map((unit) => [unit, unitFactor(unit, to)]))]),
);

/** Returns the numbers that expressions of a project may use: its parameters, and units of length if it has one itself. */
export function projectNumbers({ parameters, units }: Pick<Project, "parameters" | "units">): NamedNumbers {
  const unit = unitOf(units);
  return parameterValues(parameters, unit && unitValues.get(unit));
}

/** Returns the unit of the given coordinates of a body, from its scale; undefined if no unit has this scale. */
export function unitOfBody({ placement }: ProjectBody, units: LengthUnit): LengthUnit | undefined {
  const { scale = 1 } = placement ?? {};
  return LENGTH_UNITS.find((unit) => Math.abs(unitFactor(unit, units) / scale - 1) < tolerance);
}

/** Returns a placement with the scale of a unit: its position and rotation stay. */
export function placementInUnit(
  placement: BodyPlacement | undefined,
  from: LengthUnit,
  to: LengthUnit,
): BodyPlacement {
  return { ...placement, scale: unitFactor(from, to) };
}

/** Sets the unit of the coordinates of a body; the body is scaled to the unit of the project. */
export function setBodyUnit(body: ProjectBody, from: LengthUnit, to: LengthUnit): ProjectEdit {
  const { mergeKey: _, ...edit } = setPlacement(body.id, placementInUnit(body.placement, from, to));
  return { ...edit, label: bodyStepNames.setUnit(body.id) };
}

/**
 * Sets the length unit of the project; its numbers stay, so expressions with units become numbers. Null removes the unit.
 */
export function setProjectUnit(units: LengthUnit | null): ProjectEdit {
  return {
    label: stepNames.setUnits,
    change: ({ project }) => {
      const values = projectNumbers({ units: project.units, parameters: [...(project.parameters ?? [])] });
      for (const parameter of project.parameters ?? []) {
        const value = values.get(parameter.name);
        if (hasUnits(parameter.expression) && value !== undefined) parameter.expression = String(value);
      }
      const rest = project.expressions?.filter(({ expression }) => !hasUnits(expression));
      if (rest) project.expressions = rest;
      if (units === null) delete project.units;
      else project.units = units;
    },
  };
}

const hasUnits = (expression: string): boolean => [...unitsIn(expression)].some((word) => unitOf(word));

/** Returns whether a project has lengths that another unit would change. */
export const hasLengths = ({ points, bodies = [], background, meshing }: Project): boolean =>
  points.length + bodies.length + background.nodes.length > 0 ||
  (background.sources ?? []).length > 0 ||
  meshing?.size !== undefined;

/**
 * Converts all lengths of a project to another unit: the model stays as large as it is. Expressions with units stay; others
 * are multiplied. Parameters without units stay, because they may be no lengths.
 */
export function convertProject(project: Project, from: LengthUnit, to: LengthUnit): ProjectEdit {
  const factor = unitFactor(from, to);
  const convert = (x: number): number => Number((x * factor).toPrecision(15));
  const place = ([x, y, z]: readonly [number, number, number]) =>
    [convert(x), convert(y), convert(z)] as const;
  const { points, bodies, background, meshing, expressions } = project;
  const { nodes, sources } = background;
  const replace: Partial<Project> = {
    units: to,
    points: points.map((point) => ({ ...point, position: place(point.position) })),
    ...(bodies && { bodies: bodies.map((body) => convertedBody(body, convert)) }),
    background: {
      ...background,
      nodes: nodes.map((node) => ({ ...node, position: place(node.position), size: convert(node.size) })),
      ...(sources && {
        sources: sources.map((source) => ({
          ...source,
          positions: source.positions.map(place),
          size: convert(source.size),
          ...(source.distance !== undefined && { distance: convert(source.distance) }),
        })),
      }),
    },
    ...(meshing?.size !== undefined && { meshing: { ...meshing, size: convert(meshing.size) } }),
    ...(expressions && { expressions: convertedExpressions(project, to, factor) }),
  };
  return { label: stepNames.convertUnits(from, to), replace };
}

/** The triangles of a body stay: its placement converts them. */
function convertedBody(body: ProjectBody, convert: (x: number) => number): ProjectBody {
  const { position, scale = 1 } = body.placement ?? {};
  const lengths = ["size", "minSize", "maxSize", "tolerance"] as const;
  const { remeshing } = body;
  return {
    ...body,
    placement: {
      ...body.placement,
      ...(position && {
        position: [convert(position[0]), convert(position[1]), convert(position[2])] as const,
      }),
      scale: convert(scale),
    },
    ...(remeshing && {
      remeshing: {
        ...remeshing,
        ...Object.fromEntries(
          lengths.flatMap((key) => (remeshing[key] === undefined ? [] : [[key, convert(remeshing[key])]])),
        ),
      },
    }),
  };
}

/** Relative difference of a converted number and the value of its expression, up to which they agree. */
const agreementTolerance = 1e-12;

function convertedExpressions(
  project: Project,
  to: LengthUnit,
  factor: number,
): NonNullable<Project["expressions"]> {
  const [before, after] = [projectNumbers(project), projectNumbers({ ...project, units: to })];
  const { parameters = [] } = project;
  const inUnits = new Set(
    parameters
      .filter(({ expression }) => hasUnits(expression))
      .flatMap(({ name }) => [...dependentParameters(parameters, name)]),
  );
  const followsUnit = (text: string): boolean =>
    hasUnits(text) || [...namesIn(text)].some((name) => inUnits.has(name));
  return (project.expressions ?? []).flatMap((kept) => {
    const value = readNumber(kept.expression, before);
    if (value === null || !isLength(kept.field)) return [kept];
    const fits = (text: string): boolean => {
      const next = readNumber(text, after);
      const expected = value * factor;
      return next !== null && Math.abs(next - expected) <= agreementTolerance * Math.abs(expected);
    };
    const scaled = `(${kept.expression})*${factor}`;
    // A value of 0 fits without a factor too, until a parameter changes.
    const texts = followsUnit(kept.expression) || factor === 1 ? [kept.expression, scaled] : [scaled];
    const text = texts.find((one) => one.length <= LIMITS.expression && fits(one));
    return text === undefined ? [] : [{ ...kept, expression: text }];
  });
}

/** Returns whether the number of a field is a length: others are ratios, angles and directions. */
const isLength = (field: string): boolean =>
  /position|[sS]ize|distance|scale|tolerance/.test(field) && !field.includes("direction");

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
