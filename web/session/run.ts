import type { Mesher, MeshResult, PreparedBody, Progress, Project, UnoptimizedMesh } from "tetrafront";
import { createStore, type StoreApi } from "zustand/vanilla";
import { meshKey } from "../document/content-keys";
import { engineInput } from "../document/engine-input";
import { logStrings, phaseNames, remedyInApp } from "../strings";
import { settledProject, type DocumentState, type DocumentStore } from "./document-store";
import { failureText } from "./failure-text";

export type LogLevel = "information" | "success" | "warning" | "error";

export interface LogLine {
  readonly id: number;
  /** Seconds since the run began. */
  readonly seconds: number;
  readonly level: LogLevel;
  readonly text: string;
}

export interface RunState {
  readonly busy: boolean;
  /** True from the cancel command until the run has ended. */
  readonly cancelling: boolean;
  readonly progress: Progress | null;
  /**
   * Faces of the front while a run advances it, x y z of three corners each. The last ones stay until a mesh replaces
   * them; null before the first snapshot and without a run.
   */
  readonly front: Float64Array | null;
  /** The mesh that a run is optimizing; null before its front has closed, and without a run. */
  readonly unoptimized: UnoptimizedMesh | null;
  /** The shown mesh, which may belong to another state of the project. */
  readonly mesh: MeshResult | null;
  /** Key of the project that `mesh` was made from. */
  readonly meshKey: string | null;
  /** Result of the last run. Unlike `mesh`, it may hold diagnostics only. */
  readonly outcome: { readonly key: string; readonly result: MeshResult } | null;
  /** The engine itself failed, e.g. could not be loaded or ran out of memory. */
  readonly failure: string | null;
  readonly log: readonly LogLine[];
}

const emptyRun: RunState = {
  busy: false,
  cancelling: false,
  progress: null,
  front: null,
  unoptimized: null,
  mesh: null,
  meshKey: null,
  outcome: null,
  failure: null,
  log: [],
};

/** Number of meshes kept, so that undo restores the old mesh at once. */
const cachedMeshes = 4;
/** Meshes with more tetrahedra are not kept, to limit memory. */
const maxCachedTetrahedra = 400_000;
const maxLogLines = 400;
/**
 * Time between two updates of the progress on the page: a fraction of the elapsed time, within limits in seconds.
 * Without graphics hardware, each update takes time from the mesher.
 */
const progressWait = { share: 0.04, min: 0.1, max: 1 };

const count = (value: number): string => value.toLocaleString("en-US");

/** Meshes the project of the document, one run at a time, and keeps the results. */
export class MeshRun {
  readonly state: StoreApi<RunState> = createStore<RunState>(() => emptyRun);
  readonly #documents: DocumentStore;
  readonly #mesher: Promise<Mesher>;
  readonly #cache = new Map<string, MeshResult>();
  #abort: AbortController | null = null;
  #running: Promise<void> = Promise.resolve();
  #lastLogId = 0;

  /** Returns the triangles of bodies that are already made. */
  readonly #preparedOf: (project: Project) => readonly PreparedBody[];

  constructor(
    documents: DocumentStore,
    mesher: Promise<Mesher>,
    preparedOf: (project: Project) => readonly PreparedBody[] = () => [],
  ) {
    this.#documents = documents;
    this.#mesher = mesher;
    this.#preparedOf = preparedOf;
    documents.onSettled((project) => this.#showCached(meshKey(project)));
  }

  /** Meshes the current project, unless a run is active. Resolves when the run has ended. */
  generate(): Promise<void> {
    if (!this.#abort) this.#running = this.#mesh();
    return this.#running;
  }

  async #mesh(): Promise<void> {
    const abort = new AbortController();
    this.#abort = abort;
    const project = settledProject(this.#documents.state.getState());
    this.state.setState({ busy: true, cancelling: false, progress: null, failure: null, log: [] });
    // Use the time that the run reports: a busy page receives progress messages late.
    let elapsedSeconds = 0;
    const log = (level: LogLevel, text: string): void => this.#log(elapsedSeconds, level, text);
    log("information", logStrings.meshing(project.name));
    try {
      const [input, options] = engineInput(project);
      const preparedBodies = this.#preparedOf(project);
      const mesher = await this.#mesher;
      const result = await mesher.meshProject(
        input,
        { ...options, ...(preparedBodies.length > 0 && { preparedBodies }) },
        {
          signal: abort.signal,
          onProgress: (progress) => {
            elapsedSeconds = progress.elapsedSeconds;
            this.#report(progress, log);
          },
          onFront: (front) => this.state.setState({ front }),
          onUnoptimized: (unoptimized) => this.state.setState({ unoptimized, front: null }),
        },
      );
      elapsedSeconds = result.report.seconds.total;
      this.#finish(meshKey(project), result, log);
    } catch (error) {
      const failure = failureText(error);
      this.state.setState({ failure });
      log("error", failure);
    } finally {
      this.#abort = null;
      const ended = { busy: false, cancelling: false, progress: null, front: null, unoptimized: null };
      this.state.setState(ended);
    }
  }

  /** Hides the mesh and the log if they belong to another state of the document. */
  forgetOthers(): void {
    const key = meshKey(settledProject(this.#documents.state.getState()));
    const { mesh, outcome } = this.state.getState();
    if (mesh && this.state.getState().meshKey !== key) this.state.setState({ mesh: null, meshKey: null });
    if (outcome && outcome.key !== key) this.state.setState({ outcome: null, failure: null, log: [] });
  }

  /** Cancels the active run and meshes the current project. */
  async restart(): Promise<void> {
    this.cancel();
    await this.#running;
    await this.generate();
  }

  cancel(): void {
    if (!this.#abort) return;
    this.state.setState({ cancelling: true });
    this.#abort.abort();
  }

  #report(progress: Progress, log: (level: LogLevel, text: string) => void): void {
    const before = this.state.getState().progress;
    if (before?.phase !== progress.phase) {
      if (before?.phase === "surface")
        log("information", logStrings.boundaryTriangles(count(progress.triangles)));
      log("information", phaseNames[progress.phase]);
    }
    if (isDue(before, progress)) this.state.setState({ progress });
  }

  #finish(key: string, result: MeshResult, log: (level: LogLevel, text: string) => void): void {
    const { report } = result;
    for (const diagnostic of report.diagnostics) {
      log(
        diagnostic.severity,
        [diagnostic.message, remedyInApp(diagnostic)]
          .filter((part) => part !== "")
          .map(sentence)
          .join(" "),
      );
    }
    log(report.status === "done" ? "success" : "warning", summary(result));
    this.state.setState({ outcome: { key, result } });
    const showable = result.volume.tetrahedra.length > 0 || result.surface.triangles.length > 0;
    if (!showable) return;
    this.state.setState({ mesh: result, meshKey: key, front: null, unoptimized: null });
    if (report.status === "done" && report.tetrahedra <= maxCachedTetrahedra) this.#remember(key, result);
  }

  #remember(key: string, result: MeshResult): void {
    this.#cache.delete(key);
    this.#cache.set(key, result);
    const [oldest] = this.#cache.keys();
    if (this.#cache.size > cachedMeshes && oldest !== undefined) this.#cache.delete(oldest);
  }

  #showCached(key: string): void {
    const mesh = this.#cache.get(key);
    if (mesh) this.state.setState({ mesh, meshKey: key, outcome: { key, result: mesh }, failure: null });
  }

  #log(seconds: number, level: LogLevel, text: string): void {
    const line: LogLine = { id: ++this.#lastLogId, seconds, level, text };
    this.state.setState(({ log }) => ({ log: [...log, line].slice(-maxLogLines) }));
  }
}

/** Returns whether to show the progress again. A new phase is shown at once. */
function isDue(before: Progress | null, { phase, elapsedSeconds }: Progress): boolean {
  if (before?.phase !== phase) return true;
  const { share, min, max } = progressWait;
  return elapsedSeconds - before.elapsedSeconds >= Math.min(max, Math.max(min, share * elapsedSeconds));
}

function summary({ report }: MeshResult): string {
  const size = logStrings.size(count(report.tetrahedra), count(report.nodes));
  const seconds = `${report.seconds.total.toFixed(2)} s`;
  switch (report.status) {
    case "done":
      return logStrings.done(size, seconds, report.fingerprint);
    case "cancelled":
      return logStrings.cancelled(size, seconds);
    case "stalled":
      return logStrings.stalled(size, seconds);
    case "invalid-input":
      return logStrings.invalid;
  }
}

/** Adds a full stop, unless the text ends with a punctuation mark. */
const sentence = (text: string): string => (/[.!?…]$/.test(text) ? text : `${text}.`);

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
  const project = settledProject(document);
  return project !== document.history.present.project || run.meshKey !== meshKey(project);
}
