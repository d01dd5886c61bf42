import { meshKey } from "../document/content-keys";
import { groupTints } from "../document/groups";
import type { ViewStore } from "../document/selection";
import { defectsOf } from "../document/validate";
import type { BodyFeed } from "../session/bodies";
import type { DocumentStore } from "../session/document-store";
import type { PreviewFeed } from "../session/preview";
import type { ProblemList } from "../session/problems";
import { isOfOtherBodies, isStale, type MeshRun } from "../session/run";
import type { SizeFeed } from "../session/size-feed";
import type { SampledProject, ShownState } from "./scene-state";
import { shownBodies } from "./shown-bodies";
import type { Viewer } from "./viewer";

/** The stores that the viewer shows. */
export interface SessionStores {
  readonly documents: DocumentStore;
  readonly previews: PreviewFeed;
  readonly bodies: BodyFeed;
  readonly problems: ProblemList;
  readonly run: MeshRun;
  readonly view: ViewStore;
  readonly sizes: SizeFeed;
}

/** Returns the state of the stores as the viewer shows it. */
export function shownState(stores: SessionStores): ShownState {
  return {
    ...stores.view.state.getState(),
    ...projectState(stores),
    ...previewState(stores),
    ...runState(stores),
    ...problemState(stores),
    ...sizeState(stores),
    isReplaying: false,
  };
}

/** Shows every change of the stores. Returns a function that ends this. */
export function followSession(stores: SessionStores, viewer: Viewer): () => void {
  const stops = [
    stores.documents.state.subscribe(() => viewer.show(projectState(stores))),
    stores.bodies.state.subscribe(() => viewer.show(projectState(stores))),
    stores.previews.state.subscribe(() => viewer.show(previewState(stores))),
    stores.run.state.subscribe(() => viewer.show(runState(stores))),
    stores.problems.state.subscribe(() => viewer.show(problemState(stores))),
    stores.view.state.subscribe((state) => viewer.show(state)),
    stores.sizes.state.subscribe(() => viewer.show(sizeState(stores))),
  ];
  return () => stops.forEach((stop) => stop());
}

function projectState({ documents, bodies, run }: SessionStores) {
  const { project } = documents;
  return {
    project,
    bodies: shownBodies(project, bodies),
    tints: groupTints(project),
    ...agreementOf(run, documents),
  };
}

/** How the mesh agrees with the project. */
function agreementOf(run: MeshRun, documents: DocumentStore) {
  const [state, document] = [run.state.getState(), documents.state.getState()];
  return { isMeshStale: isStale(state, document), isMeshOfOthers: isOfOtherBodies(state, document) };
}

function previewState({ previews }: SessionStores): { readonly preview: SampledProject | null } {
  const { preview, project } = previews.state.getState();
  return { preview: preview && project && { samples: preview, project } };
}

function runState({ documents, run }: SessionStores) {
  const state = run.state.getState();
  return {
    mesh: state.mesh,
    ...agreementOf(run, documents),
    checkedSurface: state.outcome?.result.mesh ?? null,
    front: state.front,
    unoptimized: state.unoptimized,
  };
}

function problemState({ problems, run, documents }: SessionStores) {
  const isMeshed = run.state.getState().outcome?.key === meshKey(documents.project);
  return { defects: defectsOf(problems.state.getState().problems, isMeshed) };
}

function sizeState({ sizes }: SessionStores) {
  return { shownSizes: sizes.state.getState().shown };
}
