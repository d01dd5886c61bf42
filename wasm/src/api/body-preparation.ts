/** Prepares the surfaces of a project's bodies: their options and their diagnostics. */
import { shown } from "../base/values.js";
import { invalidOption, sentence } from "../diagnostics/package-diagnostic.js";
import type { Diagnostic, EntityRef } from "../diagnostics/diagnostic.js";
import { type EntityNamer, nameByIndex } from "../diagnostics/entity-names.js";
import { MesherError, refuse } from "../diagnostics/mesher-error.js";
import type { RunControl } from "../engine/control.js";
import type { PreparedBody } from "../mesh/prepared-body.js";
import type { BackgroundArrays } from "../project/background-arrays.js";
import { bodySurface, type PlacedSurface } from "../project/bodies.js";
import { backgroundArrays, backgroundOf } from "../project/grid-arrays.js";
import { bodyLabel, type BodyId, type Project, type ProjectBody } from "../project/schema.js";
import type { Mesher } from "./mesher-interface.js";
import type { MeshOptions, RemeshOptions } from "./option-types.js";

/** Calls of the mesher that change a surface, with names for the entities in diagnostics. */
export interface SurfaceCalls {
  readonly remesh: (
    ...call: [...Parameters<Mesher["remeshSurface"]>, EntityNamer]
  ) => ReturnType<Mesher["remeshSurface"]>;
  readonly refine: (
    ...call: [...Parameters<Mesher["refineSurface"]>, EntityNamer]
  ) => ReturnType<Mesher["refineSurface"]>;
}

/** Returns the body with this id; throws a `MesherError` if there is none. */
export function bodyWithId({ bodies = [] }: Project, id: BodyId): ProjectBody {
  const body = bodies.find((one) => one.id === id);
  if (body !== undefined) return body;
  refuse([
    invalidOption(
      "body",
      `there is no body with the id ${shown(id)}`,
      "Pass the id of a body of the project.",
    ),
  ]);
  throw new RangeError("unreachable");
}

/** `options`: valid ones, with the project's settings. */
export async function preparedBody(
  calls: SurfaceCalls,
  project: Project,
  body: ProjectBody,
  options: MeshOptions,
  { signal, onProgress }: RunControl,
): Promise<PreparedBody> {
  const given = bodySurface(body);
  const control: RunControl = {
    signal,
    onProgress: onProgress && ((progress) => onProgress({ ...progress, phase: "bodies", body: body.id })),
  };
  try {
    return { body: body.id, ...(await treated(calls, project, body, given, options, control)) };
  } catch (failure) {
    if (failure instanceof MesherError && failure.code === "invalid-input") {
      refuse(failure.data.diagnostics.map((found) => ofBody(found, body, given)));
    }
    throw failure;
  }
}

async function treated(
  calls: SurfaceCalls,
  project: Project,
  body: ProjectBody,
  given: PlacedSurface,
  options: MeshOptions,
  control: RunControl,
): Promise<Omit<PreparedBody, "body">> {
  const { surface: treatment = "remesh", remeshing = {} } = body;
  const sizes = bodySizes(project, body, options);
  const name = bodyNamer(body, given);
  if (treatment === "remesh") {
    const { innerShells } = options;
    const wanted: RemeshOptions = { ...remeshing, ...sizes, innerShells };
    const { surface, origin, ...figures } = await calls.remesh(given, wanted, control, name);
    return { ...withPatches(given, surface, origin), ...figures, diagnostics: [] };
  }
  const hasSizes = sizes.size !== undefined || sizes.background !== undefined;
  if (treatment === "refine" && hasSizes) {
    const wanted = { ...options, ...sizes };
    const { surface, origin } = await calls.refine(given, wanted, control, name);
    return { ...withPatches(given, surface, origin), diagnostics: [] };
  }
  const origin = given.trianglePatch.map((_, triangle) => triangle);
  return { ...withPatches(given, given, origin), diagnostics: [] };
}

function withPatches(
  { trianglePatch }: PlacedSurface,
  { points, triangles }: Pick<PreparedBody, "points" | "triangles">,
  origin: Uint32Array,
) {
  return { points, triangles, trianglePatch: origin.map((from) => trianglePatch[from] ?? 0), origin };
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

/** Names the triangles of a body with their patches. */
function bodyNamer(body: ProjectBody, { trianglePatch }: PlacedSurface): EntityNamer {
  return (kind, index) => {
    const named = nameByIndex(kind, index);
    if (kind !== "triangle" || body.patches.length === 1) return named;
    const patch = body.patches[trianglePatch[index] ?? 0];
    return patch === undefined ? named : { ...named, label: `${named.label} of ${patchLabel(patch)}` };
  };
}

/** Returns what messages call a patch: `patch "wing"`, or `patch 3` by id. */
function patchLabel({ id, name = "" }: { readonly id: number; readonly name?: string | undefined }): string {
  return name === "" ? `patch ${id}` : `patch "${name}"`;
}

/** Adds the body to the message of a diagnostic, and the patches of its triangles to its entities. */
function ofBody(found: Diagnostic, body: ProjectBody, { trianglePatch }: PlacedSurface): Diagnostic {
  const isTriangle = ({ kind }: EntityRef) => kind === "triangle";
  const patches = found.entities.filter(isTriangle).map(({ index }) => trianglePatch[index] ?? 0);
  const refs = [...new Set(patches)].flatMap((index): EntityRef[] => {
    const patch = body.patches[index];
    return patch === undefined ? [] : [{ kind: "patch", index, id: patch.id, label: patchLabel(patch) }];
  });
  const message = sentence(
    `${bodyLabel(body)}: ${found.message.charAt(0).toLowerCase()}${found.message.slice(1)}`,
  );
  return { ...found, message, body: body.id, entities: [...found.entities, ...refs] };
}
