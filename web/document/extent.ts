import type { Project } from "tetrafront/project";

/** Extrema of lists of any length. No list is spread into arguments: long ones would overflow the stack. */

/** Returns the lowest and the highest coordinate along an axis; [Infinity, -Infinity] for an empty list. */
export function rangeAlong(
  points: Iterable<{ readonly position: readonly number[] }>,
  axis: number,
): readonly [low: number, high: number] {
  let low = Infinity;
  let high = -Infinity;
  for (const { position } of points) {
    const value = position[axis] ?? 0;
    if (value < low) low = value;
    if (value > high) high = value;
  }
  return [low, high];
}

/** Returns the smallest positive size of the nodes of the background grid; undefined without any. */
export function smallestSize({ background }: Project): number | undefined {
  const smallest = background.nodes.reduce(
    (min, { size }) => (size > 0 && size < min ? size : min),
    Infinity,
  );
  return Number.isFinite(smallest) ? smallest : undefined;
}

/** Returns the size of all nodes of the background grid; undefined if they differ, are stretched, or there are none. */
export function uniformSize({ background }: Project): number | undefined {
  const known = uniformSizes.get(background);
  if (known) return known.size;
  const { nodes } = background;
  const size = nodes[0]?.size;
  const isUniform = nodes.every(
    (node) => node.size === size && (node.stretching ?? 1) === 1 && (node.secondStretching ?? 1) === 1,
  );
  const found = { size: isUniform ? size : undefined };
  uniformSizes.set(background, found);
  return found.size;
}

/** The answers for grids, which may have millions of nodes, and are asked for by each problem at each render. */
const uniformSizes = new WeakMap<Project["background"], { readonly size: number | undefined }>();

/** Returns the diagonal of the box around points; 0 without any. */
export function diagonalOf(points: readonly { readonly position: readonly number[] }[]): number {
  if (points.length === 0) return 0;
  return Math.hypot(
    ...[0, 1, 2].map((axis) => {
      const [low, high] = rangeAlong(points, axis);
      return high - low;
    }),
  );
}

/** Returns a size that the user can change: the smallest of the grid, or else about a twentieth of the model. */
export function likelySize(project: Project): number {
  const extents = [0, 1, 2].map((axis) => {
    const [low, high] = rangeAlong(project.points, axis);
    return Math.max(0, high - low);
  });
  const rough = smallestSize(project) ?? (Math.max(...extents) || 1) / 20;
  return Number(rough.toPrecision(2));
}
