import type { Project } from "tetrafront/project";
import { formulaText, quantity, times, type Quantity } from "../../expressions/quantity";
import { expressionFinder, withKept, type KeptExpression } from "../expression-edits";
import { numberAt, recordFinder, type EntityNumber } from "../number-paths";
import { isTooLong, type QuantityPosition } from "../quantity-positions";
import type { Affine } from "./affine";
import { mapQuantities, mapQuantityDirection, typedMap } from "./typed-maps";

/** What has numbers that a map of space changes. */
type Mapped = EntityNumber["kind"];

/** An entity, and the id of its image: its own if it is moved. */
export interface Image {
  readonly kind: Mapped;
  readonly id: number;
  readonly image: number;
}

const positions: { readonly [K in Mapped]: readonly string[] } = {
  point: ["position"],
  "background-node": ["position"],
  source: ["positions.0", "positions.1", "positions.2"],
  body: ["placement.position"],
};

const lengths: { readonly [K in Mapped]: readonly string[] } = {
  point: [],
  "background-node": ["size"],
  source: ["size", "distance"],
  body: ["placement.scale"],
};

/** Returns whether a project or a map has expressions, so that images of entities may have some. */
export const hasExpressions = ({ expressions }: Project, map: Affine): boolean =>
  map.typed !== undefined || expressions !== undefined;

/**
 * Returns the expressions of images after a map; null for numbers without one. Returns null instead if one of them cannot be
 * expressed or is too long for the file: what follows a parameter in part would be distorted. O(images + entities of their
 * kinds).
 */
export function mappedExpressions(
  project: Project,
  images: readonly Image[],
  map: Affine,
): readonly KeptExpression[] | null {
  if (!hasExpressions(project, map)) return [];
  const typed = typedMap(map);
  const [find, textOf] = [recordFinder(project), expressionFinder(project)];
  const kept: KeptExpression[] = [];
  for (const { kind, id, image } of images) {
    if (kind === "body" && typed.rotates) return null;
    const record = find({ kind, id });
    const quantityAt = (field: string): Quantity | null => {
      const value = numberAt(record, field);
      return value === undefined ? null : quantity(value, textOf({ kind, id, field }));
    };
    const keep = (field: string, of: Quantity): void => {
      kept.push({ path: { kind, id: image, field }, expression: formulaText(of) });
    };
    const mapPart = (field: string, mapped: (part: QuantityPosition) => QuantityPosition): void => {
      const [x, y, z] = [0, 1, 2].map((axis) => quantityAt(`${field}.${axis}`));
      if (x == null || y == null || z == null) return;
      mapped([x, y, z]).forEach((part, axis) => keep(`${field}.${axis}`, part));
    };
    for (const field of positions[kind]) mapPart(field, (part) => mapQuantities(typed, part));
    if (kind === "background-node") {
      for (const field of ["direction", "secondDirection"]) {
        mapPart(field, (part) => mapQuantityDirection(typed, part));
      }
    }
    for (const field of lengths[kind]) {
      const length = quantityAt(field);
      if (length !== null) keep(field, times(typed.factor, length));
    }
  }
  return kept.some(({ expression }) => isTooLong(expression)) ? null : kept;
}

/** Returns what forgets all expressions of entities. */
export function forgotten({ expressions = [] }: Project, images: readonly Image[]): KeptExpression[] {
  const keys = new Set(images.map(({ kind, image }) => `${kind} ${image}`));
  return expressions.flatMap(({ expression: _, ...path }) =>
    path.kind !== "meshing" && keys.has(`${path.kind} ${path.id}`) ? [{ path, expression: null }] : [],
  );
}

/** Returns the expressions of the coordinates of new points. Points that the model had keep their own. */
export function keptCoordinates(
  { points }: Project,
  pointIds: readonly (number | undefined)[],
  texts: readonly (readonly (string | null)[])[],
): readonly KeptExpression[] {
  const before = new Set(points.map(({ id }) => id));
  return pointIds.flatMap((id, index) =>
    id === undefined || before.has(id)
      ? []
      : (texts[index] ?? []).map((expression, axis): KeptExpression => ({
          path: { kind: "point", id, field: `position.${axis}` },
          expression,
        })),
  );
}

/** Returns the expressions of a project with those to keep, as a change; nothing if there are none to keep. */
export const keptInstead = (
  { expressions = [] }: Project,
  kept: readonly KeptExpression[],
): Partial<Project> => (kept.length > 0 ? { expressions: withKept(expressions, kept) } : {});
