/** Joins the surfaces of several files, such as the parts of an assembly, to one with a region per solid. */
import { type Steps, stepwise } from "../base/steps.js";
import { type Mesh, isNumberedSolid } from "../mesh/mesh.js";
import type { Shape, ShapeFace } from "./joined-shapes.js";
import { surfaceOfShapes } from "./shape-surface.js";

/** The surface of a file, and the name of its solid if the file has one without a name of its own. */
export interface AssemblyPart {
  readonly name: string;
  readonly surface: Mesh;
}

/**
 * Returns one surface with the solids of all parts as regions; faces that two solids share become interfaces. Solids keep
 * their names, made different by numbers, and their largest volumes of tetrahedra. The unit is that of the first part. Points
 * that mark regions and holes must have been located.
 */
export function* assemblyOf(parts: readonly AssemblyPart[]): Steps<Mesh> {
  const shapes: Shape[] = [];
  for (const part of parts) shapes.push(...(yield* shapesOf(part)));
  const mesh = yield* surfaceOfShapes(shapes);
  const unit = parts[0]?.surface.unit;
  const notes = [...parts.flatMap(({ surface }) => surface.notes ?? []), ...(mesh.notes ?? [])];
  return { ...mesh, ...(unit && { unit }), ...(notes.length > 0 && { notes }) };
}

function* shapesOf({ name, surface }: AssemblyPart): Steps<Shape[]> {
  const { surfaceRegions } = surface;
  if (surfaceRegions === undefined) return [yield* shapeOf(surface, name, () => 1)];
  const { regions, triangleRegions, maxVolumes } = surfaceRegions;
  const shapes: Shape[] = [];
  for (const [r, { name: own }] of regions.entries()) {
    const signOf = (t: number) =>
      Number(triangleRegions[2 * t] === r) - Number(triangleRegions[2 * t + 1] === r);
    const isUnnamed = own === "" || (regions.length === 1 && isNumberedSolid(own));
    const shape = yield* shapeOf(surface, isUnnamed ? name : own, signOf);
    const maxVolume = maxVolumes?.[r] ?? 0;
    if (shape.triangles.length > 0) shapes.push({ ...shape, maxVolume });
  }
  return shapes;
}

/** `signOf`: 1 for the triangles of the solid that face outward, -1 for those that face inward, 0 for others. */
function* shapeOf(
  { points, triangles, trianglePatch, patches }: Mesh,
  name: string,
  signOf: (triangle: number) => number,
): Steps<Shape> {
  const owned: number[][] = patches.map(() => []);
  yield* stepwise(trianglePatch.length, (t) => {
    if (signOf(t) !== 0) owned[trianglePatch[t] ?? 0]?.push(t);
  });
  const nodeOf = new Map<number, number>();
  const corners: number[] = [];
  const used: number[] = [];
  const faces: ShapeFace[] = [];
  for (const [p, own] of owned.entries()) {
    if (own.length === 0) continue;
    yield* stepwise(own.length, (i) => {
      const t = own[i] ?? 0;
      const [a = 0, b = 0, c = 0] = triangles.subarray(3 * t, 3 * t + 3);
      for (const node of signOf(t) > 0 ? [a, b, c] : [a, c, b]) {
        const known = nodeOf.get(node);
        if (known === undefined) {
          nodeOf.set(node, nodeOf.size);
          used.push(points[3 * node] ?? 0, points[3 * node + 1] ?? 0, points[3 * node + 2] ?? 0);
        }
        corners.push(known ?? nodeOf.size - 1);
      }
    });
    const { name: patch, color } = patches[p] ?? { name: "", color: undefined };
    faces.push({ name: patch, triangles: own.length, color });
  }
  return { name, points: Float64Array.from(used), triangles: Uint32Array.from(corners), faces };
}
