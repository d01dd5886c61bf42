import type { Project, ProjectBody } from "tetrafront/project";
import type { App } from "../app/app";
import { addBodies, nextBodyIds, replaceBody, usedPatches } from "../document/body-edits";
import { withRepairs, withTreatmentAfter } from "../document/body-repair";
import { replaceByJoined } from "../document/touching-bodies";
import { inProjectUnit, unitOf } from "../document/length-units";
import { bodiesOf, bodyLabel, bodyOfPatch, findRecord, type Entity } from "../document/entities";
import { failureLines, openDocumentFile } from "../session/files";
import { fillableBodies } from "../session/bodies";
import type { RunNote } from "../session/run-log";
import { joinedBody } from "../session/touching-bodies";
import { bodyStepNames, strings } from "../strings";
import { formatShort } from "../strings/format";
import { showFailure, showMessage } from "./messages";
import type { NewBody, ReadSurface } from "../workers/surface-files";
import { noteReading, showNewBodies } from "./project-actions";

/** Actions on the bodies of a project. */

/** Adds a surface from a file to the open document. */
export async function importSurface(app: App): Promise<void> {
  try {
    const result = await openDocumentFile("surfaces", noteReading(app));
    if (result.kind === "failed") {
      showMessage(app, strings.messages.openFailed(result.fileName), failureLines([result]));
    }
    if (result.kind !== "surface" && result.kind !== "mesh") return;
    const added = await addSurfaces(app, [result]);
    showNewBodies(app, added);
    fitToBodies(app, added.bodies);
  } catch (error) {
    showFailure(app, strings.bodies.import, error);
  }
}

/** Shows the whole model unless new bodies are in view. */
export function fitToBodies(app: App, bodies: readonly Pick<NewBody, "body">[]): void {
  const { viewer } = app.viewer.getState();
  viewer?.framing.fitUnlessShown(bodies.map(({ body }) => ({ kind: "body", id: body.id })));
}

/** Adds the bodies of files to the open document, as one step of undo. Returns them, and notes about the files. */
export async function addSurfaces(
  app: App,
  files: readonly { readonly name: string; readonly read: ReadSurface }[],
): Promise<Pick<ReadSurface, "bodies" | "notes">> {
  await app.documents.afterGesture();
  const { project } = app.documents;
  const bodies = renumbered(
    files.flatMap(({ read }) => inProjectUnit(read.bodies, read.unit, project)),
    project,
  );
  for (const made of bodies) app.bodies.keep(made);
  const added = bodies.map(({ body }) => body);
  app.documents.edit(addBodies(project, added));
  const { units } = project;
  const notes = files.flatMap(({ name, read }) =>
    units === undefined || read.unit === undefined || read.unit === units
      ? read.notes
      : [...read.notes, unitNote(name, read.unit, units)],
  );
  return { bodies, notes };
}

/** Returns what was done about a file in another unit than the project's. */
const unitNote = (name: string, unit: string, units: string): string =>
  unitOf(unit) && unitOf(units)
    ? strings.files.scaledUnit(name, unit, units)
    : strings.files.otherUnit(name, unit, units);

/** Returns bodies with ids that the project does not have yet. */
function renumbered(made: readonly NewBody[], project: Project): NewBody[] {
  let { id, firstPatchId } = nextBodyIds(project);
  return made.map(({ body, loaded }) => {
    const patches = body.patches.map((patch) => ({ ...patch, id: firstPatchId++ }));
    return { body: { ...body, id: id++, patches }, loaded };
  });
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
  const used = usedPatches(patches, surface.trianglePatch);
  const { trianglePatch } = used;
  const treated = withTreatmentAfter(state.repair.changes, body);
  const repaired = { ...treated, ...withRepairs(treated, state.repair) };
  const isRepaired = await changeBody(app, body, bodyStepNames.repair(bodyLabel(body)), () =>
    app.bodies.replaced(repaired, { ...surface, trianglePatch }, used.patches),
  );
  if (!isRepaired) return;
  app.view.unmark();
  app.bodies.prepareWhenValid(id);
}

/**
 * Joins bodies that touch or intersect, each group as one step of undo, so that they have common triangles there. Calls
 * `onJoined` with what was done to each group, and with a warning about a volume that they share. Bodies that cannot be joined stay as they are: a run reports why. So do those
 * that were changed meanwhile.
 */
export async function joinTouchingBodies(
  app: App,
  signal: AbortSignal,
  onJoined: (note: RunNote) => void,
): Promise<void> {
  const { byId } = app.bodies.state.getState();
  if (byId.size < 2) return;
  const mesher = await app.mesher;
  for (const group of await app.bodies.pairs.touching(mesher, fillableBodies(byId.values()), signal)) {
    const joined = await joinedBody(mesher, app.documents.project, group, signal);
    if (!joined) continue;
    const { surface, regions, shared } = joined;
    const body = await app.bodies.replaced(joined.body, surface, joined.body.patches);
    await app.documents.afterGesture(signal);
    const { project } = app.documents;
    const bodies = group.map((one) => one.body);
    const areThere = bodies.every((one) => findRecord(project, "body", one.id) === one);
    if (!areThere || nextBodyIds(project).id !== body.id) return;
    const ids = bodies.map(({ id }) => id);
    app.documents.edit(replaceByJoined(project, bodyStepNames.join(bodies.map(bodyLabel)), body, ids));
    app.view.selectAll([{ kind: "body", id: body.id }]);
    const names = bodies.map(bodyLabel);
    onJoined({ level: "information", text: strings.bodies.touching.joined(names, regions) });
    if (shared > 0) onJoined(overlapNote(names, shared, Math.min(...group.map(({ volume }) => volume))));
  }
}

/** Warns that bodies which were joined share a volume. `smallest`: that of the smallest body. */
function overlapNote(names: readonly string[], shared: number, smallest: number): RunNote {
  const { overlap, overlapRemedy: remedy } = strings.bodies.touching;
  const percent = String(Number(((100 * shared) / smallest).toPrecision(2)));
  return { level: "warning", text: overlap(names, formatShort(shared), percent), remedy };
}

/** Replaces a body as one step of undo, unless it has changed meanwhile. Returns whether it was replaced. */
async function changeBody(
  app: App,
  body: ProjectBody,
  label: string,
  change: () => Promise<ProjectBody>,
): Promise<boolean> {
  try {
    const changed = await change();
    await app.documents.afterGesture();
    if (findRecord(app.documents.project, "body", body.id) !== body) return false;
    app.documents.edit(replaceBody(app.documents.project, label, changed));
    return true;
  } catch (error) {
    showFailure(app, label, error);
    return false;
  }
}

/** Shows which patches a split of a body would make: of one patch, or of all if `patch` is null. */
export async function previewSplit(
  app: App,
  body: ProjectBody,
  angle: number,
  patch: number | null,
): Promise<void> {
  showBodySurface(app, "given");
  try {
    await app.bodies.proposeSplit(body, angle, patch);
  } catch (error) {
    showFailure(app, strings.bodies.split.preview, error);
  }
}

/** Applies the proposed split of a body's patches. */
export async function splitPatches(app: App, id: number): Promise<void> {
  const state = app.bodies.state.getState().byId.get(id);
  const body = findRecord(app.documents.project, "body", id);
  if (!state?.split || !body) return;
  const { split, patch } = state.split;
  const subject = patch === null ? bodyLabel(body) : `patch ${patch}`;
  app.bodies.dropSplit(id);
  await changeBody(app, body, bodyStepNames.split(subject), () => app.bodies.withSplit(body, split));
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
  const ids = selection.map(({ id }) => id);
  const label = bodyStepNames.merge(ids.length);
  const isMerged = await changeBody(app, body, label, () => app.bodies.withMerged(body, ids));
  const kept = body.patches.find(({ id }) => ids.includes(id));
  if (isMerged && kept) app.view.selectAll([{ kind: "body-patch", id: kept.id }]);
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
