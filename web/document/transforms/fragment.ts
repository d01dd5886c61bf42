import { readProject, type Project, type ProjectExpression } from "tetrafront/project";
import { namesIn, readNumber } from "../../expressions/expression";
import { operationStrings } from "../../strings";
import { emptyProject } from "../create";
import type { Entity } from "../entities";
import { coincidenceLength } from "../insert-shape";
import { projectNumbers } from "../length-units";
import { holderFinder, isAllowed, numberAt } from "../number-paths";
import { PointIndex } from "../point-index";
import { hasParts, selectedParts } from "./selected-parts";

/**
 * The selected records on the clipboard: a project file with nothing else, so that it can be pasted in another tab, or
 * saved as a project.
 */

/** Returns the selected points, lines, patches, bodies and sources as the text of a project; null without any. */
export function fragmentText(project: Project, selection: readonly Entity[]): string | null {
  const parts = selectedParts(project, selection);
  if (!hasParts({ ...parts, nodes: new Set() })) return null;
  const { points, lines, patches } = parts;
  const bodies = (project.bodies ?? []).filter(({ id }) => parts.bodies.has(id));
  const sources = (project.background.sources ?? []).filter(({ id }) => parts.sources.has(id));
  const fragment: Project = {
    ...emptyProject(project.name),
    ...(project.units !== undefined && { units: project.units }),
    points,
    lines,
    patches,
    ...(bodies.length > 0 && { bodies }),
    background: { nodes: [], tetrahedra: [], ...(sources.length > 0 && { sources }) },
  };
  return JSON.stringify({ ...fragment, ...expressionsIn(project, fragment) }, null, 1);
}

/** Returns the expressions of the numbers of a fragment, and the parameters that they use. */
function expressionsIn(project: Project, fragment: Project): Pick<Project, "expressions" | "parameters"> {
  const holder = holderFinder(fragment);
  const expressions = (project.expressions ?? []).filter(
    (kept) => kept.kind !== "meshing" && holder(kept) !== undefined,
  );
  if (expressions.length === 0) return {};
  const parameters = usedParameters(project, expressions);
  return { expressions, ...(parameters.length > 0 && { parameters }) };
}

/** Returns the parameters that expressions use, directly or through other parameters, in the order of the project. */
function usedParameters({ parameters = [] }: Project, expressions: readonly ProjectExpression[]) {
  const texts = new Map(parameters.map(({ name, expression }) => [name, expression]));
  const used = new Set(expressions.flatMap(({ expression }) => [...namesIn(expression)]));
  // A set also visits what is added to it during the loop.
  for (const name of used) for (const other of namesIn(texts.get(name) ?? "")) used.add(other);
  return parameters.filter(({ name }) => used.has(name));
}

/** Returns the project in a text from the clipboard, or why it has none. */
export function readFragment(text: string): { readonly fragment: Project } | { readonly reason: string } {
  const read = readProject(text);
  return read.success ? { fragment: read.value } : { reason: operationStrings.refusals.noFragment };
}

/** Relative difference up to which an expression gives the number that a fragment has. */
const expressionTolerance = 1e-12;

const areSame = (a: number | null, b: number | null): boolean =>
  a === null || b === null ? a === b : Math.abs(a - b) <= expressionTolerance * Math.abs(b);

/**
 * Returns whether the expressions of a fragment give the same numbers in a project: it has their parameters, with the same
 * values. Those of mesh settings do not count, because they are not pasted.
 */
export function hasSameNumbers(project: Project, fragment: Project): boolean {
  const expressions = (fragment.expressions ?? []).filter(({ kind }) => kind !== "meshing");
  if (expressions.length === 0) return true;
  const [values, own] = [projectNumbers(project), projectNumbers(fragment)];
  const holder = holderFinder(fragment);
  return expressions.every((kept) => {
    const number = numberAt(holder(kept), kept.field);
    if (number === undefined) return true;
    const value = readNumber(kept.expression, values);
    // A value that is not allowed leaves the number as it is, in the fragment as in the project.
    const isUsed = value !== null && isAllowed(kept, value);
    return areSame(value, isUsed ? number : readNumber(kept.expression, own));
  });
}

/** Returns whether a point of a fragment lies at one of the project: pasted there, it would hide the original. */
export function coincides(project: Project, { points }: Project): boolean {
  const positions = points.map(({ position }) => position);
  const index = new PointIndex<number>(coincidenceLength(project, positions));
  for (const { id, position } of project.points) index.add(position, id);
  return positions.some((position) => index.find(position) !== undefined);
}

/** Returns the entities of a fragment that nothing else in it is built on. */
export function fragmentEntities({ points, lines, patches, bodies = [], background }: Project): Entity[] {
  const usedLines = new Set(patches.flatMap(({ loops }) => loops.flat().map(Math.abs)));
  const usedPoints = new Set(lines.flatMap((line) => line.points));
  const entities = (kind: Entity["kind"], list: readonly { readonly id: number }[]): Entity[] =>
    list.map(({ id }) => ({ kind, id }));
  return [
    ...entities("patch", patches),
    ...entities(
      "line",
      lines.filter(({ id }) => !usedLines.has(id)),
    ),
    ...entities(
      "point",
      points.filter(({ id }) => !usedPoints.has(id)),
    ),
    ...entities("body", bodies),
    ...entities("source", background.sources ?? []),
  ];
}
