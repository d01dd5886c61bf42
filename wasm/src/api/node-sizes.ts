/** Sizes and metrics of a background grid among the values at the nodes of a mesh. */
import * as v from "valibot";
import { checkArgument } from "../calls/argument-checks.js";
import { doubles, map } from "../calls/schemas.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { refuse } from "../diagnostics/mesher-error.js";
import { invalidArrays } from "../diagnostics/package-diagnostic.js";
import { type FrontSizes, MAX_DIRECTION_COSINE } from "../generated/constants.js";
import type { Mesh, NodeData, VolumeInput } from "../mesh/mesh.js";
import type { BackgroundArrays } from "../project/background-arrays.js";

type WithData = Pick<Mesh, "nodeData">;

/** Sizes at the nodes of a mesh, as a file stores them; stretchings and directions of those nodes that have a tetrahedron. */
export type NodeSizes = Partial<
  Pick<BackgroundArrays, "sizes" | "stretchings" | "directions" | "secondStretchings" | "secondDirections">
>;

/** Stretchings and their directions at all nodes. */
interface Stretched {
  readonly stretchings: Float64Array;
  readonly directions: Float64Array;
}

/** Values of a mesh at all its nodes, by the names that a background grid uses. */
interface SizeValues {
  readonly sizes?: Float64Array | undefined;
  readonly first?: Stretched | undefined;
  /** With `first` only. */
  readonly second?: Stretched | undefined;
}

const REMEDY =
  "Store one size per node, and one stretching and a direction of three components, or neither; for a second stretching, also one and a direction orthogonal to the first.";

/** Returns the node values `size`, and stretchings with directions. Rejects values with a wrong number per node. */
function sizeValues(mesh: VolumeInput): SizeValues {
  const sizes = valuesOf(mesh, "size");
  if (sizes !== undefined && sizes.length !== mesh.points.length / 3) {
    refuse([invalidArrays("`size` must have one value per node", REMEDY)]);
  }
  const first = stretchedValues(mesh, "stretching", "direction");
  const second = stretchedValues(mesh, "secondStretching", "secondDirection");
  if (second === undefined) return { sizes, first };
  if (first === undefined) refuse([invalidArrays("`secondStretching` needs `stretching`", REMEDY)]);
  else refuse(obliqueDirections(first, second));
  return { sizes, first, second };
}

function stretchedValues(mesh: VolumeInput, name: string, nameOfDirection: string): Stretched | undefined {
  const count = mesh.points.length / 3;
  const stretchings = valuesOf(mesh, name);
  if (stretchings === undefined) return undefined;
  const directions = valuesOf(mesh, nameOfDirection);
  if (stretchings.length !== count) {
    refuse([invalidArrays(`\`${name}\` must have one value per node`, REMEDY)]);
  }
  if (directions?.length === 3 * count) return { stretchings, directions };
  refuse([invalidArrays(`\`${name}\` needs \`${nameOfDirection}\` with three values per node`, REMEDY)]);
  return undefined;
}

/** Returns an error about the first node whose two directions are not orthogonal. */
function obliqueDirections(first: Stretched, second: Stretched): Diagnostic[] {
  for (let node = 0; node < first.stretchings.length; node++) {
    if (!((first.stretchings[node] ?? 1) > 1 && (second.stretchings[node] ?? 1) > 1)) continue;
    const [x = 0, y = 0, z = 0] = first.directions.subarray(3 * node, 3 * node + 3);
    const [u = 0, v = 0, w = 0] = second.directions.subarray(3 * node, 3 * node + 3);
    const most = MAX_DIRECTION_COSINE * Math.hypot(x, y, z) * Math.hypot(u, v, w);
    if (Math.abs(x * u + y * v + z * w) <= most) continue;
    const message = `\`direction\` and \`secondDirection\` of node ${node} (counted from 0) are not orthogonal`;
    return [invalidArrays(message, REMEDY)];
  }
  return [];
}

/** Returns the node values of this name, whose case may differ if no other name then matches. */
function valuesOf({ nodeData = new Map() }: VolumeInput, name: string): Float64Array | undefined {
  const values = nodeData.get(keyOf({ nodeData }, name) ?? name)?.values;
  checkArgument(`mesh.nodeData "${name}"`, values, v.optional(doubles()));
  return values;
}

/**
 * Returns the node values `size` of a mesh and, if it has both, `stretching` and `direction`, and `secondStretching` and
 * `secondDirection`. A name may differ in case if no other name then matches. Rejects values with a wrong number per node.
 */
export function sizesAtNodes(mesh: VolumeInput): NodeSizes {
  const { sizes, first, second } = sizeValues(mesh);
  if (first === undefined) return { ...(sizes && { sizes }) };
  const isUsed = new Uint8Array(mesh.points.length / 3);
  for (const node of mesh.tetrahedra) isUsed[node] = 1;
  const used = ({ stretchings, directions }: Stretched): Stretched => ({
    stretchings: stretchings.filter((_, node) => isUsed[node] === 1),
    directions: directions.filter((_, i) => isUsed[Math.floor(i / 3)] === 1),
  });
  const others = second && used(second);
  return {
    ...(sizes && { sizes }),
    ...used(first),
    ...(others && { secondStretchings: others.stretchings, secondDirections: others.directions }),
  };
}

/** Returns sizes of the front as the node values that `sizesAtNodes` reads. */
export function frontSizeData(front: FrontSizes): Map<string, NodeData> {
  const { sizes, stretchings, directions, secondStretchings, secondDirections } = front;
  const data = new Map<string, NodeData>([
    ["size", { components: 1, values: sizes }],
    ["stretching", { components: 1, values: stretchings }],
    ["direction", { components: 3, values: directions }],
  ]);
  if (secondStretchings.length > 0) {
    data.set("secondStretching", { components: 1, values: secondStretchings });
    data.set("secondDirection", { components: 3, values: secondDirections });
  }
  return data;
}

/** Returns the node values `metric` of a mesh that has no `size`; undefined if there are none. Rejects a wrong number per node. */
export function metricsAtNodes(mesh: VolumeInput): Float64Array | undefined {
  return valuesOf(mesh, "size") === undefined ? metricValues(mesh) : undefined;
}

/**
 * Returns the metric at each node, xx xy xz yy yz zz: the node values `metric`, else that of `size`, `stretching` and
 * `direction`. Rejects a mesh without either, and values with a wrong number per node.
 */
export function backgroundMetrics(mesh: VolumeInput): Float64Array {
  checkArgument("background", mesh, v.object({ nodeData: v.optional(map) }));
  const metrics = metricValues(mesh);
  if (metrics !== undefined) return metrics.slice();
  const values = sizeValues(mesh);
  if (values.sizes === undefined) {
    const remedy = "Use a mesh with node values `metric`, or `size` with `stretching` and `direction`.";
    refuse([invalidArrays("the background has no metric and no sizes at its nodes", remedy)]);
  }
  return stretchedMetrics(values);
}

function metricValues(mesh: VolumeInput): Float64Array | undefined {
  const values = valuesOf(mesh, "metric");
  if (values !== undefined && values.length !== 2 * mesh.points.length) {
    const remedy = "Store xx, xy, xz, yy, yz and zz of the metric at each node.";
    refuse([invalidArrays("`metric` must have six values per node", remedy)]);
  }
  return values;
}

/** Powers by `**` may differ between browsers in their last bit. */
const inverseSquare = (x: number) => 1 / (x * x);

function stretchedMetrics({ sizes = new Float64Array(), first, second }: SizeValues): Float64Array {
  const metrics = new Float64Array(SIX * sizes.length);
  for (let node = 0; node < sizes.length; node++) {
    const across = inverseSquare(sizes[node] ?? 0);
    const metric = metrics.subarray(SIX * node, SIX * node + SIX);
    metric.set([across, 0, 0, across, 0, across]);
    const along = directionAt(first, node);
    const other = directionAt(second, node);
    addStretching(metric, along, across * (inverseSquare(stretchingAt(first, node)) - 1));
    // Rounded directions are not quite orthogonal.
    const square = dot(along, along);
    const share = square > 0 && stretchingAt(first, node) > 1 ? dot(along, other) / square : 0;
    const [x, y, z] = [other[0] - share * along[0], other[1] - share * along[1], other[2] - share * along[2]];
    addStretching(metric, [x, y, z], across * (inverseSquare(stretchingAt(second, node)) - 1));
  }
  return metrics;
}

type Triple = readonly [number, number, number];

const dot = (a: Triple, b: Triple): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

const stretchingAt = (stretched: Stretched | undefined, node: number): number =>
  stretched?.stretchings[node] ?? 1;

function directionAt(stretched: Stretched | undefined, node: number): Triple {
  const [x = 0, y = 0, z = 0] = stretched?.directions.subarray(3 * node, 3 * node + 3) ?? [];
  return [x, y, z];
}

/** Adds `extra` times the projection to a direction to a metric, if the direction is not zero. */
function addStretching(metric: Float64Array, direction: Triple, extra: number): void {
  const square = dot(direction, direction);
  if (!(square > 0)) return;
  let entry = 0;
  for (let row = 0; row < 3; row++) {
    for (let column = row; column < 3; column++) {
      metric[entry] =
        (metric[entry] ?? 0) + (extra * (direction[row] ?? 0) * (direction[column] ?? 0)) / square;
      entry++;
    }
  }
}

/** Numbers of a metric. */
const SIX = 6;

/** Returns an error about the first node whose metric is not positive definite. */
export function wrongMetrics(metrics: Float64Array): Diagnostic[] {
  for (let node = 0; SIX * node < metrics.length; node++) {
    const [xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0] = metrics.subarray(SIX * node, SIX * node + SIX);
    const second = xx * yy - xy * xy;
    const determinant = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);
    // Comparisons with NaN are false.
    if (xx > 0 && second > 0 && determinant > 0 && Number.isFinite(determinant)) continue;
    return [notPositive(node)];
  }
  return [];
}

/** Says that the metric at a node is not one. */
export function notPositive(node: number): Diagnostic {
  const message = `the metric at node ${node} (counted from 0) is not positive definite, or its sizes differ by more than a factor of 1e6`;
  return invalidArrays(
    message,
    "Use a metric with three positive eigenvalues, the inverse squares of the sizes.",
  );
}

/**
 * Returns the name of the node values that equals `name`, or differs from it in case only and is the only such
 * name.
 */
function keyOf({ nodeData }: WithData, name: string): string | undefined {
  if (nodeData.has(name)) return name;
  const alike = [...nodeData.keys()].filter((key) => key.toLowerCase() === name.toLowerCase());
  return alike.length === 1 ? alike[0] : undefined;
}

/**
 * Returns the names of the node values that a background grid does not use, in file order. Throws a `MesherError`
 * if `mesh` is invalid.
 */
export function unusedData(mesh: WithData): string[] {
  checkArgument("mesh", mesh, v.object({ nodeData: map }));
  const stretching = keyOf(mesh, "stretching");
  const second = stretching && keyOf(mesh, "secondStretching");
  const used = [keyOf(mesh, "size"), stretching, stretching && keyOf(mesh, "direction")];
  used.push(second, second && keyOf(mesh, "secondDirection"));
  // A background grid of `sizeFromSolution` has the same sizes once more as a metric.
  used.push(keyOf(mesh, "metric"));
  return [...mesh.nodeData.keys()].filter((name) => !used.includes(name));
}
