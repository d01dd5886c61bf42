import type { BackgroundArrays } from "tetrafront";
import type { Project, ProjectBackground, ProjectBackgroundNode } from "tetrafront/project";
import { forEachInSlices, nextTurn } from "./slices";

type Nodes = Project["background"]["nodes"];
type Tetrahedra = Project["background"]["tetrahedra"];

/**
 * A background grid as flat arrays. Everything that visits a whole grid uses them. They are made once per list, and
 * a browser transfers, stores and visits them about a hundred times as fast as objects.
 */
export interface PackedGrid {
  /** Per node: id, x y z, size, stretching, direction x y z; NaN for a missing value. */
  readonly nodes: Float64Array;
  /** Four node ids per tetrahedron. */
  readonly tetrahedra: Float64Array;
  /** Per node: second stretching, second direction x y z; NaN for a missing value. Absent if no node has any. */
  readonly seconds?: Float64Array | undefined;
}

export const numbersPerNode = 9;
export const numbersPerSecond = 4;

const nodesOf = new WeakMap<Nodes, Float64Array>();
const secondsOf = new WeakMap<Nodes, { readonly seconds: Float64Array | undefined }>();
const tetrahedraOf = new WeakMap<Tetrahedra, Float64Array>();
const arraysOf = new WeakMap<
  Float64Array,
  {
    readonly nodes: Float64Array;
    readonly seconds: Float64Array | undefined;
    readonly arrays: BackgroundArrays;
  }
>();

/** Returns the same array every time for the same list. */
export function packedNodes(nodes: Nodes): Float64Array {
  return remembered(nodesOf, nodes, packNodes);
}

/** Returns the second stretchings and directions of nodes; undefined if no node has any. The same array every time for the same list. */
export function packedSeconds(nodes: Nodes): Float64Array | undefined {
  return remembered(secondsOf, nodes, (list) => ({ seconds: packSeconds(list) })).seconds;
}

/** Returns the same array every time for the same list. */
export function packedTetrahedra(tetrahedra: Tetrahedra): Float64Array {
  return remembered(tetrahedraOf, tetrahedra, packTetrahedra);
}

export function packedGrid({ nodes, tetrahedra }: ProjectBackground): PackedGrid {
  const seconds = packedSeconds(nodes);
  return {
    nodes: packedNodes(nodes),
    tetrahedra: packedTetrahedra(tetrahedra),
    ...(seconds && { seconds }),
  };
}

function remembered<In extends object, Out>(
  known: WeakMap<In, Out>,
  input: In,
  compute: (input: In) => Out,
): Out {
  let output = known.get(input);
  if (output === undefined) {
    output = compute(input);
    known.set(input, output);
  }
  return output;
}

function packNodes(nodes: Nodes): Float64Array {
  const packed = new Float64Array(numbersPerNode * nodes.length).fill(NaN);
  nodes.forEach(({ id, position: at, size, stretching, direction }, i) => {
    const first = numbersPerNode * i;
    packed[first] = id;
    packed.set(at, first + 1);
    packed[first + 4] = size;
    if (stretching !== undefined) packed[first + 5] = stretching;
    if (direction !== undefined) packed.set(direction, first + 6);
  });
  return packed;
}

function packSeconds(nodes: Nodes): Float64Array | undefined {
  if (
    nodes.every(({ secondStretching, secondDirection }) => secondStretching === undefined && !secondDirection)
  ) {
    return undefined;
  }
  const packed = new Float64Array(numbersPerSecond * nodes.length).fill(NaN);
  nodes.forEach(({ secondStretching, secondDirection }, i) => {
    const first = numbersPerSecond * i;
    if (secondStretching !== undefined) packed[first] = secondStretching;
    if (secondDirection !== undefined) packed.set(secondDirection, first + 1);
  });
  return packed;
}

function packTetrahedra(tetrahedra: Tetrahedra): Float64Array {
  const packed = new Float64Array(4 * tetrahedra.length);
  let out = 0;
  for (const corners of tetrahedra) for (const id of corners) packed[out++] = id;
  return packed;
}

/** Returns which optional values the node at an offset has. */
export function partsOf(
  nodes: Float64Array,
  first: number,
): { readonly stretching: boolean; readonly direction: boolean } {
  return { stretching: !Number.isNaN(nodes[first + 5]), direction: !Number.isNaN(nodes[first + 6]) };
}

/** Returns the second stretching and direction of node i, as far as it has them. */
function secondAt(
  seconds: Float64Array | undefined,
  i: number,
): Pick<ProjectBackgroundNode, "secondStretching" | "secondDirection"> {
  const [stretching = NaN, x = NaN, y = NaN, z = NaN] =
    seconds?.subarray(numbersPerSecond * i, numbersPerSecond * (i + 1)) ?? [];
  return {
    ...(Number.isNaN(stretching) ? {} : { secondStretching: stretching }),
    ...(Number.isNaN(x) ? {} : { secondDirection: [x, y, z] as const }),
  };
}

function nodeAt({ nodes: packed, seconds }: PackedGrid, i: number): ProjectBackgroundNode {
  const first = numbersPerNode * i;
  const number = (k: number): number => packed[first + k] ?? 0;
  const { stretching, direction } = partsOf(packed, first);
  return {
    id: number(0),
    position: [number(1), number(2), number(3)],
    size: number(4),
    ...(stretching ? { stretching: number(5) } : {}),
    ...(direction ? { direction: [number(6), number(7), number(8)] as const } : {}),
    ...secondAt(seconds, i),
  };
}

/**
 * Converts nodes and tetrahedra to the form of a project, with one object each, and keeps their arrays for
 * the engine. Yields to the page in between.
 */
export async function unpackGrid(grid: PackedGrid): Promise<{ nodes: Nodes; tetrahedra: Tetrahedra }> {
  const nodes: ProjectBackgroundNode[] = [];
  const tetrahedra: Tetrahedra[number][] = [];
  await forEachInSlices(grid.nodes.length / numbersPerNode, (i) => nodes.push(nodeAt(grid, i)));
  await forEachInSlices(grid.tetrahedra.length / 4, (t) => {
    const id = (corner: number): number => grid.tetrahedra[4 * t + corner] ?? 0;
    tetrahedra.push([id(0), id(1), id(2), id(3)]);
  });
  nodesOf.set(nodes, grid.nodes);
  secondsOf.set(nodes, { seconds: grid.seconds });
  tetrahedraOf.set(tetrahedra, grid.tetrahedra);
  const positionOf = positionFinder(grid.nodes);
  const positions = new Uint32Array(grid.tetrahedra.length);
  await forEachInSlices(positions.length, (i) => (positions[i] = positionOf(grid.tetrahedra[i] ?? 0)));
  await nextTurn();
  const arrays = { ...nodeArrays(grid.nodes), ...secondArrays(grid.seconds), tetrahedra: positions };
  arraysOf.set(grid.tetrahedra, { nodes: grid.nodes, seconds: grid.seconds, arrays });
  return { nodes, tetrahedra };
}

/** Returns a grid that the engine has made, with ids from 1. */
export function packArrays(arrays: BackgroundArrays): PackedGrid {
  const { points, sizes, stretchings, directions, tetrahedra } = arrays;
  const seconds = secondsFrom(arrays);
  const nodes = new Float64Array(numbersPerNode * sizes.length).fill(NaN);
  for (let i = 0; i < sizes.length; ++i) {
    const first = numbersPerNode * i;
    nodes[first] = i + 1;
    nodes.set(points.subarray(3 * i, 3 * i + 3), first + 1);
    nodes[first + 4] = sizes[i] ?? 0;
    const stretching = stretchings?.[i] ?? 1;
    if (stretching === 1) continue;
    nodes[first + 5] = stretching;
    if (directions) nodes.set(directions.subarray(3 * i, 3 * i + 3), first + 6);
  }
  return {
    nodes,
    tetrahedra: Float64Array.from(tetrahedra, (node) => node + 1),
    ...(seconds && { seconds }),
  };
}

function secondsFrom({
  sizes,
  secondStretchings,
  secondDirections,
}: BackgroundArrays): Float64Array | undefined {
  if (secondStretchings === undefined || secondStretchings.every((stretching) => stretching === 1)) {
    return undefined;
  }
  const seconds = new Float64Array(numbersPerSecond * sizes.length).fill(NaN);
  secondStretchings.forEach((stretching, i) => {
    if (stretching === 1) return;
    seconds[numbersPerSecond * i] = stretching;
    if (secondDirections) {
      seconds.set(secondDirections.subarray(3 * i, 3 * i + 3), numbersPerSecond * i + 1);
    }
  });
  return seconds;
}

/** Returns the grid in the engine's form, without its sources. */
export function engineGrid(background: ProjectBackground): BackgroundArrays {
  const { nodes, tetrahedra, seconds } = packedGrid(background);
  const known = arraysOf.get(tetrahedra);
  if (known?.nodes === nodes && known.seconds === seconds)
    return { ...known.arrays, coverageMargin: background.coverageMargin };
  // If only sizes or positions have changed, the node indices of the tetrahedra are still valid.
  const positions =
    known && sameIds(known.nodes, nodes) ? known.arrays.tetrahedra : nodePositions(nodes, tetrahedra);
  const arrays = { ...nodeArrays(nodes), ...secondArrays(seconds), tetrahedra: positions };
  arraysOf.set(tetrahedra, { nodes, seconds, arrays });
  return { ...arrays, coverageMargin: background.coverageMargin };
}

function sameIds(nodes: Float64Array, others: Float64Array): boolean {
  if (nodes.length !== others.length) return false;
  for (let i = 0; i < nodes.length; i += numbersPerNode) if (nodes[i] !== others[i]) return false;
  return true;
}

function nodeArrays(nodes: Float64Array): Omit<BackgroundArrays, "tetrahedra"> {
  const count = nodes.length / numbersPerNode;
  const points = new Float64Array(3 * count);
  const sizes = new Float64Array(count);
  const stretchings = new Float64Array(count).fill(1);
  const directions = new Float64Array(3 * count);
  for (let i = 0; i < count; ++i) {
    const first = numbersPerNode * i;
    for (let k = 0; k < 3; ++k) points[3 * i + k] = nodes[first + 1 + k] ?? 0;
    sizes[i] = nodes[first + 4] ?? 0;
    const { stretching, direction } = partsOf(nodes, first);
    if (stretching) stretchings[i] = nodes[first + 5] ?? 1;
    for (let k = 0; k < 3; ++k)
      directions[3 * i + k] = direction ? (nodes[first + 6 + k] ?? 0) : Number(k === 0);
  }
  return { points, sizes, stretchings, directions };
}

/** Returns the engine's form of second stretchings; nothing if all are 1. */
function secondArrays(
  seconds: Float64Array | undefined,
): Pick<BackgroundArrays, "secondStretchings" | "secondDirections"> {
  if (seconds === undefined) return {};
  const count = seconds.length / numbersPerSecond;
  const secondStretchings = new Float64Array(count);
  const secondDirections = new Float64Array(3 * count);
  for (let i = 0; i < count; ++i) {
    const { secondStretching = 1, secondDirection = [0, 1, 0] } = secondAt(seconds, i);
    secondStretchings[i] = secondStretching;
    secondDirections.set(secondDirection, 3 * i);
  }
  return secondStretchings.every((stretching) => stretching === 1)
    ? {}
    : { secondStretchings, secondDirections };
}

function nodePositions(nodes: Float64Array, tetrahedra: Float64Array): Uint32Array {
  const positionOf = positionFinder(nodes);
  const positions = new Uint32Array(tetrahedra.length);
  for (let i = 0; i < tetrahedra.length; ++i) positions[i] = positionOf(tetrahedra[i] ?? 0);
  return positions;
}

/** Returns a function that finds the index of a node by id. For an unknown id, the engine reports the index. */
function positionFinder(nodes: Float64Array): (id: number) => number {
  const nowhere = 0x7fffffff;
  const count = nodes.length / numbersPerNode;
  let isInOrder = true;
  for (let i = 0; isInOrder && i < count; ++i) isInOrder = nodes[numbersPerNode * i] === i + 1;
  if (isInOrder) return (id) => (id >= 1 && id <= count ? id - 1 : nowhere);
  const positions = new Map<number, number>();
  for (let i = 0; i < count; ++i) positions.set(nodes[numbersPerNode * i] ?? 0, i);
  return (id) => positions.get(id) ?? nowhere;
}
