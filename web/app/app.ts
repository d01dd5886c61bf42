import { createMesher, type Mesher } from "tetrafront";
import { createStore, type StoreApi } from "zustand/vanilla";
import { Autosave, type Kept } from "../session/autosave";
import { contentKey } from "../document/content-key";
import { emptyProject } from "../document/edits";
import { loadGallery, loadModel, type Gallery } from "../session/gallery";
import { PreviewFeed } from "../session/preview";
import { ProblemList } from "../session/problems";
import { MeshRun, regionCount } from "../session/run";
import { ViewStore } from "../document/selection";
import { createShell, type Shell } from "../session/shell";
import { DocumentStore } from "../session/document-store";
import { strings } from "../ui/strings";
import { MeshQueryClient } from "../viewer/mesh-query-client";
import type { Viewer } from "../viewer/viewer";

/** Everything the panels and commands work with. Made once, when the page has loaded. */
export interface App {
  readonly documents: DocumentStore;
  readonly mesher: Promise<Mesher>;
  readonly view: ViewStore;
  readonly run: MeshRun;
  readonly previews: PreviewFeed;
  readonly problems: ProblemList;
  readonly autosave: Autosave;
  readonly shell: Shell;
  readonly gallery: Gallery;
  /** Looks through the mesh on show. */
  readonly meshQueries: MeshQueryClient;
  /** The view, while there is one: no WebGL, no view. */
  readonly viewer: StoreApi<{ readonly viewer: Viewer | null }>;
  /** The file that Save writes to without asking. */
  readonly file: { handle: FileSystemFileHandle | null };
  /** `?test=1`: no motion, no multisampling. */
  readonly still: boolean;
}

const noGallery: Gallery = { opening: "", models: [] };

async function firstProject(autosave: Autosave, gallery: Gallery, wanted: string | null): Promise<Kept> {
  const kept = await autosave.load();
  if (kept) return kept;
  const opening = gallery.models.find(({ id }) => id === (wanted ?? gallery.opening));
  const project = opening ? await loadModel(opening) : emptyProject("Untitled");
  return { project, savedKey: contentKey(project) };
}

/**
 * Loads what was last worked on, else the model that the address names, else the opening model, and
 * wires the rooms together.
 */
export async function createApp(still: boolean, model: string | null): Promise<App> {
  const mesher = createMesher();
  // Runs and previews report the failure; here it only must not count as unhandled.
  mesher.catch(() => undefined);
  const shell = createShell();
  const fail = (error: unknown): void =>
    shell.setState({ message: { title: strings.messages.galleryFailed, lines: [String(error)] } });
  const gallery = await loadGallery().catch((error: unknown) => {
    fail(error);
    return noGallery;
  });
  const documents = new DocumentStore(emptyProject("Untitled"));
  const autosave = new Autosave(documents);
  const start = await firstProject(autosave, gallery, model).catch((error: unknown) => {
    fail(error);
    return null;
  });
  if (start) documents.restore(start.project, start.savedKey);
  autosave.follow();
  const run = new MeshRun(documents, mesher);
  const previews = new PreviewFeed(documents, mesher);
  const view = new ViewStore();
  const problems = new ProblemList(documents, previews, run);
  run.state.subscribe((state, before) => {
    if (state.mesh !== before.mesh || state.outcome !== before.outcome) view.unmark();
    if (regionCount(state) !== regionCount(before)) view.showAllRegions();
    const failed =
      state.outcome !== before.outcome && state.outcome?.result.report.status === "invalid-input";
    if (failed) shell.setState({ bottomTab: "problems" });
  });
  return {
    documents,
    mesher,
    view,
    run,
    previews,
    problems,
    autosave,
    shell,
    gallery,
    meshQueries: new MeshQueryClient(),
    viewer: createStore<{ readonly viewer: Viewer | null }>(() => ({ viewer: null })),
    file: { handle: null },
    still,
  };
}
