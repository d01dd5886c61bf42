/** What is wrong with what callers give, before the engine is asked; empty lists where nothing is. */
import { plural } from "../base/plural.js";
import { asObject, GONE, isUsable } from "../base/values.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { refuse } from "../diagnostics/mesher-error.js";
import {
  invalidArrays,
  invalidOption,
  packageDiagnostic,
  readDiagnostic,
} from "../diagnostics/package-diagnostic.js";
import type { MeshInput, SurfaceInput, VolumeMesh } from "../mesh/mesh.js";
import { type ModelArrays, projectArrays } from "../project/arrays.js";
import { checkedProject } from "../project/project.js";
import type { Project } from "../project/schema.js";
import type { RunControl } from "./control.js";

export function checkProject(project: unknown): Diagnostic[] {
  const parsed = checkedProject(project);
  if (parsed.success) return [];
  return parsed.errors.map((error) => readDiagnostic({ ...error, code: "invalid-project" }));
}

export function checkControl(control: RunControl): Diagnostic[] {
  const given: unknown = control;
  const { onProgress, onFront, signal } = asObject(control);
  const isWatched = [onProgress, onFront].every(
    (callback) => callback === undefined || typeof callback === "function",
  );
  const { addEventListener, removeEventListener } = asObject(signal as AbortSignal);
  const isSignal =
    signal === undefined ||
    (typeof addEventListener === "function" && typeof removeEventListener === "function");
  if (typeof given === "object" && given !== null && isWatched && isSignal) return [];
  const remedy =
    "Give an object with any of: a function onProgress, a function onFront, an AbortSignal signal.";
  return [invalidOption("control", "the control of the call is not what it should be", remedy)];
}

export function checkSurface(surface: SurfaceInput): Diagnostic[] {
  const { points, triangles, origin, nodeOrigin } = asObject(surface);
  if (!isUsable(Float64Array, points) || !isUsable(Uint32Array, triangles)) {
    return [
      surfaceProblem(`the surface's points and triangles are not a Float64Array and a Uint32Array${GONE}`),
    ];
  }
  if (points.length % 3 !== 0 || triangles.length % 3 !== 0) {
    return [surfaceProblem("the lengths of the surface's points and triangles are not multiples of 3")];
  }
  if (origin !== undefined && (!isUsable(Uint32Array, origin) || 3 * origin.length !== triangles.length)) {
    return [surfaceProblem("the surface's origin is no Uint32Array with a number for each triangle")];
  }
  if (
    nodeOrigin !== undefined &&
    (!isUsable(Uint32Array, nodeOrigin) || 3 * nodeOrigin.length !== points.length)
  ) {
    return [surfaceProblem("the surface's nodeOrigin is no Uint32Array with a number for each node")];
  }
  return [];
}

/** A distance of welding as large as the surface leaves nothing of it. */
export function checkWeld({ points }: SurfaceInput, weld: number | false | undefined): Diagnostic[] {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < points.length; i++) {
    const coordinate = points[i] ?? 0;
    if (coordinate < (low[i % 3] ?? 0)) low[i % 3] = coordinate;
    if (coordinate > (high[i % 3] ?? 0)) high[i % 3] = coordinate;
  }
  const extent = Math.max(...high.map((most, axis) => most - (low[axis] ?? 0)));
  // Without a place there is nothing to be across.
  if (!(extent >= 0 && Number(weld) > 0 && Number(weld) >= extent)) return [];
  const message = `the weld distance is ${weld}, and the whole surface is ${extent} across`;
  return [invalidOption("weld", message, "Give less than its shortest edges.")];
}

function surfaceProblem(message: string): Diagnostic {
  return invalidArrays(message, "Give x y z per node and three node positions per triangle.");
}

/** A mesh to become a background grid, with `sizes` if given. */
export function checkVolume(
  mesh: Pick<VolumeMesh, "points" | "tetrahedra">,
  sizes: Float64Array | undefined,
): Diagnostic[] {
  const { points, tetrahedra } = asObject(mesh);
  if (!isUsable(Float64Array, points) || !isUsable(Uint32Array, tetrahedra)) {
    return [
      volumeProblem(`the mesh's points and tetrahedra are not a Float64Array and a Uint32Array${GONE}`),
    ];
  }
  if (points.length % 3 !== 0 || tetrahedra.length % 4 !== 0) {
    return [volumeProblem("the mesh has half a point or half a tetrahedron")];
  }
  if (tetrahedra.length === 0) {
    return [invalidArrays("the mesh has no tetrahedron", "Mesh the model first; its front may be open.")];
  }
  const count = points.length / 3;
  const wild = tetrahedra.findIndex((node) => node >= count);
  if (wild >= 0) {
    return [
      volumeProblem(
        `tetrahedron ${Math.floor(wild / 4)} (counted from 0) refers to node ${tetrahedra[wild]} of ${count}`,
      ),
    ];
  }
  return checkNodeSizes(sizes, count);
}

/** As `checkVolume`, with a region per element or none. */
export function checkMesh(mesh: MeshInput): Diagnostic[] {
  const { regions, invertedTetrahedra } = asObject(mesh);
  for (const [name, given] of Object.entries({ regions, invertedTetrahedra })) {
    if (given === undefined || isUsable(Uint32Array, given)) continue;
    return [volumeProblem(`the mesh's ${name} are no Uint32Array${GONE}`)];
  }
  return checkVolume(mesh, undefined);
}

function checkNodeSizes(sizes: unknown, count: number): Diagnostic[] {
  if (sizes === undefined) return [];
  if (!isUsable(Float64Array, sizes) || sizes.length !== count) {
    return [
      invalidArrays(
        `the sizes are no Float64Array of ${plural(count, "number")}`,
        "Give one size per node of the mesh, or none at all.",
      ),
    ];
  }
  const wrong = sizes.findIndex((size) => !(size > 0 && size < Infinity));
  if (wrong < 0) return [];
  const message = `node ${wrong} (counted from 0) has the size ${sizes[wrong]}`;
  return [invalidArrays(message, "Give a finite size above 0 for every node.")];
}

function volumeProblem(message: string): Diagnostic {
  return invalidArrays(message, "Give x y z per node and four node positions per tetrahedron.");
}

/** Of a project without anything that a grid could cover. */
export function nothingToCover(): Diagnostic {
  const message = "there is nothing to cover: no point, line or patch can be evaluated";
  return packageDiagnostic("invalid-project", message, "Draw points and lines first.");
}

/** Of a mesh whose numbers the engine refuses. */
export function unreadableMesh(): Diagnostic {
  const message = "the mesh has coordinates that are not finite or beyond 1e30, or another number of regions";
  return invalidArrays(message, "Give finite coordinates, and one region per element or none.");
}

/** A preview shows drawings that are not finished: only what is no project at all is refused. */
export function drawnArrays(project: Project): ModelArrays {
  try {
    return projectArrays(project);
  } catch (failure) {
    refuse(checkProject(project));
    throw failure;
  }
}
