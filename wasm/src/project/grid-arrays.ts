/** Background grids between their three forms: a project's, flat arrays for callers, and the engine's. */
import * as v from "valibot";
import { numbersOf } from "../base/enums.js";
import { checkArgument } from "../calls/argument-checks.js";
import { refuse } from "../diagnostics/mesher-error.js";
import { type GridArrays, SOURCE_GROWTH, SOURCE_TYPES } from "../generated/constants.js";
import { type BackgroundArrays, checkBackground } from "./background-arrays.js";
import type { ProjectBackground, ProjectBackgroundNode, ProjectSource } from "./project-types.js";
import { noSecondStretchings } from "./second-stretchings.js";

type SourceArrays = GridArrays["sources"];

const SOURCE_TYPE_NUMBERS = numbersOf(SOURCE_TYPES);
/** Coordinates of the positions of a source. */
const SOURCE_COORDINATES = 9;
/** The engine reports a reference to this index as `index-out-of-range`. */
export const NOWHERE = 0x7fffffff;

/**
 * Returns a grid without nodes, for a surface whose sizes come from its own edges. The arrays are new each time,
 * because they are transferred.
 */
export function emptyGrid(): GridArrays {
  return projectGrid({ nodes: [], tetrahedra: [] });
}

/** Returns the project's background grid; callers without type checks may pass a project without one. */
export function backgroundOf({
  background,
}: {
  readonly background?: ProjectBackground | undefined;
}): ProjectBackground {
  return background ?? { nodes: [], tetrahedra: [] };
}

/** Converts a project's grid. References to missing nodes become indices out of range. O(size). */
export function projectGrid(background: ProjectBackground): GridArrays {
  const { nodes, tetrahedra, sources = [], coverageMargin = 0 } = background;
  return {
    nodes: nodeArrays(nodes),
    secondStretchings: secondArrays(nodes),
    tetrahedra: nodeIndices(tetrahedra, indexFinder(nodes)),
    sources: sourceArrays(sources),
    coverageMargin,
  };
}

/** Largest ratio of the highest id to the number of nodes for which a table is used instead of a map. */
const SPARSE_IDS = 4;

/**
 * Returns a function that finds the index of a node by id. Ids usually are 1, 2, 3 …: a table is then ten times as
 * fast as a map.
 */
function indexFinder(nodes: readonly ProjectBackgroundNode[]): (id: number) => number {
  const highest = nodes.reduce((most, { id }) => Math.max(most, id), 0);
  if (highest > SPARSE_IDS * nodes.length) {
    const indices = new Map(nodes.map(({ id }, index) => [id, index]));
    return (id) => indices.get(id) ?? NOWHERE;
  }
  const indices = new Uint32Array(highest + 1).fill(NOWHERE);
  nodes.forEach(({ id }, index) => (indices[id] = index));
  return (id) => indices[id] ?? NOWHERE;
}

/** Writes number by number without temporary arrays: an app calls this after every edit, for grids of any size. */
function nodeIndices(
  tetrahedra: ProjectBackground["tetrahedra"],
  indexOf: (id: number) => number,
): Uint32Array {
  const indices = new Uint32Array(4 * tetrahedra.length);
  let at = 0;
  for (const [a, b, c, d] of tetrahedra) {
    indices[at++] = indexOf(a);
    indices[at++] = indexOf(b);
    indices[at++] = indexOf(c);
    indices[at++] = indexOf(d);
  }
  return indices;
}

/**
 * Returns the grid with the nodes and tetrahedra of a background, if it has any, and with its sources added. The
 * arrays are new, because they are transferred. O(size).
 */
export function withNodes(grid: GridArrays, background: BackgroundArrays): GridArrays {
  const sources = joinedSources(grid.sources, sourceArrays(background.sources ?? []));
  if (background.sizes.length === 0 && background.tetrahedra.length === 0) return { ...grid, sources };
  const { points, sizes, stretchings, directions, tetrahedra, coverageMargin = 0 } = background;
  const { secondStretchings, secondDirections } = background;
  return {
    nodes: {
      position: points.slice(),
      size: sizes.slice(),
      stretching: stretchings?.slice() ?? new Float64Array(sizes.length).fill(1),
      direction: directions?.slice() ?? Float64Array.from(points, (_, i) => Number(i % 3 === 0)),
    },
    secondStretchings: secondStretchings
      ? {
          stretching: secondStretchings.slice(),
          direction: secondDirections?.slice() ?? Float64Array.from(points, (_, i) => Number(i % 3 === 1)),
        }
      : noSecondStretchings(),
    tetrahedra: tetrahedra.slice(),
    sources,
    coverageMargin,
  };
}

function joinedSources(first: SourceArrays, second: SourceArrays): SourceArrays {
  return {
    type: joined(Uint8Array, first.type, second.type),
    points: joined(Float64Array, first.points, second.points),
    size: joined(Float64Array, first.size, second.size),
    distance: joined(Float64Array, first.distance, second.distance),
    growth: joined(Float64Array, first.growth, second.growth),
  };
}

/** Returns both arrays as one. Long arrays cannot be spread into arguments: the stack would overflow. */
function joined<T extends Uint8Array | Float64Array>(
  type: new (length: number) => T,
  first: T,
  second: T,
): T {
  const both = new type(first.length + second.length);
  both.set(first);
  both.set(second, first.length);
  return both;
}

/**
 * Returns a project's grid as flat arrays, for another project or a given surface. O(size). Throws a `MesherError`
 * if the grid is invalid.
 */
export function backgroundArrays(background: ProjectBackground): BackgroundArrays {
  checkArgument("background", background, backgroundForm);
  const { nodes, secondStretchings, tetrahedra, coverageMargin } = projectGrid(background);
  return {
    points: nodes.position,
    sizes: nodes.size,
    stretchings: nodes.stretching,
    directions: nodes.direction,
    ...(secondStretchings.stretching.length > 0 && {
      secondStretchings: secondStretchings.stretching,
      secondDirections: secondStretchings.direction,
    }),
    tetrahedra,
    coverageMargin,
    sources: background.sources,
  };
}

/** Converts a grid of the engine. It has no stretching: none of the tools that make grids adds any. */
export function backgroundFrom({ nodes, tetrahedra, coverageMargin }: GridArrays): BackgroundArrays {
  return { points: nodes.position, sizes: nodes.size, tetrahedra, coverageMargin };
}

/**
 * Returns flat arrays as the grid of a project, to draw, edit and save it. Ids count from 1 in the order of the
 * arrays. Takes one object per node; keep large grids as arrays. O(size). Throws a `MesherError` if the arrays do
 * not match each other.
 */
export function projectBackground(arrays: BackgroundArrays): ProjectBackground {
  refuse(checkBackground(arrays));
  const { points, sizes, stretchings, directions, tetrahedra, coverageMargin = 0, sources } = arrays;
  const { secondStretchings, secondDirections } = arrays;
  const tripleAt = (values: Float64Array, i: number): [number, number, number] => [
    values[3 * i] ?? 0,
    values[3 * i + 1] ?? 0,
    values[3 * i + 2] ?? 0,
  ];
  const id = (corner: number) => (tetrahedra[corner] ?? NOWHERE) + 1;
  return {
    nodes: Array.from(sizes, (size, i) => {
      const stretching = stretchings?.[i] ?? 1;
      const shape =
        stretching === 1 ? {} : { stretching, ...(directions && { direction: tripleAt(directions, i) }) };
      const secondStretching = secondStretchings?.[i] ?? 1;
      const second =
        secondStretching === 1
          ? {}
          : { secondStretching, ...(secondDirections && { secondDirection: tripleAt(secondDirections, i) }) };
      return { id: i + 1, position: tripleAt(points, i), size, ...shape, ...second };
    }),
    tetrahedra: Array.from({ length: tetrahedra.length / 4 }, (_, t) => [
      id(4 * t),
      id(4 * t + 1),
      id(4 * t + 2),
      id(4 * t + 3),
    ]),
    ...(sources !== undefined && { sources }),
    ...(coverageMargin > 0 ? { coverageMargin } : {}),
  };
}

const triple = v.array(v.number());
const node = v.object({
  id: v.number(),
  position: triple,
  size: v.number(),
  direction: v.optional(triple),
  secondDirection: v.optional(triple),
});
const source = v.object({
  type: v.picklist(SOURCE_TYPES),
  positions: v.array(triple),
  size: v.number(),
});
const backgroundForm = v.object({
  nodes: v.array(node),
  tetrahedra: v.array(v.array(v.number())),
  sources: v.optional(v.array(source)),
});

function nodeArrays(nodes: readonly ProjectBackgroundNode[]): GridArrays["nodes"] {
  const arrays = {
    position: new Float64Array(3 * nodes.length),
    size: new Float64Array(nodes.length),
    stretching: new Float64Array(nodes.length),
    direction: new Float64Array(3 * nodes.length),
  };
  const plainDirection = [1, 0, 0] as const;
  let i = 0;
  for (const { position, size, stretching = 1, direction = plainDirection } of nodes) {
    arrays.size[i] = size;
    arrays.stretching[i] = stretching;
    for (const axis of [0, 1, 2] as const) {
      arrays.position[3 * i + axis] = position[axis];
      arrays.direction[3 * i + axis] = direction[axis];
    }
    i++;
  }
  return arrays;
}

/** Returns the second stretchings of all nodes; empty arrays if no node has one. */
function secondArrays(nodes: readonly ProjectBackgroundNode[]): GridArrays["secondStretchings"] {
  const arrays = noSecondStretchings();
  if (nodes.every(({ secondStretching = 1 }) => secondStretching === 1)) return arrays;
  const stretching = Float64Array.from(nodes, ({ secondStretching = 1 }) => secondStretching);
  const direction = new Float64Array(3 * nodes.length);
  nodes.forEach(({ secondDirection = [0, 1, 0] }, i) => direction.set(secondDirection, 3 * i));
  return { stretching, direction };
}

function sourceArrays(sources: readonly ProjectSource[]): SourceArrays {
  const points = new Float64Array(SOURCE_COORDINATES * sources.length);
  sources.forEach(({ positions }, s) => {
    // At most three: previews also show unfinished projects, which were not checked.
    points.set(positions.slice(0, 3).flat(), SOURCE_COORDINATES * s);
  });
  return {
    type: Uint8Array.from(sources, ({ type }) => SOURCE_TYPE_NUMBERS[type]),
    points,
    size: Float64Array.from(sources, ({ size }) => size),
    distance: Float64Array.from(sources, ({ distance = 0 }) => distance),
    growth: Float64Array.from(sources, ({ growth = SOURCE_GROWTH }) => growth),
  };
}

/** Converts sources of the engine; ids count from 1. */
export function projectSources({ type: types, points, ...values }: SourceArrays): ProjectSource[] {
  return Array.from(types, (number, s) => {
    const type = SOURCE_TYPES[number] ?? "point";
    const own = points.subarray(SOURCE_COORDINATES * s);
    const positions = Array.from(
      { length: SOURCE_TYPE_NUMBERS[type] + 1 },
      (_, k): [number, number, number] => [own[3 * k] ?? 0, own[3 * k + 1] ?? 0, own[3 * k + 2] ?? 0],
    );
    const [size = 0, distance = 0, growth = 0] = [values.size[s], values.distance[s], values.growth[s]];
    return { id: s + 1, type, positions, size, ...(distance > 0 ? { distance } : {}), growth };
  });
}
