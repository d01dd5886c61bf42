import type {
  BodyPlacement,
  BodyRemeshing,
  BodySurface,
  Project,
  ProjectBody,
  ProjectBodyPatch,
} from "tetrafront/project";
import { bodyStepNames, stepNames } from "../strings";
import { nounOf, recordOf, type ProjectDraft } from "./draft-records";
import type { DraftEdit, ProjectEdit } from "./edit";
import { bodiesOf, recordsOf } from "./entities";

/** Changes of the bodies of a project, as named edits for the history. An edit of a missing body changes nothing. */

/** Returns the ids of the next body and of its first patch. */
export function nextBodyIds(project: Project): { readonly id: number; readonly firstPatchId: number } {
  const above = (records: readonly { readonly id: number }[]): number =>
    records.reduce((highest, { id }) => Math.max(highest, id), 0) + 1;
  const patches = [...recordsOf(project, "patch"), ...recordsOf(project, "body-patch")];
  return { id: above(bodiesOf(project)), firstPatchId: above(patches) };
}

/** Changes the treatment of bodies as one step. */
export function setCommonSurface(ids: readonly number[], surface: BodySurface): ProjectEdit {
  return {
    label: bodyStepNames.surfaces(ids.length),
    change: ({ project }) => {
      for (const id of ids) {
        const body = bodyOf(project, id);
        if (body) writeSurface(body, surface);
      }
    },
  };
}

/** The file omits the default. */
function writeSurface(body: { surface?: BodySurface | undefined }, surface: BodySurface): void {
  if (surface === "remesh") delete body.surface;
  else body.surface = surface;
}

const replaceBodies = (label: string, bodies: readonly ProjectBody[]): ProjectEdit => ({
  label,
  replace: { bodies },
});

/** Adds bodies as one step. */
export function addBodies(project: Project, bodies: readonly ProjectBody[]): ProjectEdit {
  const [first] = bodies;
  const label =
    bodies.length === 1 && first
      ? stepNames.add(nounOf("body", first.id))
      : bodyStepNames.addMany(bodies.length);
  return replaceBodies(label, [...bodiesOf(project), ...bodies]);
}

/** Replaces a body by one with other triangles or patches. */
export function replaceBody(project: Project, label: string, body: ProjectBody): ProjectEdit {
  return replaceBodies(
    label,
    bodiesOf(project).map((other) => (other.id === body.id ? body : other)),
  );
}

const bodyOf = ({ bodies }: ProjectDraft, id: number) => bodies && recordOf(bodies, id);

export function setBodySurface(id: number, surface: BodySurface): ProjectEdit {
  return {
    label: bodyStepNames.surface(nounOf("body", id)),
    change: ({ project }) => {
      const body = bodyOf(project, id);
      if (body) writeSurface(body, surface);
    },
  };
}

/** Sets an option of remeshing; null removes it, so that the default applies. */
export function setRemeshing(id: number, field: keyof BodyRemeshing, value: number | null): DraftEdit {
  return {
    label: bodyStepNames.remeshing[field],
    ...(value !== null && { mergeKey: `remeshing-${id}-${field}` }),
    change: ({ project }) => {
      const body = bodyOf(project, id);
      if (!body) return;
      const { [field]: _, ...others } = body.remeshing ?? {};
      const settings = value === null ? others : { ...others, [field]: value };
      if (Object.keys(settings).length === 0) delete body.remeshing;
      else body.remeshing = settings;
    },
  };
}

/** Moves a body. Parts of the placement that equal their default are omitted. */
export function setPlacement(id: number, placement: BodyPlacement, mergeKey?: string): DraftEdit {
  return {
    label: stepNames.move(nounOf("body", id)),
    ...(mergeKey !== undefined && { mergeKey: `placement-${id}-${mergeKey}` }),
    change: ({ project }) => {
      const body = bodyOf(project, id);
      if (body) writePlacement(body, placement);
    },
  };
}

function writePlacement(
  body: { placement?: ProjectDraftPlacement | undefined },
  { position, rotation, scale }: BodyPlacement,
): void {
  const isMoved = position?.some((x) => x !== 0) === true;
  const isRotated = rotation !== undefined && rotation[3] !== 1;
  const written: ProjectDraftPlacement = {
    ...(isMoved && { position: [...position] }),
    ...(isRotated && { rotation: [...rotation] }),
    ...(scale !== undefined && scale !== 1 && { scale }),
  };
  if (Object.keys(written).length === 0) delete body.placement;
  else body.placement = written;
}

type ProjectDraftPlacement = NonNullable<NonNullable<ProjectDraft["bodies"]>[number]["placement"]>;

/** Returns patches without those that no triangle has, and the new index of each. */
export function usedPatches(
  patches: readonly ProjectBodyPatch[],
  trianglePatch: Uint32Array,
): { readonly patches: ProjectBodyPatch[]; readonly trianglePatch: Uint32Array<ArrayBuffer> } {
  const isUsed = new Uint8Array(patches.length);
  for (const patch of trianglePatch) isUsed[patch] = 1;
  const next = new Uint32Array(patches.length);
  const kept = patches.filter((_, p) => isUsed[p] === 1);
  let count = 0;
  patches.forEach((_, p) => (next[p] = isUsed[p] === 1 ? count++ : 0));
  return { patches: kept, trianglePatch: Uint32Array.from(trianglePatch, (patch) => next[patch] ?? 0) };
}
