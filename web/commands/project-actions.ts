import type { Project } from "tetrafront/project";
import type { App } from "../app/app";
import { emptyProject } from "../document/create";
import { isEmptyProject } from "../document/entities";
import type { OpenFailure } from "../session/document-library";
import {
  hasUnsavedChanges,
  settledProject,
  type DocumentState,
  type ProjectFile,
} from "../session/document-store";
import {
  failureLines,
  openDocumentFile,
  saveProjectFile,
  type OnReading,
  type OpenResult,
} from "../session/files";
import { loadModel, type GalleryModel } from "../session/gallery";
import { hideDocumentNotices, hideNotice, showNotice } from "../session/shell";
import { reasonsOf, openedMesh } from "../session/shown-mesh";
import { strings } from "../strings";
import type { ReadSurface } from "../workers/surface-files";
import { showFailure, showMessage } from "./messages";

/**
 * A document that is opened replaces the current one, which stays in the browser's storage with all its undo steps. If
 * no file contains its changes, a notice offers to reopen it.
 */

/** Opens a project as a new document and meshes it. */
export function openProject(app: App, project: Project, file: ProjectFile | null = null): void {
  finishOpening(app, app.showProject(project, file));
  meshOpened(app);
}

/** Opens a project as a new document, and does not mesh it. */
export function showModel(app: App, project: Project): void {
  finishOpening(app, app.showProject(project));
}

/** Opens a surface as a new document: a project with a body per solid; the card shows the first one. */
export function openSurface(app: App, name: string, read: ReadSurface): void {
  const project = {
    ...projectOf(name, read),
    ...(read.hasInnerSolid && innerRegions),
  };
  for (const made of read.bodies) app.bodies.keep(made);
  finishOpening(app, app.showProject(project));
  showNewBodies(app, read);
}

/**
 * Opens a mesh as a new document, and shows its quality. Its boundary becomes a body of the project, so that it can be
 * meshed again.
 */
async function openMesh(app: App, { name, fileName, read, mesh }: OpenedMeshFile): Promise<void> {
  try {
    const shown = await openedMesh(await app.mesher, fileName, mesh);
    const project = {
      ...projectOf(name, read),
      // Shells inside a mesh with several regions are regions too.
      ...(mesh.mesh.regions.length > 1 && innerRegions),
    };
    for (const made of read.bodies) app.bodies.keep(made);
    finishOpening(app, app.showMesh(project, shown));
    app.view.setLayer("mesh", true);
    app.shell.setState({ rightTab: "quality", drawer: "right" });
    const { nodeData, elementData = new Map() } = mesh.mesh;
    const fields = [...new Set([...nodeData.keys(), ...elementData.keys()])];
    const notes = fields.length > 0 ? [strings.files.meshFields(fields)] : [];
    showNotes(app, [...read.notes, ...notes, strings.files.meshNotSaved]);
  } catch (error) {
    const reasons = reasonsOf(error);
    showMessage(app, strings.messages.openFailed(fileName), reasons);
  }
}

type OpenedMeshFile = Extract<OpenResult, { readonly kind: "mesh" }>;

/** Returns a project with the bodies and the unit of a file. */
function projectOf(name: string, { bodies, unit }: ReadSurface): Project {
  return {
    ...emptyProject(name),
    ...(unit !== undefined && { units: unit }),
    bodies: bodies.map(({ body }) => body),
  };
}

const innerRegions: Pick<Project, "meshing"> = { meshing: { innerShells: "regions" } };

/** Selects the first new body and previews the triangles of each as soon as its surface is known to be valid. */
export function showNewBodies(app: App, { bodies, notes }: Pick<ReadSurface, "bodies" | "notes">): void {
  const ids = bodies.map(({ body }) => body.id);
  app.view.setLayer("bodies", true);
  app.view.state.setState({ bodySurface: "new" });
  app.view.selectAll(ids.slice(0, 1).map((id) => ({ kind: "body", id })));
  app.shell.setState({ rightTab: "inspector", leftTab: "model", drawer: "right" });
  for (const id of ids) app.bodies.prepareWhenValid(id);
  showNotes(app, notes);
}

/** Shows notes about an opened file. */
export function showNotes(app: App, notes: readonly string[]): void {
  if (notes.length === 0) return;
  showNotice(app.shell, {
    key: "file-notes",
    tone: "information",
    text: notes.map((note) => (note.endsWith(".") ? note : `${note}.`)).join(" "),
    action: { label: strings.notices.understood, run: () => undefined },
  });
}

/** Opens an empty project, to draw in. */
export function newProject(app: App): void {
  showModel(app, emptyProject());
}

/** Opens a new project to begin with, and meshes it unless it is empty. */
export function openTemplate(app: App, project: Project): void {
  if (isEmptyProject(project)) showModel(app, project);
  else openProject(app, project);
}

export async function openExample(app: App, model: GalleryModel): Promise<void> {
  try {
    openProject(app, await loadModel(model));
  } catch (error) {
    showFailure(app, strings.messages.openFailed(model.title), error);
  }
}

/** Opens a document that the browser has stored, with its undo steps. */
export async function openRecent(app: App, id: string, name: string): Promise<void> {
  try {
    const opened = await app.showRecent(id);
    if (typeof opened === "string") {
      showMessage(app, strings.messages.openFailed(name), [failureTexts[opened]]);
      return;
    }
    finishOpening(app, opened);
    meshOpened(app);
  } catch (error) {
    showFailure(app, strings.messages.openFailed(name), error);
  }
}

const failureTexts: { readonly [F in OpenFailure]: string } = strings.recent.failures;

/** Offers to reopen the document that the address has replaced. */
export function offerLeftDocument(app: App): void {
  const { left } = app;
  if (left) offerReopening(app, left.name, () => openRecent(app, left.id, left.name));
}

async function reopen(app: App, document: DocumentState): Promise<void> {
  finishOpening(app, await app.showAgain(document));
  meshOpened(app);
}

function finishOpening(app: App, before: DocumentState): void {
  app.viewer.getState().viewer?.framing.reset();
  hideDocumentNotices(app.shell);
  app.shell.setState({ drawer: null, dialog: null, startPage: false, leftTab: "model", message: null });
  if (!hasUnsavedChanges(before)) hideNotice(app.shell, "document-left");
  else offerReopening(app, settledProject(before).name, () => reopen(app, before));
}

function offerReopening(app: App, name: string, reopenIt: () => Promise<void>): void {
  showNotice(app.shell, {
    key: "document-left",
    tone: "information",
    text: strings.notices.documentLeft(name),
    action: { label: strings.notices.reopen, run: () => void reopenIt() },
  });
}

/** A mesh that was made from this project earlier is already shown. */
export function meshOpened(app: App): void {
  if (app.generate && !app.run.state.getState().mesh) void app.run.generate("app");
}

export async function takeOpened(app: App, result: OpenResult): Promise<void> {
  if (result.kind === "opened") openProject(app, result.project, result.file);
  else if (result.kind === "surface") openSurface(app, result.name, result.read);
  else if (result.kind === "mesh") await openMesh(app, result);
  else if (result.kind === "failed") {
    showMessage(app, strings.messages.openFailed(result.fileName), failureLines([result]));
  }
}

export async function openFromDialog(app: App): Promise<void> {
  try {
    await takeOpened(app, await openDocumentFile("documents", noteReading(app)));
  } catch (error) {
    showFailure(app, strings.messages.noOpenDialog, error);
  }
}

/** Shows in the status bar which file is being read. */
export const noteReading =
  (app: App): OnReading =>
  (reading) =>
    app.shell.setState({ reading });

/** Saves to the document's file; without one, or if `askForName` is set, asks the user for a file. */
export async function save(app: App, askForName: boolean): Promise<void> {
  try {
    const state = app.documents.state.getState();
    const project = settledProject(state);
    const saved = await saveProjectFile(project, askForName ? null : state.file);
    if (saved) app.documents.markSaved(state.id, project, saved.file);
  } catch (error) {
    showFailure(app, strings.messages.saveFailed, error);
  }
}
