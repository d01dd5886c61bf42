import type { CoverOptions, ProjectSource, SizeProposal } from "tetrafront";
import type { App } from "../app/app";
import { replaceBackground, replaceSources, setMeshing } from "../document/edits";
import { documentGrid } from "../document/large-grid";
import { packArrays } from "../document/packed-grid";
import { rangeAlong, smallestSize } from "../document/extent";
import { strings } from "../ui/strings";

/** What commands and dialogs do to the background grid with the engine's help. */

function fail(app: App, title: string, error: unknown): void {
  const reason = error instanceof Error ? error.message : String(error);
  app.shell.setState({ message: { title, lines: [reason] } });
}

/** Puts a grid of one size around the model, in place of the present one. */
export async function coverModel(app: App, options: CoverOptions): Promise<void> {
  try {
    const mesher = await app.mesher;
    const background = await mesher.coverProject(app.documents.project, options);
    app.documents.edit(replaceBackground(strings.background.cover, app.documents.project, background));
    app.view.setLayer("background", true);
  } catch (error) {
    fail(app, strings.background.cover, error);
  }
}

/** Takes the mesh on show as background grid, with the sizes of its own edges. */
export async function takeBackgroundFromMesh(app: App): Promise<void> {
  const { mesh } = app.run.state.getState();
  if (!mesh) return;
  try {
    const arrays = await (await app.mesher).backgroundFromMesh(mesh.volume);
    const grid = await documentGrid(packArrays(arrays));
    const { sources } = app.documents.project.background;
    const { coverageMargin: overhang = 0 } = arrays;
    const background = { ...grid, ...(sources && { sources }), ...(overhang > 0 && { overhang }) };
    app.documents.edit(
      replaceBackground(strings.background.backgroundFromMesh, app.documents.project, background),
    );
  } catch (error) {
    fail(app, strings.background.backgroundFromMesh, error);
  }
}

export interface ProposalUse {
  /** A covering grid of the proposed size takes the place of the present grid. */
  readonly cover: boolean;
  /** The proposed sources take the place of the present ones; else they come on top. */
  readonly replaceSources: boolean;
}

/** The project's sources with those proposed, under ids of their own. */
export function mergeSources(
  present: readonly ProjectSource[],
  proposed: readonly ProjectSource[],
): ProjectSource[] {
  const highest = present.reduce((most, { id }) => Math.max(most, id), 0);
  return [...present, ...proposed.map((source, i) => ({ ...source, id: highest + 1 + i }))];
}

export async function applyProposal(app: App, proposal: SizeProposal, use: ProposalUse): Promise<void> {
  try {
    const { project } = app.documents;
    const grid = use.cover
      ? await (await app.mesher).coverProject(project, { size: proposal.size })
      : project.background;
    const present = use.replaceSources ? [] : (project.background.sources ?? []);
    const background = { ...grid, sources: mergeSources(present, proposal.sources) };
    const label = strings.background.propose;
    app.documents.edit(
      use.cover
        ? replaceBackground(label, app.documents.project, background)
        : replaceSources(label, background),
    );
    app.view.setLayer("sources", true);
  } catch (error) {
    fail(app, strings.background.propose, error);
  }
}

/** A size to begin with where none has been given: a round twentieth of the model. */
export function likelySize(app: App): number {
  const { project } = app.documents;
  const extents = [0, 1, 2].map((axis) => {
    const [low, high] = rangeAlong(project.points, axis);
    return Math.max(0, high - low);
  });
  const rough = smallestSize(project) ?? (Math.max(...extents) || 1) / 20;
  return Number(rough.toPrecision(2));
}

/** Switches between one size everywhere and the sizes of the background grid. */
export function toggleUniformSize(app: App): void {
  const on = app.documents.project.meshing?.size === undefined;
  app.documents.edit(setMeshing("size", on ? likelySize(app) : null));
  app.view.clear();
  app.shell.setState({ rightTab: "inspector" });
}
