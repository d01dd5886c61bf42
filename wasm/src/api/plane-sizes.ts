/** The target sizes of a polygon as a background grid of the engine: checked, triangulated, and made a layer of tetrahedra. */
import Delaunator from "delaunator";
import * as v from "valibot";
import { LIMITS, limitText } from "../base/limits.js";
import { objectWith } from "../calls/schemas.js";
import { type GridArrays, MAX_LENGTH, MIN_LENGTH, SOURCE_GROWTH } from "../generated/constants.js";
import { noSecondStretchings } from "../project/second-stretchings.js";
import type { PlaneNode, PlaneSizes, PlaneSource, UnfilledPlane } from "./plane-types.js";
import { anyNumber, firstOf, type PlaneLoops, positionSchema } from "./plane-loops.js";

const sourcesSchema = v.optional(
  v.array(
    objectWith({
      position: positionSchema,
      size: anyNumber,
      distance: v.optional(anyNumber),
      growth: v.optional(anyNumber),
    }),
  ),
);
const nodesSchema = v.array(
  objectWith({
    position: positionSchema,
    size: anyNumber,
    stretching: v.optional(anyNumber),
    direction: v.optional(positionSchema),
  }),
);
const uniformSchema = objectWith({ size: anyNumber, sources: sourcesSchema });
const graphedSchema = objectWith({ nodes: nodesSchema, sources: sourcesSchema });
export const sizesSchema = v.lazy((sizes) => {
  if (typeof sizes === "number") return anyNumber;
  return typeof sizes === "object" && sizes !== null && "nodes" in sizes ? graphedSchema : uniformSchema;
});

/** A uniform size, or 0 if the grid has nodes; and the grid. */
export interface PlaneField {
  readonly size: number;
  readonly grid: GridArrays;
}

/** Returns the field of sizes, or what is wrong with them. */
export function planeField(sizes: PlaneSizes, loops: PlaneLoops): PlaneField | UnfilledPlane {
  const given = typeof sizes === "number" ? { size: sizes } : sizes;
  const { sources = [] } = given;
  const problem =
    firstOf(sources, (source, index) => sourceProblem(source, `source ${index}`)) ??
    ("nodes" in given ? nodesProblem(given.nodes) : numberProblem("the size", given.size, sizeRange));
  if (problem !== undefined) {
    const remedy = "Pass a positive size, or one for each node, in the units of the polygon.";
    return { success: false, code: "invalid-size", message: problem, remedy, loops: [], segments: [] };
  }
  const nodes = "nodes" in given ? given.nodes : [];
  const layer = nodes.length === 0 ? noLayer : layerOf(nodes, loops);
  return {
    size: "size" in given ? given.size : 0,
    // The layer may end within the polygon: sizes outside are those of its nearest point.
    grid: {
      ...layer,
      secondStretchings: noSecondStretchings(),
      sources: sourceArrays(sources),
      coverageMargin: 1e6,
    },
  };
}

// ---- checks

interface Range {
  readonly min: number;
  readonly max: number;
}
const sizeRange: Range = { min: MIN_LENGTH, max: MAX_LENGTH };

function numberProblem(name: string, value: number, { min, max }: Range): string | undefined {
  return value >= min && value <= max
    ? undefined
    : `${name} is ${value}, but must be from ${limitText(min)} to ${limitText(max)}`;
}

const coordinateRange: Range = { min: -MAX_LENGTH, max: MAX_LENGTH };

function sourceProblem({ position: [x, y], size, distance = 0, growth = 0 }: PlaneSource, name: string) {
  return (
    numberProblem(`x of ${name}`, x, coordinateRange) ??
    numberProblem(`y of ${name}`, y, coordinateRange) ??
    numberProblem(`the size of ${name}`, size, sizeRange) ??
    numberProblem(`the distance of ${name}`, distance, { min: 0, max: MAX_LENGTH }) ??
    numberProblem(`the growth of ${name}`, growth, { min: 0, max: LIMITS.growth })
  );
}

const nodesProblem = (nodes: readonly PlaneNode[]): string | undefined =>
  nodes.length === 0
    ? "there is no size"
    : firstOf(nodes, (node, index) => nodeProblem(node, `node ${index}`));

function nodeProblem(
  { position: [x, y], size, stretching = 1, direction: [dx, dy] = plainDirection }: PlaneNode,
  name: string,
): string | undefined {
  const length = Math.hypot(dx, dy);
  return (
    numberProblem(`x of ${name}`, x, coordinateRange) ??
    numberProblem(`y of ${name}`, y, coordinateRange) ??
    numberProblem(`the size of ${name}`, size, sizeRange) ??
    numberProblem(`the stretching of ${name}`, stretching, { min: 1, max: LIMITS.stretching }) ??
    numberProblem(`the length of the direction of ${name}`, length, sizeRange)
  );
}

// ---- arrays

const plainDirection = [1, 0] as const;

type Layer = Pick<GridArrays, "nodes" | "tetrahedra">;

const noLayer: Layer = {
  nodes: {
    position: new Float64Array(),
    size: new Float64Array(),
    stretching: new Float64Array(),
    direction: new Float64Array(),
  },
  tetrahedra: new Uint32Array(),
};

/**
 * Returns a layer of tetrahedra around the plane, in which sizes depend on x and y alone: each triangle between nodes is the middle of
 * a prism of three tetrahedra. The corners of a box around all have the sizes of their nearest nodes.
 */
function layerOf(given: readonly PlaneNode[], { points }: PlaneLoops): Layer {
  const positions = given.map(({ position }) => position);
  const { corners, height } = surroundings(points, positions);
  const nodes = [...given, ...corners.map((position) => ({ ...nearestTo(given, position), position }))];
  const count = nodes.length;
  const delaunay = new Delaunator(Float64Array.from(nodes.flatMap(({ position }) => position)));
  const layer = {
    position: new Float64Array(6 * count),
    size: new Float64Array(2 * count),
    stretching: new Float64Array(2 * count),
    direction: new Float64Array(6 * count),
  };
  nodes.forEach(({ position: [x, y], size, stretching = 1, direction: [dx, dy] = plainDirection }, i) => {
    for (const [node, z] of [
      [i, -height],
      [i + count, height],
    ] as const) {
      layer.position.set([x, y, z], 3 * node);
      layer.size[node] = size;
      layer.stretching[node] = stretching;
      layer.direction.set([dx, dy, 0], 3 * node);
    }
  });
  const tetrahedra = new Uint32Array(4 * delaunay.triangles.length);
  for (let at = 0; at < delaunay.triangles.length; at += 3) {
    // With ascending nodes, neighbouring prisms have the same diagonals.
    const [a = 0, b = 0, c = 0] = [...delaunay.triangles.subarray(at, at + 3)].sort((i, j) => i - j);
    tetrahedra.set([a, b, c, c + count, a, b, b + count, c + count], 4 * at);
    tetrahedra.set([a, a + count, b + count, c + count], 4 * at + 8);
  }
  return { nodes: layer, tetrahedra };
}

type Position = PlaneNode["position"];

/** Corners of a box around loops and nodes that is larger by its own extent on every side, and this extent. */
function surroundings(points: Float64Array, positions: readonly Position[]) {
  let [left, right, low, high] = [Infinity, -Infinity, Infinity, -Infinity];
  const include = (x: number, y: number): void => {
    [left, right] = [Math.min(left, x), Math.max(right, x)];
    [low, high] = [Math.min(low, y), Math.max(high, y)];
  };
  for (const [x, y] of positions) include(x, y);
  for (let i = 0; i < points.length; i += 2) include(points[i] ?? 0, points[i + 1] ?? 0);
  const height = Math.max(right - left, high - low);
  const corners = [
    [left - height, low - height],
    [right + height, low - height],
    [right + height, high + height],
    [left - height, high + height],
  ] as const;
  return { corners, height };
}

function nearestTo(nodes: readonly PlaneNode[], [x, y]: Position): PlaneNode {
  const distanceOf = ({ position }: PlaneNode): number => Math.hypot(position[0] - x, position[1] - y);
  return nodes.reduce((nearest, node) => (distanceOf(node) < distanceOf(nearest) ? node : nearest));
}

function sourceArrays(sources: readonly PlaneSource[]): GridArrays["sources"] {
  const points = new Float64Array(9 * sources.length);
  sources.forEach(({ position }, s) => points.set(position, 9 * s));
  return {
    type: new Uint8Array(sources.length),
    points,
    size: Float64Array.from(sources, ({ size }) => size),
    distance: Float64Array.from(sources, ({ distance = 0 }) => distance),
    growth: Float64Array.from(sources, ({ growth = SOURCE_GROWTH }) => growth),
  };
}
