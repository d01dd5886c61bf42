/** Checks surfaces, meshes, projects and controls before the engine gets them; empty lists if they are valid. */
import * as v from "valibot";
import { LIMITS, limitText } from "../base/limits.js";
import { plural } from "../base/plural.js";
import type { RunControl } from "../engine/control.js";
import { doubles, integers, map, problemIn, watch } from "../calls/schemas.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { refuse } from "../diagnostics/mesher-error.js";
import {
  invalidArrays,
  invalidOption,
  packageDiagnostic,
  readDiagnostic,
} from "../diagnostics/package-diagnostic.js";
import type { InnerShells } from "../generated/constants.js";
import type { CurvedEdges, SurfaceInput, VolumeInput } from "../mesh/mesh.js";
import { groupSchema, regionsOnSides } from "../mesh/mesh-checks.js";
import { checkGradation } from "./mesh-options.js";
import { type ProjectArrays, projectArrays } from "../project/arrays.js";
import { checkedProject } from "../project/project.js";
import type { Project } from "../project/project-types.js";
import { meshedRegionsOf } from "./surface-numbers.js";

export function checkProject(project: unknown): Diagnostic[] {
  const parsed = checkedProject(project);
  if (!parsed.success) {
    return parsed.errors.map((error) => readDiagnostic({ ...error, code: "invalid-project" }));
  }
  const { gradation } = parsed.value.meshing ?? {};
  return gradation === undefined ? [] : checkGradation(gradation);
}

const listener = v.optional(v.function());
const controlSchema = v.object({
  ...watch,
  onFront: listener,
  onUnoptimized: listener,
  onTrace: listener,
  onBody: listener,
  partial: v.optional(v.boolean()),
  inBlocks: v.optional(v.boolean()),
});

export function checkControl(control: RunControl): Diagnostic[] {
  const problem = problemIn(controlSchema, control);
  if (problem === undefined) return [];
  const where = problem.path === "" ? "" : `.${problem.path}`;
  const remedy =
    "Pass an object with any of: functions onProgress, onFront, onUnoptimized, onTrace and onBody, an AbortSignal signal.";
  return [invalidOption("control", `the control${where} of the call is invalid: ${problem.message}`, remedy)];
}

const finite = v.pipe(v.number(), v.finite());
const markedPoint = v.object({ number: v.number(), position: v.tuple([finite, finite, finite]) });
const regionPointsSchema = v.optional(
  v.object({
    holes: v.array(markedPoint),
    regions: v.array(
      v.object({
        ...markedPoint.entries,
        tag: finite,
        name: v.optional(v.string()),
        maxVolume: v.optional(v.pipe(finite, v.gtValue(0))),
      }),
    ),
  }),
);

const surfaceSchema = v.pipe(
  v.object({
    points: doubles(3),
    triangles: integers(3),
    origin: v.optional(integers()),
    nodeOrigin: v.optional(integers()),
    trianglePatch: v.optional(integers()),
    patches: v.optional(v.array(groupSchema)),
    surfaceRegions: v.optional(regionsOnSides),
    regionPoints: regionPointsSchema,
  }),
  v.check(
    ({ origin, triangles }) => origin === undefined || 3 * origin.length === triangles.length,
    "origin must have one index per triangle",
  ),
  v.check(
    ({ nodeOrigin, points }) => nodeOrigin === undefined || 3 * nodeOrigin.length === points.length,
    "nodeOrigin must have one index per node",
  ),
  v.check(
    ({ trianglePatch, triangles }) =>
      trianglePatch === undefined || 3 * trianglePatch.length === triangles.length,
    "trianglePatch must have one index per triangle",
  ),
  v.check(
    ({ surfaceRegions, triangles }) =>
      surfaceRegions?.areMeshed !== true ||
      3 * surfaceRegions.triangleRegions.length === 2 * triangles.length,
    "surfaceRegions.triangleRegions must have two regions per triangle",
  ),
);

const SURFACE_REMEDY =
  "Pass x y z per node in a Float64Array and three node indices per triangle in a Uint32Array, and the other parts as a reader returns them.";

export function checkSurface(surface: SurfaceInput): Diagnostic[] {
  return checkArrays("surface", surface, surfaceSchema, SURFACE_REMEDY);
}

/** Returns whether points mark regions or holes; a file may list none. */
export function hasRegionPoints({ regionPoints }: Pick<SurfaceInput, "regionPoints">): boolean {
  return regionPoints !== undefined && regionPoints.holes.length + regionPoints.regions.length > 0;
}

/** Returns whether a region has a largest volume. */
export function hasRegionVolumes(surface: SurfaceInput): boolean {
  return meshedRegionsOf(surface).maxVolumes.some((volume) => volume > 0);
}

/** Returns the options with the meaning of inner shells in the file's format, unless they have one. */
export function withInnerShells<Options extends { readonly innerShells?: InnerShells | undefined }>(
  { regionPoints }: Pick<SurfaceInput, "regionPoints">,
  options: Options,
): Options {
  const isMeaningGiven = options.innerShells !== undefined || regionPoints === undefined;
  return isMeaningGiven ? options : { ...options, innerShells: "regions" };
}

/** As `checkSurface`, for calls that need to know what is meshed. */
export function checkLocatedSurface(surface: SurfaceInput): Diagnostic[] {
  const wrong = checkSurface(surface);
  if (wrong.length > 0 || !hasRegionPoints(surface)) return wrong;
  const message = "the points of the file that mark regions and holes have not been located in the surface";
  return [
    packageDiagnostic("unlocated-regions", message, "Pass the surface that `locateRegions()` returns."),
  ];
}

/** Rejects a weld distance so large that nothing would remain of the surface. */
export function checkWeld({ points }: SurfaceInput, weld: number | false | undefined): Diagnostic[] {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < points.length; i++) {
    const coordinate = points[i] ?? 0;
    if (coordinate < (low[i % 3] ?? 0)) low[i % 3] = coordinate;
    if (coordinate > (high[i % 3] ?? 0)) high[i % 3] = coordinate;
  }
  const extent = Math.max(...high.map((largest, axis) => largest - (low[axis] ?? 0)));
  // Without points, the extent is negative.
  if (!(extent >= 0 && Number(weld) > 0 && Number(weld) >= extent)) return [];
  const message = `the weld distance is ${weld}, but the extent of the whole surface is ${extent}`;
  return [invalidOption("weld", message, "Use a distance below the length of its shortest edges.")];
}

const tetrahedra = { points: doubles(3), tetrahedra: integers(4) };
const nodesExist = v.rawCheck<v.InferOutput<v.ObjectSchema<typeof tetrahedra, undefined>>>(
  ({ dataset, addIssue }) => {
    if (!dataset.typed) return;
    const { points, tetrahedra } = dataset.value;
    const count = points.length / 3;
    const at = tetrahedra.findIndex((node) => node >= count);
    if (at < 0) return;
    const tetrahedron = `tetrahedron ${Math.floor(at / 4)} (counted from 0)`;
    addIssue({ message: `${tetrahedron} refers to node ${tetrahedra[at]}, but there are ${count} nodes` });
  },
);
const volumeSchema = v.pipe(v.object({ ...tetrahedra, nodeData: v.optional(map) }), nodesExist);
const meshSchema = v.pipe(
  v.object({
    points: v.pipe(
      doubles(3),
      v.rawCheck(({ dataset, addIssue }) => {
        if (!dataset.typed) return;
        const at = dataset.value.findIndex((coordinate) => !(Math.abs(coordinate) <= LIMITS.length));
        if (at < 0) return;
        const node = `node ${Math.floor(at / 3)} (counted from 0)`;
        const message = `${node} has the coordinate ${dataset.value[at]}, which is not finite or beyond ${LIMITS.length}`;
        addIssue({ message });
      }),
    ),
    tetrahedra: tetrahedra.tetrahedra,
    tetrahedronRegion: v.optional(integers()),
    regions: v.optional(v.array(groupSchema)),
    invertedTetrahedra: v.optional(integers()),
  }),
  v.rawCheck(({ dataset, addIssue }) => {
    if (!dataset.typed) return;
    const { tetrahedra, tetrahedronRegion: owners = new Uint32Array() } = dataset.value;
    const count = tetrahedra.length / 4;
    if (owners.length === 0 || owners.length === count) return;
    addIssue({ message: `it has ${plural(owners.length, "region")} for ${plural(count, "tetrahedron")}` });
  }),
  nodesExist,
);

const TETRAHEDRA_REMEDY =
  "Pass x y z per node in a Float64Array and four node indices per tetrahedron in a Uint32Array.";

/** Checks a mesh that is to become a background grid, with `sizes` if given. */
export function checkVolume(mesh: VolumeInput, sizes: Float64Array | undefined): Diagnostic[] {
  const problems = checkArrays("mesh", mesh, volumeSchema, TETRAHEDRA_REMEDY);
  if (problems.length > 0) return problems;
  return mesh.tetrahedra.length === 0 ? [noTetrahedra()] : checkNodeSizes(sizes, mesh.points.length / 3);
}

/** `name`: the argument, for messages. */
export function checkMesh(mesh: VolumeInput, name = "mesh"): Diagnostic[] {
  const problems = checkArrays(name, mesh, meshSchema, TETRAHEDRA_REMEDY);
  if (problems.length > 0) return problems;
  return mesh.tetrahedra.length === 0 ? [noTetrahedra()] : [];
}

/** Checks a mesh that is to be improved. */
export function checkImproveInput(mesh: VolumeInput): Diagnostic[] {
  const wrong = checkMesh(mesh);
  if (wrong.length > 0) return wrong;
  const nodes = mesh.points.length / 3;
  const schema = v.object({
    trianglePatch: v.optional(integers()),
    patches: v.optional(v.array(groupSchema)),
    triangles: v.optional(
      v.pipe(
        integers(3),
        v.check(
          (corners) => corners.every((node) => node < nodes),
          "a triangle refers to a node that does not exist",
        ),
      ),
    ),
  });
  return checkArrays("mesh", mesh, schema, "Pass three node indices per triangle in a Uint32Array.");
}

/** Checks the curved edges of a mesh with this number of nodes. */
export function checkCurvedEdges(curvedEdges: CurvedEdges, nodes: number): Diagnostic[] {
  const schema = v.pipe(
    v.object({
      edges: v.pipe(
        integers(2),
        v.check((ends) => ends.every((node) => node < nodes), "an edge refers to a node that does not exist"),
      ),
      middles: v.pipe(
        doubles(3),
        v.check((values) => values.every(Number.isFinite), "a coordinate is not finite"),
      ),
    }),
    v.check(
      ({ edges, middles }) => 3 * edges.length === 2 * middles.length,
      "there must be one middle per edge",
    ),
  );
  const remedy = "Pass two node indices per edge in a Uint32Array, and x y z per edge in a Float64Array.";
  return checkArrays("curvedEdges", curvedEdges, schema, remedy);
}

function noTetrahedra(): Diagnostic {
  return invalidArrays("the mesh has no tetrahedron", "Mesh the model first, until the front has closed.");
}

function checkNodeSizes(sizes: Float64Array | undefined, count: number): Diagnostic[] {
  if (sizes === undefined) return [];
  const schema = v.pipe(
    doubles(),
    v.check(({ length }) => length === count, `expected one size for each of ${plural(count, "node")}`),
    v.rawCheck(({ dataset, addIssue }) => {
      if (!dataset.typed) return;
      const node = dataset.value.findIndex((size) => !(size > 0 && size < Infinity));
      if (node >= 0)
        addIssue({ message: `node ${node} (counted from 0) has the size ${dataset.value[node]}` });
    }),
  );
  return checkArrays(
    "sizes",
    sizes,
    schema,
    "Pass one finite size above 0 per node of the mesh, or no sizes.",
  );
}

/** Checks positions, x y z each. */
export function checkPositions(positions: Float64Array): Diagnostic[] {
  const schema = v.pipe(
    doubles(3),
    v.check((values) => values.every(Number.isFinite), "a coordinate is not finite"),
  );
  return checkArrays("positions", positions, schema, "Pass x y z per position in a Float64Array.");
}

export function checkArrays(
  name: string,
  value: unknown,
  schema: v.GenericSchema,
  remedy: string,
): Diagnostic[] {
  const problem = problemIn(schema, value);
  if (problem === undefined) return [];
  const where = problem.path === "" ? name : `${name}.${problem.path}`;
  return [invalidArrays(`the argument ${where} is invalid: ${problem.message}`, remedy)];
}

/** Diagnostic for a project without anything that a grid could cover. */
export function nothingToCover(): Diagnostic {
  const message = "there is nothing to cover: no point, line or patch can be evaluated";
  return packageDiagnostic("invalid-project", message, "Draw points and lines first.");
}

/** Diagnostic for a mesh whose numbers the engine refuses. */
export function unreadableMesh(): Diagnostic {
  const message = "the mesh has coordinates whose magnitude is too large or too small";
  return invalidArrays(
    message,
    `Use coordinates with magnitudes from 1e-75 to ${limitText(LIMITS.length)}, or 0.`,
  );
}

/** Returns the arrays of a drawing, which may be unfinished; throws only if it is not a project at all. */
export function drawnArrays(project: Project): ProjectArrays {
  try {
    return projectArrays(project);
  } catch (failure) {
    refuse(checkProject(project));
    throw failure;
  }
}
