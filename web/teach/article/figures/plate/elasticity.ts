/**
 * Plane stress on linear triangles. Nothing is held: the loads on the outer edges are in balance, and motions of the whole body,
 * which have no stress, are taken out of them.
 */
import type { Stress } from "./exact-plate";

export interface TriangleMesh {
  /** x y per node. */
  readonly points: Float64Array;
  /** Three nodes per triangle, counter-clockwise. */
  readonly triangles: Uint32Array;
}

export interface Solution {
  /** x y per node. */
  readonly displacements: Float64Array;
  /** Stresses xx, yy and xy, per triangle. */
  readonly stresses: Float64Array;
  /** Steps of the iteration. */
  readonly rounds: number;
}

/** Stiffness 1, and Poisson's ratio of steel. The stresses do not depend on them. */
const poisson = 0.3;
const [stiff, cross, shear] = [
  1 / (1 - poisson * poisson),
  poisson / (1 - poisson * poisson),
  1 / (2 * (1 + poisson)),
] as const;
/** Largest residual, relative to the load. */
const tolerance = 1e-8;
/** Points of Gauss on an edge from 0 to 1, with their weights: exact up to cubes. */
const gauss = [
  [0.5 - Math.sqrt(1 / 12), 0.5],
  [0.5 + Math.sqrt(1 / 12), 0.5],
] as const;

/** Slopes of the three shape functions, and the area, of a triangle. */
function slopesOf(mesh: TriangleMesh, triangle: number): readonly [readonly number[], number] {
  const [a = 0, b = 0, c = 0] = mesh.triangles.subarray(3 * triangle, 3 * triangle + 3);
  const p = mesh.points;
  const [ax = 0, ay = 0, bx = 0, by = 0, cx = 0, cy = 0] = [a, b, c].flatMap((node) => [
    p[2 * node] ?? 0,
    p[2 * node + 1] ?? 0,
  ]);
  const doubled = (bx - ax) * (cy - ay) - (cx - ax) * (by - ay);
  const slopes = [by - cy, cx - bx, cy - ay, ax - cx, ay - by, bx - ax].map((x) => x / doubled);
  return [slopes, doubled / 2];
}

/** Solves for the displacements under loads on the edges of the mesh. `stressAt` is the stress outside of an edge; null: no load. */
export function solveElasticity(
  mesh: TriangleMesh,
  stressAt: (x: number, y: number, from: number, to: number) => Stress | null,
): Solution {
  const loads = loadsOf(mesh, stressAt);
  withoutRigidMotion(mesh, loads);
  const { displacements, rounds } = conjugateGradients(stiffnessOf(mesh), loads);
  const count = mesh.triangles.length / 3;
  const stresses = new Float64Array(3 * count);
  for (let t = 0; t < count; t++) {
    const [slopes] = slopesOf(mesh, t);
    let [xx, yy, xy] = [0, 0, 0];
    for (let i = 0; i < 3; i++) {
      const node = mesh.triangles[3 * t + i] ?? 0;
      const [u, v] = [displacements[2 * node] ?? 0, displacements[2 * node + 1] ?? 0];
      const [dx, dy] = [slopes[2 * i] ?? 0, slopes[2 * i + 1] ?? 0];
      xx += dx * u;
      yy += dy * v;
      xy += dy * u + dx * v;
    }
    stresses.set([stiff * xx + cross * yy, cross * xx + stiff * yy, shear * xy], 3 * t);
  }
  return { displacements, stresses, rounds };
}

function loadsOf(
  { points, triangles }: TriangleMesh,
  stressAt: (x: number, y: number, from: number, to: number) => Stress | null,
): Float64Array {
  const loads = new Float64Array(points.length);
  for (const [from, to] of boundaryOf(triangles)) {
    const [ax = 0, ay = 0, bx = 0, by = 0] = [
      points[2 * from],
      points[2 * from + 1],
      points[2 * to],
      points[2 * to + 1],
    ];
    // The outer normal of a boundary that is counter-clockwise, times the length.
    const [nx, ny] = [by - ay, ax - bx];
    for (const [t, weight] of gauss) {
      const stress = stressAt(ax + (bx - ax) * t, ay + (by - ay) * t, from, to);
      if (!stress) continue;
      const [fx, fy] = [stress[0] * nx + stress[2] * ny, stress[2] * nx + stress[1] * ny];
      for (const [node, share] of [
        [from, 1 - t],
        [to, t],
      ] as const) {
        loads[2 * node] = (loads[2 * node] ?? 0) + weight * share * fx;
        loads[2 * node + 1] = (loads[2 * node + 1] ?? 0) + weight * share * fy;
      }
    }
  }
  return loads;
}

/** Returns the edges with a triangle on one side only, counter-clockwise around the body. */
export function boundaryOf(triangles: Uint32Array): readonly (readonly [number, number])[] {
  const open = new Map<string, readonly [number, number]>();
  for (let i = 0; i < triangles.length; i++) {
    const [from = 0, to = 0] = [triangles[i], triangles[i % 3 === 2 ? i - 2 : i + 1]];
    if (!open.delete(`${to} ${from}`)) open.set(`${from} ${to}`, [from, to]);
  }
  return [...open.values()];
}

/** Takes the parts that move or turn the whole body out of loads. */
function withoutRigidMotion({ points }: TriangleMesh, loads: Float64Array): void {
  const count = points.length / 2;
  let [mx, my] = [0, 0];
  for (let i = 0; i < points.length; i += 2) {
    mx += (points[i] ?? 0) / count;
    my += (points[i + 1] ?? 0) / count;
  }
  const motions = [
    (_x: number, _y: number) => [1, 0],
    (_x: number, _y: number) => [0, 1],
    (x: number, y: number) => [my - y, x - mx],
  ];
  for (const motion of motions) {
    const mode = new Float64Array(loads.length);
    for (let i = 0; i < points.length; i += 2) mode.set(motion(points[i] ?? 0, points[i + 1] ?? 0), i);
    const share = product(mode, loads) / product(mode, mode);
    addTo(loads, mode, -share);
  }
}

/** A symmetric matrix of 2 by 2 blocks, by rows of blocks. */
interface Stiffness {
  readonly starts: Uint32Array;
  readonly columns: Uint32Array;
  /** Four numbers per block, row by row. */
  readonly blocks: Float64Array;
}

function stiffnessOf(mesh: TriangleMesh): Stiffness {
  const { points, triangles } = mesh;
  const neighbours = Array.from({ length: points.length / 2 }, (_none, node) => new Set([node]));
  for (let t = 0; t < triangles.length; t += 3)
    for (const a of triangles.subarray(t, t + 3))
      for (const b of triangles.subarray(t, t + 3)) neighbours[a]?.add(b);
  const starts = new Uint32Array(neighbours.length + 1);
  neighbours.forEach(({ size }, node) => (starts[node + 1] = (starts[node] ?? 0) + size));
  const columns = Uint32Array.from(neighbours.flatMap((each) => [...each].sort((a, b) => a - b)));
  const blocks = new Float64Array(4 * columns.length);
  for (let t = 0; t < triangles.length / 3; t++) {
    const [slopes, area] = slopesOf(mesh, t);
    for (let i = 0; i < 3; i++)
      for (let j = 0; j < 3; j++) {
        const [row = 0, column = 0] = [triangles[3 * t + i], triangles[3 * t + j]];
        let at = starts[row] ?? 0;
        while (columns[at] !== column) at++;
        const [ax = 0, ay = 0, bx = 0, by = 0] = [
          slopes[2 * i],
          slopes[2 * i + 1],
          slopes[2 * j],
          slopes[2 * j + 1],
        ];
        const block = [
          stiff * ax * bx + shear * ay * by,
          cross * ax * by + shear * ay * bx,
          cross * ay * bx + shear * ax * by,
          stiff * ay * by + shear * ax * bx,
        ];
        block.forEach((value, k) => (blocks[4 * at + k] = (blocks[4 * at + k] ?? 0) + area * value));
      }
  }
  return { starts, columns, blocks };
}

function product(a: Float64Array, b: Float64Array): number {
  let sum = 0;
  for (let i = 0; i < a.length; i++) sum += (a[i] ?? 0) * (b[i] ?? 0);
  return sum;
}

function addTo(to: Float64Array, what: Float64Array, by: number): void {
  for (let i = 0; i < to.length; i++) to[i] = (to[i] ?? 0) + by * (what[i] ?? 0);
}

function multiply({ starts, columns, blocks }: Stiffness, x: Float64Array, into: Float64Array): void {
  for (let row = 0; row + 1 < starts.length; row++) {
    let [u, v] = [0, 0];
    for (let at = starts[row] ?? 0; at < (starts[row + 1] ?? 0); at++) {
      const column = 2 * (columns[at] ?? 0);
      const [p, q] = [x[column] ?? 0, x[column + 1] ?? 0];
      u += (blocks[4 * at] ?? 0) * p + (blocks[4 * at + 1] ?? 0) * q;
      v += (blocks[4 * at + 2] ?? 0) * p + (blocks[4 * at + 3] ?? 0) * q;
    }
    into[2 * row] = u;
    into[2 * row + 1] = v;
  }
}

/** Solves by conjugate gradients, scaled by the diagonal. */
function conjugateGradients(
  matrix: Stiffness,
  loads: Float64Array,
): Pick<Solution, "displacements" | "rounds"> {
  const diagonal = new Float64Array(loads.length);
  for (let row = 0; row + 1 < matrix.starts.length; row++) {
    let at = matrix.starts[row] ?? 0;
    while (matrix.columns[at] !== row) at++;
    diagonal.set([matrix.blocks[4 * at] ?? 1, matrix.blocks[4 * at + 3] ?? 1], 2 * row);
  }
  const displacements = new Float64Array(loads.length);
  const residual = loads.slice();
  const scaled = residual.map((x, i) => x / (diagonal[i] ?? 1));
  const direction = scaled.slice();
  const image = new Float64Array(loads.length);
  const goal = tolerance * tolerance * product(loads, loads);
  let slope = product(residual, scaled);
  let rounds = 0;
  for (; rounds < 10 * loads.length && product(residual, residual) > goal; rounds++) {
    multiply(matrix, direction, image);
    const step = slope / product(direction, image);
    addTo(displacements, direction, step);
    addTo(residual, image, -step);
    for (let i = 0; i < scaled.length; i++) scaled[i] = (residual[i] ?? 0) / (diagonal[i] ?? 1);
    const next = product(residual, scaled);
    const factor = next / slope;
    slope = next;
    for (let i = 0; i < direction.length; i++) direction[i] = (scaled[i] ?? 0) + factor * (direction[i] ?? 0);
  }
  return { displacements, rounds };
}
