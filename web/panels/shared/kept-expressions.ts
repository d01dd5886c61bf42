import type { Project } from "tetrafront/project";
import { expressionOf } from "../../document/expression-edits";
import type { EntityNumber } from "../../document/number-paths";

/** Returns the expressions of the three coordinates at a field of an entity. */
export const positionExpressions = (
  project: Project,
  { kind, id, field }: EntityNumber,
): (string | undefined)[] =>
  [0, 1, 2].map((axis) => expressionOf(project, { kind, id, field: `${field}.${axis}` }));
