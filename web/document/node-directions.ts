import type { Project, ProjectBackgroundNode } from "tetrafront/project";
import { stepNames } from "../strings";
import { finderIn, type Axis, type ProjectDraft } from "./draft-records";
import type { DraftEdit } from "./edit";
import { keepingExpressions } from "./expression-edits";
import type { Position } from "./position";
import { frameAlong, orthogonalTo } from "./vectors";

/** Directions of the stretchings of background nodes. */

export type DirectionField = "direction" | "secondDirection";

/** The directions that the format gives to nodes without one. */
export const defaultDirections: Readonly<Record<DirectionField, Position>> = {
  direction: [1, 0, 0],
  secondDirection: [0, 1, 0],
};

type NodeDraft = ProjectDraft["background"]["nodes"][number];

/** Gives a node a direction if it has none, orthogonal to a second direction. */
export function addDirection(node: NodeDraft): void {
  const { secondDirection } = node;
  node.direction ??= [...(secondDirection ? frameAlong(secondDirection).x : defaultDirections.direction)];
}

/** Gives a node a second direction if it has none, orthogonal to the direction. */
export function addSecondDirection(node: NodeDraft): void {
  node.secondDirection ??= [...frameAlong(node.direction ?? defaultDirections.direction).x];
}

/** Returns the directions of a node after a change of one: the second one becomes orthogonal to the first. */
function changed(
  node: Pick<ProjectBackgroundNode, DirectionField>,
  field: DirectionField,
  axis: Axis,
  value: number,
): Pick<ProjectBackgroundNode, DirectionField> {
  const set = (node[field] ?? defaultDirections[field]).with(axis, value) as unknown as Position;
  const direction = field === "direction" ? set : node.direction;
  const secondDirection = field === "secondDirection" ? set : node.secondDirection;
  return {
    ...(direction && { direction }),
    ...(secondDirection && { secondDirection: orthogonalTo(direction, secondDirection) }),
  };
}

/**
 * Sets a component of a direction of nodes. A second direction stays orthogonal to the direction. The expression is kept at nodes
 * where the component has its value afterwards. O(nodes).
 */
export function setDirections(
  { background }: Project,
  ids: readonly number[],
  field: DirectionField,
  {
    axis,
    value,
    expression,
  }: { readonly axis: Axis; readonly value: number; readonly expression: string | null },
): DraftEdit {
  const chosen = new Set(ids);
  const after = new Map(
    background.nodes
      .filter(({ id }) => chosen.has(id))
      .map((node) => [node.id, changed(node, field, axis, value)]),
  );
  const edit: DraftEdit = {
    label: stepNames.setDirections[field](ids),
    mergeKey: `${field}-${ids.join()}-${axis}`,
    change: ({ project }) => {
      const find = finderIn(project.background.nodes);
      for (const id of ids) {
        const node = find(id);
        if (node) Object.assign(node, after.get(id));
      }
    },
  };
  const kept = Array.from(after, ([id, directions]) => ({
    path: { kind: "background-node", id, field: `${field}.${axis}` } as const,
    expression: directions[field]?.[axis] === value ? expression : null,
  }));
  return keepingExpressions(edit, kept);
}
