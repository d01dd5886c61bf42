/** Prepares the surfaces of a project's bodies: their options, their progress and their diagnostics. */
import { shown } from "../base/values.js";
import { untilCancelled } from "../calls/cancelling.js";
import { pauseAfterCopy } from "../calls/yielder.js";
import type { Diagnostic, EntityRef } from "../diagnostics/diagnostic.js";
import { entityLabel, type EntityNamer, nameByIndex } from "../diagnostics/entity-names.js";
import { MesherError, refuse } from "../diagnostics/mesher-error.js";
import { invalidOption, sentence } from "../diagnostics/package-diagnostic.js";
import type { RunControl } from "../engine/control.js";
import type { BodySurfaceArrays } from "../generated/constants.js";
import type { Mesh, SurfaceInput } from "../mesh/mesh.js";
import type { PreparedBody } from "../mesh/prepared-body.js";
import type { BackgroundArrays } from "../project/background-arrays.js";
import { bodyArrays, bodyTrueFaces } from "../project/body-arrays.js";
import { bodySurface, type PlacedSurface } from "../project/bodies.js";
import { backgroundArrays, backgroundOf } from "../project/grid-arrays.js";
import { withPatchOfTriangle } from "../project/names.js";
import type { BodyId, Project, ProjectBody } from "../project/project-types.js";
import type { SizedSurface } from "./counted-surface.js";
import type { Mesher } from "./mesher-interface.js";
import type { InspectionOptions, MeshOptions, RemeshOptions } from "./option-types.js";
import { checkRemeshOptions } from "./surface-options.js";
import { areTooLarge } from "./surface-treatment.js";
import { WholeProgress } from "./whole-progress.js";

type Named<Call extends (...given: never[]) => unknown> = (
  ...given: [...Required<Parameters<Call>>, EntityNamer]
) => ReturnType<Call>;

/** Calls of the mesher that change a surface, with names for the entities in diagnostics. */
export interface SurfaceCalls {
  readonly remesh: Named<Mesher["remeshSurface"]>;
  readonly refine: Named<Mesher["refineSurface"]>;
  readonly checkOrientation: (
    surface: PlacedSurface,
    options: InspectionOptions,
    control: RunControl,
    name: EntityNamer,
  ) => Promise<Diagnostic[]>;
}

/** Returns the body with this id; throws a `MesherError` if there is none. */
export function bodyWithId({ bodies = [] }: Project, id: BodyId): ProjectBody {
  const body = bodies.find((one) => one.id === id);
  if (body !== undefined) return body;
  const message = `there is no body with the id ${shown(id)}`;
  throw new MesherError("invalid-input", message, {
    diagnostics: [invalidOption("body", message, "Pass the id of a body of the project.")],
  });
}

/** Returns what is wrong with the options of bodies, without looking at their triangles. */
export function bodyProblems({ bodies = [] }: Project): Diagnostic[] {
  return bodies.flatMap((body) =>
    checkRemeshOptions({ ...body.remeshing }).map((found) => ofBody(found, body, new Uint32Array())),
  );
}

/** Options of the bodies of a run: valid ones, with the project's settings. */
export interface BodyOptions extends MeshOptions {
  /** As in `RemeshOptions`. */
  readonly sizeFactor?: number | undefined;
}

/** Prepares a body. */
export async function preparedBody(
  calls: SurfaceCalls,
  project: Project,
  body: ProjectBody,
  options: BodyOptions,
  { signal, onProgress }: RunControl,
): Promise<PreparedBody> {
  // Decoding, placing and sending a large surface are tasks of their own.
  const decoded = bodyArrays(body);
  const pause = () => pauseAfterCopy(decoded.points, decoded.triangles);
  await pause();
  const given = bodySurface(body);
  await pause();
  const control: RunControl = {
    signal,
    onProgress: onProgress && ((progress) => onProgress({ ...progress, phase: "bodies", body: body.id })),
  };
  try {
    return { body: body.id, ...(await treated(calls, project, body, given, options, control)) };
  } catch (failure) {
    if (failure instanceof MesherError && failure.code === "invalid-input") {
      refuse(failure.data.diagnostics.map((found) => ofBody(found, body, given.trianglePatch)));
    }
    throw failure;
  }
}

async function treated(
  calls: SurfaceCalls,
  project: Project,
  body: ProjectBody,
  given: PlacedSurface,
  { sizeFactor, ...options }: BodyOptions,
  control: RunControl,
): Promise<Omit<PreparedBody, "body">> {
  const { surface: chosen = "remesh", remeshing = {} } = body;
  // The given triangles would limit a number of elements that is asked for.
  const treatment = chosen === "refine" && sizeFactor !== undefined ? "remesh" : chosen;
  const sizes = bodySizes(project, body, options);
  const name = bodyNamer(body, given);
  const named = (found: readonly Diagnostic[]) => found.map((one) => ofBody(one, body, given.trianglePatch));
  if (treatment === "remesh") {
    const { innerShells, growth, maxVolume } = options;
    const wanted: RemeshOptions = { growth, maxVolume, ...remeshing, ...sizes, innerShells, sizeFactor };
    const { mesh, origin, diagnostics, ...figures } = await calls.remesh(
      withTrueFaces(given, body),
      wanted,
      control,
      name,
    );
    const { points, triangles, trianglePatch, trueEdges } = mesh;
    const made = { points, triangles, trianglePatch, ...(trueEdges && { trueEdges }) };
    return { ...made, origin, ...figures, diagnostics: named(diagnostics) };
  }
  const { innerShells } = options;
  const diagnostics = named(await calls.checkOrientation(given, { innerShells }, control, name));
  if (treatment === "refine") {
    const hasSizes = sizes.size !== undefined || sizes.background !== undefined;
    const { elements: _, threads: _threads, ...refineOptions } = options;
    const split = await calls.refine(given, { ...refineOptions, ...sizes }, control, name);
    if (hasSizes || areTooLarge(split)) {
      const { points, triangles, trianglePatch } = split.mesh;
      return { points, triangles, trianglePatch, origin: split.origin, diagnostics };
    }
  }
  const { points, triangles, trianglePatch } = given;
  const origin = trianglePatch.map((_, triangle) => triangle);
  return { points, triangles, trianglePatch, origin, diagnostics };
}

/** Returns the surface of a body with its true faces, if it has any, where the body is. */
function withTrueFaces(given: PlacedSurface, body: ProjectBody): SurfaceInput {
  const solids = bodyTrueFaces(body);
  const { position, rotation, scale = 1 } = body.placement ?? {};
  return {
    ...given,
    trueFaces: solids?.map((faces) => {
      const own = faces.placement?.scale ?? 1;
      return { ...faces, placement: { position, rotation, scale: scale * own } };
    }),
  };
}

/**
 * Returns the surfaces of bodies that a run remeshes with automatic sizes, and their options; undefined if sizes are given, or
 * if the project has more than such bodies.
 */
export function automaticBodies(
  { bodies = [], patches }: Project,
  { size, growth, maxVolume, innerShells }: MeshOptions,
): SizedSurface[] | undefined {
  const isAutomatic =
    size === undefined &&
    patches.length === 0 &&
    bodies.every(
      ({ surface, remeshing = {} }) =>
        surface !== "keep" && remeshing.size === undefined && remeshing.maxSize === undefined,
    );
  if (!isAutomatic) return undefined;
  return bodies.map((body) => ({
    surface: bodySurface(body),
    options: { growth, maxVolume, ...body.remeshing, innerShells },
  }));
}

/** Returns the sizes of a body: its own, or those of the project; and always the sources. */
function bodySizes(
  project: Project,
  { remeshing = {} }: ProjectBody,
  { size, background }: MeshOptions,
): Pick<MeshOptions, "size" | "background"> {
  const own = backgroundArrays(backgroundOf(project));
  const sources = [...(own.sources ?? []), ...(background?.sources ?? [])].map((source, s) => ({
    ...source,
    id: s + 1,
  }));
  const capped = (nodes: BackgroundArrays) =>
    nodes.sizes.length === 0 && sources.length === 0 ? undefined : { ...nodes, sources };
  // A largest size limits automatic sizes only.
  if (remeshing.size !== undefined || remeshing.maxSize !== undefined) {
    return { size: remeshing.size, background: capped(NO_NODES) };
  }
  if (size !== undefined) return { size, background: capped(NO_NODES) };
  const hasNodes = background !== undefined && background.sizes.length > 0;
  return { size: undefined, background: capped(hasNodes ? background : own) };
}

const NO_NODES: BackgroundArrays = {
  points: new Float64Array(),
  sizes: new Float64Array(),
  tetrahedra: new Uint32Array(),
};

/** Names the triangles of a body; with their patches, if it has several. */
function bodyNamer({ patches }: ProjectBody, { trianglePatch }: PlacedSurface): EntityNamer {
  const name: EntityNamer = (kind, index) => {
    const patch = kind === "patch" ? patches[index] : undefined;
    if (patch === undefined) return nameByIndex(kind, index);
    return { kind, index, id: patch.id, label: entityLabel("patch", patch) };
  };
  return patches.length === 1 ? name : withPatchOfTriangle(name, trianglePatch);
}

/** Adds the body to the message of a diagnostic, and the patches of its triangles to its entities. */
export function ofBody(found: Diagnostic, body: ProjectBody, trianglePatch: Uint32Array): Diagnostic {
  const triangles = found.entities.filter(({ kind }) => kind === "triangle");
  const patches = new Set(triangles.map(({ index }) => trianglePatch[index] ?? 0));
  const refs = [...patches].flatMap((index): EntityRef[] => {
    const patch = body.patches[index];
    return patch === undefined
      ? []
      : [{ kind: "patch", index, id: patch.id, label: entityLabel("patch", patch) }];
  });
  const [first = "", ...rest] = found.message;
  const message = sentence(`${entityLabel("body", body)}: ${first.toLowerCase()}${rest.join("")}`);
  return { ...found, message, body: body.id, entities: [...found.entities, ...refs] };
}

/** The bodies of a project, ready to be meshed. */
export interface PreparedBodies {
  /** In the order of the project; without those that have errors. */
  readonly bodies: readonly PreparedBody[];
  /** Of all bodies. */
  readonly diagnostics: readonly Diagnostic[];
}

/** Prepares the bodies that are not among `known`, one after the other, and reports their common progress. */
export async function preparedBodies(
  calls: SurfaceCalls,
  project: Project,
  options: BodyOptions,
  known: readonly PreparedBody[],
  control: RunControl,
): Promise<PreparedBodies> {
  const { bodies = [] } = project;
  const ready = new Map(known.map((prepared) => [prepared.body, prepared]));
  const missing = bodies.filter(({ id }) => !ready.has(id));
  const diagnostics: Diagnostic[] = [];
  const whole = new WholeProgress(control);
  for (const [b, body] of missing.entries()) {
    try {
      const watched = whole.next(1 / (missing.length - b));
      ready.set(body.id, await preparedBody(calls, project, body, options, watched));
    } catch (failure) {
      if (!(failure instanceof MesherError && failure.code === "invalid-input")) throw failure;
      diagnostics.push(...failure.data.diagnostics);
    }
    const made = ready.get(body.id);
    if (made !== undefined) await untilCancelled<unknown>(() => control.onBody?.(made), control.signal);
  }
  const prepared = bodies.flatMap(({ id }) => ready.get(id) ?? []);
  return { bodies: prepared, diagnostics: [...diagnostics, ...prepared.flatMap((one) => one.diagnostics)] };
}

/** Joins the surfaces of bodies into one; their patches are those of all bodies of the project, in its order. */
export function joinedBodies({ bodies = [] }: Project, prepared: readonly PreparedBody[]): BodySurfaceArrays {
  const firstPatches = new Map<BodyId, number>();
  let patches = 0;
  for (const { id, patches: own } of bodies) {
    firstPatches.set(id, patches);
    patches += own.length;
  }
  const count = (field: "points" | "triangles" | "trianglePatch") =>
    prepared.reduce((sum, body) => sum + body[field].length, 0);
  const points = new Float64Array(count("points"));
  const triangles = new Uint32Array(count("triangles"));
  const trianglePatch = new Uint32Array(count("trianglePatch"));
  let [nodes, corners, owners] = [0, 0, 0];
  for (const body of prepared) {
    const firstPatch = firstPatches.get(body.body) ?? 0;
    points.set(body.points, 3 * nodes);
    for (const node of body.triangles) triangles[corners++] = nodes + node;
    for (const patch of body.trianglePatch) trianglePatch[owners++] = firstPatch + patch;
    nodes += body.points.length / 3;
  }
  return { points, triangles, trianglePatch, patches };
}

/**
 * Returns the mesh of a run with the edges of its bodies that bend. `surfaceNodes`: number of its surface nodes, of which those of
 * the joined bodies are the last.
 */
export function withBodyEdges(mesh: Mesh, surfaceNodes: number, prepared: readonly PreparedBody[]): Mesh {
  const own = prepared.flatMap(({ trueEdges }) => trueEdges ?? []);
  if (own.length === 0) return mesh;
  const edges = new Uint32Array(own.reduce((sum, one) => sum + one.edges.length, 0));
  const middles = new Float64Array((3 * edges.length) / 2);
  let end = 0;
  let node = surfaceNodes - prepared.reduce((sum, { points }) => sum + points.length / 3, 0);
  for (const { points, trueEdges } of prepared) {
    if (trueEdges !== undefined) {
      middles.set(trueEdges.middles, (3 * end) / 2);
      for (const corner of trueEdges.edges) edges[end++] = node + corner;
    }
    node += points.length / 3;
  }
  return { ...mesh, trueEdges: { edges, middles } };
}

/** Returns whether there is a body; callers without type checks may preview anything. */
export function hasBodies({ bodies }: Project): boolean {
  return bodies !== undefined && bodies.length > 0;
}
