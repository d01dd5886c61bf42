import { meshKey } from "../document/content-keys";
import { groupTints } from "../document/groups";
import type { ViewStore } from "../document/selection";
import { defectsOf } from "../document/validate";
import type { BodyFeed } from "../session/bodies";
import { derived, type Read, type Readable } from "../session/derived";
import { settledProject, type DocumentState, type DocumentStore } from "../session/document-store";
import type { PreviewFeed } from "../session/preview";
import type { ProblemList } from "../session/problems";
import type { MeshRun } from "../session/run";
import { isOfOtherBodies, isStale, type RunState } from "../session/run-state";
import type { SizeFeed } from "../session/size-feed";
import type { Solutions } from "../session/solutions";
import type { SmoothnessFeed } from "../session/smoothness-feed";
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
  readonly smoothness: SmoothnessFeed;
  readonly solutions: Solutions;
}

/** What the viewer shows of the stores, in parts that change together. */
const partsOf = (stores: SessionStores) =>
  ({
    project: derived((read) => projectState(stores, read)),
    preview: derived((read) => previewState(stores, read)),
    run: derived((read) => runState(stores, read)),
    problems: problemsOf(stores),
    sizes: derived((read) => ({ shownSizes: read(stores.sizes.state).shown })),
    field: derived((read) => fieldState(stores, read)),
    smoothness: derived((read) => ({ shownSmoothness: read(stores.smoothness.state).shown })),
  }) as const;

/** Returns the state of the stores as the viewer shows it. */
export function shownState(stores: SessionStores): ShownState {
  const { project, preview, run, problems, sizes, smoothness, field } = partsOf(stores);
  return {
    ...stores.view.state.getState(),
    ...project.getState(),
    ...preview.getState(),
    ...run.getState(),
    ...problems.getState(),
    ...sizes.getState(),
    ...smoothness.getState(),
    ...field.getState(),
    isReplaying: false,
  };
}

/** Shows every change of the stores. Returns a function that ends this. */
export function followSession(stores: SessionStores, viewer: Viewer): () => void {
  const parts: readonly Readable<Partial<ShownState>>[] = [
    stores.view.state,
    ...Object.values(partsOf(stores)),
  ];
  const stops = parts.map((part) => part.subscribe((state) => viewer.show(state)));
  return () => stops.forEach((stop) => stop());
}

function projectState({ documents, bodies, run }: SessionStores, read: Read) {
  const { project } = read(documents.state).history.present;
  read(bodies.state);
  return {
    project,
    bodies: shownBodies(project, bodies),
    tints: groupTints(project),
    ...agreementOf(read(run.state), read(documents.state)),
  };
}

/** How the mesh agrees with the project. */
const agreementOf = (run: RunState, document: DocumentState) => ({
  isMeshStale: isStale(run, document),
  isMeshOfOthers: isOfOtherBodies(run, document),
});

function previewState({ previews }: SessionStores, read: Read): { readonly preview: SampledProject | null } {
  const { preview, project } = read(previews.state);
  return { preview: preview && project && { samples: preview, project } };
}

function fieldState({ solutions }: SessionStores, read: Read) {
  const { shown, shapes } = read(solutions.state);
  return { shownField: shown, hasIsosurface: shown?.isPerElement === false && shapes.isosurface !== null };
}

function runState({ documents, run }: SessionStores, read: Read) {
  const state = read(run.state);
  const { mesh, outcome, front, unoptimized } = state;
  const agreement = agreementOf(state, read(documents.state));
  return { mesh, ...agreement, checkedSurface: outcome?.result.mesh ?? null, front, unoptimized };
}

/** Problems of the last mesh are shown otherwise than those of a drawing that is not finished. */
function problemsOf({ problems, run, documents }: SessionStores) {
  const isMeshed = derived((read) => {
    const { outcome } = read(run.state);
    return outcome?.key === meshKey(settledProject(read(documents.state)));
  });
  return derived((read) => ({ defects: defectsOf(read(problems.state).problems, read(isMeshed)) }));
}
