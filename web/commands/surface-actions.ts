import type { Project, ProjectBody } from "tetrafront";
import type { App } from "../app/app";
import { addBody, nextBodyIds, replaceBody, usedPatches } from "../document/body-edits";
import { bodiesOf, bodyOfPatch, findRecord, type Entity } from "../document/entities";
import { mergePatches } from "../document/patch-splitting";
import { openDocumentFile } from "../session/files";
import type { PatchArrays } from "../workers/surface-files";
import { bodyStepNames, strings } from "../strings";
import { showFailure, showMessage } from "./messages";
import { noteReading, showNewBody } from "./project-actions";

/** Actions on the bodies of a project. */

/** Adds a surface from a file to the open document. */
export async function importSurface(app: App): Promise<void> {
  try {
    const result = await openDocumentFile("surfaces", noteReading(app));
    if (result.kind === "failed") {
      showMessage(app, strings.messages.openFailed(result.fileName), result.reasons);
    }
    if (result.kind !== "surface") return;
    const body = renumbered(result.read.body, app.documents.project);
    const read = { ...result.read, body };
    app.bodies.keep(read);
    app.documents.edit(addBody(app.documents.project, body).edit);
    showNewBody(app, read);
  } catch (error) {
    showFailure(app, strings.bodies.import, error);
  }
}

/** Returns a body with ids that the project does not have yet. */
function renumbered(body: ProjectBody, project: Project): ProjectBody {
  const { id, firstPatchId } = nextBodyIds(project);
  return { ...body, id, patches: body.patches.map((patch, p) => ({ ...patch, id: firstPatchId + p })) };
}

/** Applies the proposed repair of a body. */
export async function repairBody(app: App, id: number): Promise<void> {
  const state = app.bodies.state.getState().byId.get(id);
  const body = bodiesOf(app.documents.project).find((other) => other.id === id);
  if (!state?.repair || !body) return;
  const { surface, hasFilled } = state.repair;
  const filled = {
    id: nextBodyIds(app.documents.project).firstPatchId,
    name: strings.bodies.repair.filledPatch,
  };
  const patches = hasFilled ? [...body.patches, filled] : body.patches;
  await replaceSurface(app, body, bodyStepNames.repair(nameOf(body)), surface, patches);
  app.bodies.prepareWhenValid(id);
}

const nameOf = ({ id, name }: ProjectBody): string => name ?? `body ${id}`;

/** Replaces the triangles of a body as one step of undo, unless the body has changed meanwhile. */
async function replaceSurface(
  app: App,
  body: ProjectBody,
  label: string,
  surface: PatchArrays,
  patches: ProjectBody["patches"],
): Promise<void> {
  try {
    const used = usedPatches(patches, surface.trianglePatch);
    const { trianglePatch } = used;
    const replaced = await app.bodies.replaced(body, { ...surface, trianglePatch }, used.patches);
    if (findRecord(app.documents.project, "body", body.id) !== body) return;
    app.documents.edit(replaceBody(app.documents.project, label, replaced));
  } catch (error) {
    showFailure(app, label, error);
  }
}

/** Applies the proposed split of a body's patches. */
export async function splitPatches(app: App, id: number): Promise<void> {
  const state = app.bodies.state.getState().byId.get(id);
  const body = findRecord(app.documents.project, "body", id);
  if (!state?.split || !body) return;
  const { split, patch } = state.split;
  const { surface } = await app.bodies.surfaceOf(body);
  const subject = patch === null ? nameOf(body) : `patch ${patch}`;
  app.bodies.dropSplit(id);
  const { trianglePatch, patches } = split;
  await replaceSurface(app, body, bodyStepNames.split(subject), { ...surface, trianglePatch }, patches);
}

/** Returns the body of the selected patches if they can be merged. */
export function mergeableBody(project: Project, selection: readonly Entity[]): ProjectBody | undefined {
  const [first] = selection;
  if (!first || selection.length < 2) return undefined;
  const body = bodyOfPatch(project, first.id);
  const ids = new Set(body?.patches.map(({ id }) => id));
  return selection.every((entity) => entity.kind === "body-patch" && ids.has(entity.id)) ? body : undefined;
}

/** Merges the selected patches of a body into the first of them. */
export async function mergeSelectedPatches(app: App): Promise<void> {
  const { selection } = app.view.state.getState();
  const body = mergeableBody(app.documents.project, selection);
  if (!body) return;
  const ids = new Set(selection.map(({ id }) => id));
  const { surface } = await app.bodies.surfaceOf(body);
  const { trianglePatch, patches } = mergePatches(surface.trianglePatch, body.patches, ids);
  const label = bodyStepNames.merge(ids.size);
  const kept = body.patches.find(({ id }) => ids.has(id));
  await replaceSurface(app, body, label, { ...surface, trianglePatch }, patches);
  if (kept) app.view.selectAll([{ kind: "body-patch", id: kept.id }]);
}

/** Selects what the view shows of bodies: given triangles, those of a preview, or the mesh. */
export function showBodySurface(app: App, shown: "given" | "new" | "mesh"): void {
  app.view.setLayer("mesh", shown === "mesh");
  if (shown !== "mesh") {
    app.view.setLayer("bodies", true);
    app.view.state.setState({ bodySurface: shown });
  }
}

/** Makes a preview of a body's new triangles and shows it. */
export function previewBody(app: App, id: number): void {
  showBodySurface(app, "new");
  void app.bodies.prepare(id);
}
