import type { CoverOptions, SizeProposal } from "tetrafront";
import type { ProjectBackground, ProjectSource } from "tetrafront/project";
import type { App } from "../app/app";
import { replaceBackground, replaceSources, setMeshing } from "../document/size-edits";
import { documentGrid } from "../document/large-grid";
import { marginToCover } from "../document/coverage-margin";
import { packArrays } from "../document/packed-grid";
import { likelySize } from "../document/extent";
import { strings } from "../strings";
import { showFailure } from "./messages";

/** Actions on the background grid that need the engine. */

/** Replaces the background grid by one of uniform size around the model. */
export async function coverModel(
  app: App,
  options: CoverOptions,
  label: string = strings.background.cover,
): Promise<void> {
  try {
    const mesher = await app.mesher;
    const background = await mesher.coverProject(app.documents.project, options);
    app.documents.edit(replaceBackground(label, app.documents.project, background));
    app.view.setLayer("background", true);
  } catch (error) {
    showFailure(app, label, error);
  }
}

/** Makes the background grid cover the model by its margin, which changes no size inside the grid. */
export async function extendGrid(app: App, label: string): Promise<void> {
  try {
    const { project } = app.documents;
    // Only where it lies is of use.
    const around = await (
      await app.mesher
    ).coverProject(project, { size: likelySize(project), shape: "box" });
    const margin = await marginToCover(
      project.background,
      around.nodes.map(({ position }) => position),
    );
    await app.documents.afterGesture();
    const { background } = app.documents.project;
    const coverageMargin = Math.max(margin, background.coverageMargin ?? 0);
    app.documents.edit({ label, replace: { background: { ...background, coverageMargin } } });
    app.view.setLayer("background", true);
  } catch (error) {
    showFailure(app, label, error);
  }
}

/** Makes the shown mesh the background grid, with sizes from its edges. */
export async function takeBackgroundFromMesh(app: App): Promise<void> {
  const { mesh } = app.run.state.getState();
  if (!mesh) return;
  try {
    const arrays = await (await app.mesher).backgroundFromMesh(mesh.mesh);
    const grid = await documentGrid(packArrays(arrays));
    await app.documents.afterGesture();
    const { sources } = app.documents.project.background;
    const { coverageMargin = 0 } = arrays;
    const background: ProjectBackground = {
      ...grid,
      ...(sources && { sources }),
      ...(coverageMargin > 0 && { coverageMargin }),
    };
    app.documents.edit(
      replaceBackground(strings.background.backgroundFromMesh, app.documents.project, background),
    );
  } catch (error) {
    showFailure(app, strings.background.backgroundFromMesh, error);
  }
}

export interface ProposalUse {
  /** Replace the grid by a covering grid of the proposed size. */
  readonly cover: boolean;
  /** Replace the existing sources instead of adding to them. */
  readonly replaceSources: boolean;
}

/** Returns the existing sources and the proposed ones, which get new ids. */
export function mergeSources(
  existing: readonly ProjectSource[],
  proposed: readonly ProjectSource[],
): ProjectSource[] {
  const highest = existing.reduce((max, { id }) => Math.max(max, id), 0);
  return [...existing, ...proposed.map((source, i) => ({ ...source, id: highest + 1 + i }))];
}

export async function applyProposal(app: App, proposal: SizeProposal, use: ProposalUse): Promise<void> {
  try {
    const { project } = app.documents;
    const grid = use.cover
      ? await (await app.mesher).coverProject(project, { size: proposal.size })
      : project.background;
    const existing = use.replaceSources ? [] : (project.background.sources ?? []);
    const background = { ...grid, sources: mergeSources(existing, proposal.sources) };
    const label = strings.background.propose;
    app.documents.edit(
      use.cover
        ? replaceBackground(label, app.documents.project, background)
        : replaceSources(label, background),
    );
    app.view.setLayer("sources", true);
  } catch (error) {
    showFailure(app, strings.background.propose, error);
  }
}

/** The uniform size that the document of an app had last. */
const lastSizes = new WeakMap<App, { readonly documentId: string; readonly size: number }>();

/** Chooses a uniform size, the one that the document had last, or the sizes of the background grid. */
export function setUniform(app: App, isUniform: boolean): void {
  const { project } = app.documents;
  const { id: documentId } = app.documents.state.getState();
  const size = project.meshing?.size;
  if (size !== undefined) lastSizes.set(app, { documentId, size });
  const last = lastSizes.get(app);
  const wanted = last?.documentId === documentId ? last.size : likelySize(project);
  app.documents.edit(setMeshing("size", isUniform ? wanted : null));
}

/** Switches between a uniform size and the sizes of the background grid. */
export function toggleUniformSize(app: App): void {
  setUniform(app, app.documents.project.meshing?.size === undefined);
  app.view.clear();
  app.shell.setState({ rightTab: "inspector" });
}
