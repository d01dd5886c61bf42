import type { Project, ProjectBackgroundNode, ProjectSource } from "tetrafront/project";
import { selectionHints, stepNames } from "../strings";
import { idsOf, nextId, type Offer } from "./create";
import type { ProjectEdit } from "./edit";
import { recordOf } from "./draft-records";
import type { Entity } from "./entities";
import type { Position } from "./position";
import { add, dot, mean, orthogonalTo, scale, unit } from "./vectors";

/** Edits of the background grid in the view: shapes of glyphs, and nodes that split tetrahedra. */

/** What the handles of a node change. */
export interface NodeShape {
  readonly size: number;
  readonly stretching: number;
  readonly direction: Position;
  /** 1 without a second stretching. */
  readonly secondStretching: number;
  readonly secondDirection: Position;
}

/** Sets size, stretchings and directions of a node; a stretching of 1 leaves no direction. The second direction becomes orthogonal to the first. */
export function setNodeShape(id: number, shape: NodeShape): ProjectEdit {
  const { size, stretching, direction, secondStretching, secondDirection } = shape;
  return {
    label: stepNames.setNodeShape(id),
    change: ({ project }) => {
      const node = recordOf(project.background.nodes, id);
      if (!node) return;
      node.size = size;
      if (stretching > 1) {
        node.stretching = stretching;
        node.direction = [...direction];
      } else {
        delete node.stretching;
        delete node.direction;
      }
      if (secondStretching > 1) {
        node.secondStretching = secondStretching;
        node.secondDirection = [...orthogonalTo(node.direction, secondDirection)];
      } else {
        delete node.secondStretching;
        delete node.secondDirection;
      }
    },
  };
}

/** What the handles of a source change. */
export interface SourceShape {
  readonly positions: readonly Position[];
  readonly size: number;
  readonly distance: number;
}

export function setSourceShape(id: number, { positions, size, distance }: SourceShape): ProjectEdit {
  return {
    label: stepNames.setSourceShape(id),
    change: ({ project }) => {
      const source = project.background.sources && recordOf(project.background.sources, id);
      if (!source) return;
      source.positions = positions.map((position) => [...position]);
      source.size = size;
      if (distance > 0 || source.distance !== undefined) source.distance = distance;
    },
  };
}

/**
 * Offers a node in the middle of two, three or four selected nodes that belong to one tetrahedron. It splits all
 * tetrahedra at their common edge, face or tetrahedron, so that the grid still fits together. Its size is the mean.
 */
export function offerSplit(project: Project, selection: readonly Entity[]): Offer {
  const { nodes, tetrahedra } = project.background;
  const ids = new Set(idsOf(selection, "background-node"));
  const around = tetrahedra.filter((corners) => [...ids].every((id) => corners.includes(id)));
  if (ids.size < 2 || ids.size > 4 || around.length === 0) {
    return { possible: false, reason: selectionHints.split };
  }
  const id = nextId(project, "background-node");
  const node = middleOf(
    id,
    nodes.filter((one) => ids.has(one.id)),
  );
  const replaced = new Set(around);
  const split = tetrahedra.flatMap((corners) =>
    replaced.has(corners) ? [...ids].map((gone) => swapped(corners, gone, id)) : [corners],
  );
  return {
    possible: true,
    creation: {
      entities: [{ kind: "background-node", id }],
      edit: {
        label: stepNames.splitTetrahedra(around.length),
        replace: { background: { ...project.background, nodes: [...nodes, node], tetrahedra: split } },
      },
    },
  };
}

type Corners = Project["background"]["tetrahedra"][number];

/** Returns the corners of a tetrahedron with one replaced by another. */
function swapped([a, b, c, d]: Corners, gone: number, by: number): Corners {
  const of = (corner: number): number => (corner === gone ? by : corner);
  return [of(a), of(b), of(c), of(d)];
}

/** Returns a node at the mean position with the mean size; stretched along the mean directions if all are stretched. */
function middleOf(id: number, corners: readonly ProjectBackgroundNode[]): ProjectBackgroundNode {
  const position = mean(corners.map((node) => node.position)) as [number, number, number];
  const node = { id, position, size: meanOf(corners.map(({ size }) => size)) };
  const first = meanStretching(corners.map(({ stretching, direction }) => ({ stretching, direction })));
  const second = meanStretching(
    corners.map(({ secondStretching: stretching, secondDirection: direction }) => ({
      stretching,
      direction,
    })),
  );
  return {
    ...node,
    ...first,
    ...(second && {
      secondStretching: second.stretching,
      secondDirection: first ? orthogonalTo(first.direction, second.direction) : second.direction,
    }),
  };
}

const meanOf = (values: readonly number[]): number =>
  values.reduce((sum, value) => sum + value, 0) / values.length;

type Stretching = Pick<ProjectBackgroundNode, "stretching" | "direction">;

/** Returns the mean stretching and direction; undefined if not all are stretched. */
function meanStretching(
  all: readonly Stretching[],
): { readonly stretching: number; readonly direction: [number, number, number] } | undefined {
  const axes = all.flatMap(({ stretching = 1, direction }) => {
    const axis = stretching > 1 && direction ? unit(direction) : null;
    return axis ? [axis] : [];
  });
  const [first] = axes;
  if (!first || axes.length < all.length) return undefined;
  // Opposite directions are the same axis.
  const sum = axes.reduce((total, axis) => add(total, scale(axis, dot(axis, first) < 0 ? -1 : 1)), [
    0, 0, 0,
  ] as Position);
  const direction = (unit(sum) ?? first) as [number, number, number];
  return { stretching: meanOf(all.map(({ stretching = 1 }) => stretching)), direction };
}

/** Returns a number of three significant digits: a drag needs no more. */
export const rounded = (value: number): number => Number(value.toPrecision(3));

/** Returns the shape of a node, with the direction that a stretching would get. */
export function shapeOfNode({
  size,
  stretching = 1,
  direction = [1, 0, 0],
  secondStretching = 1,
  secondDirection = [0, 1, 0],
}: ProjectBackgroundNode): NodeShape {
  return { size, stretching, direction, secondStretching, secondDirection };
}

export function shapeOfSource({ positions, size, distance = 0 }: ProjectSource): SourceShape {
  return { positions, size, distance };
}
