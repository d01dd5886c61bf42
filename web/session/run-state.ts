/** What a document's runs have made, and how the active one gets on. */
import type { MeshResult, CallProgress } from "tetrafront";
import { placedSurfacesKey, shownMeshKey } from "../document/content-keys";
import { bodiesOf } from "../document/entities";
import { settledContent, type DocumentState } from "./document-store";
import type { LogLine, RunNote } from "./run-log";
import type { ShownMesh } from "./shown-mesh";

export interface RunOutcome {
  readonly key: string;
  readonly result: MeshResult;
  /** Number of tetrahedra that the run expected; 0 if it ended before that, or if no run has made the mesh. */
  readonly expectedTetrahedra: number;
  /** Warnings of its preparation. */
  readonly warnings: readonly RunNote[];
}

export interface RunState {
  readonly busy: boolean;
  /** What the active run does, or the last one has done. */
  readonly task: "mesh" | "improve" | "adapt";
  /** What is done to the model before it is meshed; null while nothing is. */
  readonly preparing: string | null;
  /** Share of the run that was done to the model before it is meshed, 0 to 1. The progress of the mesher goes on from there. */
  readonly preparedShare: number;
  /** True from the cancel command until the run has ended. */
  readonly cancelling: boolean;
  readonly progress: CallProgress | null;
  /** How many seconds the active run still takes, about; null if it is not known. */
  readonly secondsLeft: number | null;
  /**
   * Faces of the front while a run advances it, x y z of three corners each. The last ones stay until a mesh replaces
   * them; null before the first snapshot and without a run.
   */
  readonly front: Float64Array | null;
  /** The mesh that a run is optimizing; null before its front has closed, and without a run. */
  readonly unoptimized: Pick<MeshResult, "mesh"> | null;
  /** The shown mesh, which may belong to another state of the project. */
  readonly mesh: MeshResult | null;
  /** As in `ShownMesh`; both null without a mesh. */
  readonly origin: ShownMesh["origin"];
  readonly improvement: ShownMesh["improvement"];
  readonly edgeReference: ShownMesh["edgeReference"];
  readonly isValid: ShownMesh["isValid"];
  /** Key of the content that `mesh` belongs to. */
  readonly meshKey: string | null;
  /** Key of the bodies that `mesh` was made of. */
  readonly meshedBodies: string | null;
  /** Result of the last run. Unlike `mesh`, it may hold diagnostics only. */
  readonly outcome: RunOutcome | null;
  /** The engine itself failed, e.g. could not be loaded or ran out of memory. */
  readonly failure: string | null;
  readonly log: readonly LogLine[];
}

/** The state before the first run of a document. */
export const emptyRun: RunState = {
  busy: false,
  task: "mesh",
  preparing: null,
  preparedShare: 0,
  cancelling: false,
  progress: null,
  secondsLeft: null,
  front: null,
  unoptimized: null,
  mesh: null,
  origin: null,
  improvement: null,
  edgeReference: "target",
  isValid: null,
  meshKey: null,
  meshedBodies: null,
  outcome: null,
  failure: null,
  log: [],
};

/** Returns the number of regions of the shown mesh; 0 before it is finished. */
export function regionCount({ mesh }: RunState): number {
  return mesh?.report.quality.regions.length ?? 0;
}

/**
 * Returns whether the shown mesh was made from another state of the document. During a gesture, no key is
 * computed.
 */
export function isStale(run: RunState, document: DocumentState): boolean {
  if (run.mesh === null) return false;
  const content = settledContent(document);
  return content.project !== document.history.present.project || run.meshKey !== shownMeshKey(content);
}

/**
 * Returns whether the shown mesh is out of date because the project has other bodies, or has them elsewhere. The view then
 * shows the bodies instead.
 */
export function isOfOtherBodies({ mesh, meshedBodies }: RunState, document: DocumentState): boolean {
  return mesh !== null && meshedBodies !== placedSurfacesKey(bodiesOf(document.history.present.project));
}

/**
 * Returns whether the elements of the shown mesh can be improved: it is finished and up to date, and not stretched, because
 * an improvement measures in space.
 */
export function canImprove(run: RunState, document: DocumentState): boolean {
  const { report, metricShapes } = run.mesh ?? {};
  if (metricShapes) return false;
  return !run.busy && report?.status === "done" && report.tetrahedra > 0 && !isStale(run, document);
}
