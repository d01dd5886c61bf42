/** One factor on all sizes of a run, by which it reaches a number of elements. */
import { LIMITS } from "../base/limits.js";
import { steady } from "../base/same-everywhere.js";
import { boxOf } from "../formats/solid-units.js";
import { MESH_DEFAULTS, REMESH_DEFAULTS, SOURCE_GROWTH } from "../generated/constants.js";
import { modelWithBodyBoxes } from "../project/arrays.js";
import type { BackgroundArrays } from "../project/background-arrays.js";
import type { Project, ProjectBody, ProjectSource } from "../project/project-types.js";
import type { MeshOptions, RemeshOptions } from "./option-types.js";

/** Sizes grow faster inside if there are to be fewer elements: with this power of the factor, up to a limit. */
const GROWTH_POWER = 0.5;
const MAX_REMESHED_GROWTH = 0.6;
/** The triangles of a kept surface stay; only the growth from them can make fewer elements. */
const KEPT_GROWTH_POWER = 2;

const times = (size: number | undefined, factor: number): number | undefined =>
  size === undefined ? undefined : Math.min(LIMITS.length, size * factor);

const scaledSource = ({ size, growth = SOURCE_GROWTH, ...source }: ProjectSource, factor: number) => ({
  ...source,
  size: size * factor,
  growth: Math.min(LIMITS.growth, growth * factor),
});

/** Returns a background whose sizes are multiplied by the factor everywhere. */
export function scaledBackground(
  background: BackgroundArrays | undefined,
  factor: number,
): BackgroundArrays | undefined {
  if (background === undefined) return undefined;
  const { sizes, sources } = background;
  return {
    ...background,
    sizes: sizes.map((size) => size * factor),
    ...(sources && { sources: sources.map((source) => scaledSource(source, factor)) }),
  };
}

/** A ball around the middle of a model in which sizes are limited. */
export interface SizeBall {
  readonly size: number;
  readonly centre: readonly [number, number, number];
  readonly radius: number;
}

/** A ball that covers a share of the model; the power is between those of a plate and of a block. */
const SHARE_POWER = 1 / 2.5;

/** Returns a ball around the middle of the given nodes. */
export function ballOf(points: Float64Array, size: number, share: number): SizeBall {
  const { centre, radius } = middleOf(points);
  return { size, centre, radius: radius * steady(share ** SHARE_POWER) };
}

/** Where the middle of the ball lies in the box: off all symmetries, so that edges and faces are refined one after the other. */
const BALL_PLACE = [0.13, 0.29, 0.41];

/** Returns the middle of the ball, and the radius with which it contains all points. */
function middleOf(points: Float64Array): Pick<SizeBall, "centre" | "radius"> {
  const { low, high } = boxOf(points);
  const lengths = low.map((x, k) => (high[k] ?? x) - x);
  const at = (k: number) => (low[k] ?? 0) + (BALL_PLACE[k] ?? 0) * (lengths[k] ?? 0);
  const reach = lengths.map((length, k) => length * (1 - (BALL_PLACE[k] ?? 0)));
  return { centre: [at(0), at(1), at(2)], radius: Math.hypot(...reach) };
}

/** Adds a source that limits the sizes in a ball to a background. */
export function withBall(
  background: BackgroundArrays | undefined,
  ball: SizeBall | undefined,
): BackgroundArrays | undefined {
  if (ball === undefined) return background;
  const none: BackgroundArrays = {
    points: new Float64Array(),
    sizes: new Float64Array(),
    tetrahedra: new Uint32Array(),
  };
  const { sources = [], ...grid } = background ?? none;
  return { ...grid, sources: [...sources, sourceOfBall(ball, sources)] };
}

function sourceOfBall({ size, centre, radius }: SizeBall, others: readonly ProjectSource[]): ProjectSource {
  const id = 1 + others.reduce((most, source) => Math.max(most, source.id), 0);
  return { id, type: "point", positions: [centre], size, distance: radius };
}

/** Returns a project whose given sizes are multiplied by the factor; automatic ones of its bodies are not given. */
export function scaledProject(project: Project, factor: number): Project {
  const { background, bodies } = project;
  return {
    ...project,
    background: {
      ...background,
      nodes: background.nodes.map((node) => ({ ...node, size: node.size * factor })),
      ...(background.sources && {
        sources: background.sources.map((source) => scaledSource(source, factor)),
      }),
    },
    ...(bodies && { bodies: bodies.map((body) => scaledBody(body, factor)) }),
  };
}

function scaledBody(body: ProjectBody, factor: number): ProjectBody {
  const { remeshing } = body;
  if (remeshing === undefined) return body;
  const { size, minSize, maxSize, ...others } = remeshing;
  return {
    ...body,
    remeshing: {
      ...others,
      ...(size !== undefined && { size: times(size, factor) }),
      ...(minSize !== undefined && { minSize: times(minSize, factor) }),
      ...(maxSize !== undefined && { maxSize: times(maxSize, factor) }),
    },
  };
}

/** Returns the options of a mesh with all sizes multiplied, and with a larger growth from a surface if the factor is above 1. */
export function scaledMeshOptions(options: MeshOptions, factor: number): MeshOptions {
  return {
    ...options,
    elements: undefined,
    size: times(options.size, factor),
    background: scaledBackground(options.background, factor),
    growth: scaledGrowth(options.growth, MESH_DEFAULTS.growth, factor),
  };
}

/** As `scaledMeshOptions`, for a remeshing, with its automatic sizes. */
export function scaledRemeshOptions(options: RemeshOptions, factor: number): RemeshOptions {
  const { sizeFactor = REMESH_DEFAULTS.sizeFactor } = options;
  return {
    ...options,
    sizeFactor: sizeFactor * factor,
    background: scaledBackground(options.background, factor),
    growth: scaledGrowth(options.growth, REMESH_DEFAULTS.growth, factor),
  };
}

function scaledGrowth(given: number | undefined, otherwise: number, factor: number): number {
  if (given !== undefined || factor <= 1) return given ?? otherwise;
  return Math.max(otherwise, Math.min(MAX_REMESHED_GROWTH, otherwise * steady(factor ** GROWTH_POWER)));
}

/**
 * Returns the options with which a surface is filled whose triangles are kept. `longest`: length of its longest edge, below
 * which a size has an effect.
 */
export function scaledKeptOptions(options: MeshOptions, factor: number, longest: number): MeshOptions {
  const { growth = MESH_DEFAULTS.growth, background } = options;
  const hasNodes = (background?.sizes.length ?? 0) > 0;
  return {
    ...options,
    elements: undefined,
    background: scaledBackground(background, factor),
    ...(factor < 1 && !hasNodes && { size: longest * factor }),
    growth: Math.min(LIMITS.growth, factor > 1 ? growth * steady(factor ** KEPT_GROWTH_POWER) : growth),
  };
}

/** Returns the length of the longest edge. */
export function longestEdge({
  points,
  triangles,
}: {
  readonly points: Float64Array;
  readonly triangles: Uint32Array;
}): number {
  let square = 0;
  for (let t = 0; t + 2 < triangles.length; t += 3) {
    for (let side = 0; side < 3; side++) {
      const from = 3 * (triangles[t + side] ?? 0);
      const to = 3 * (triangles[t + ((side + 1) % 3)] ?? 0);
      let length = 0;
      for (let k = 0; k < 3; k++) length += ((points[from + k] ?? 0) - (points[to + k] ?? 0)) ** 2;
      square = Math.max(square, length);
    }
  }
  return Math.sqrt(square);
}

/** Returns the largest size at a node of the background grid; undefined without one, as with automatic sizes. */
export function largestSize(project: Project, { background }: MeshOptions): number | undefined {
  const { nodes } = project.background;
  const sizes = background?.sizes ?? [];
  const used = sizes.length > 0 ? [...sizes] : nodes.map(({ size }) => size);
  return used.length === 0 ? undefined : used.reduce((most, size) => Math.max(most, size), 0);
}

/** Returns the positions of the points of a project, and of the corners of its bodies' boxes; not empty. */
export function pointsOf(project: Project): Float64Array {
  return modelWithBodyBoxes(project).points;
}
