import type { Mesher, MeshResult, PreparedBody, CallProgress } from "tetrafront";
import type { Project } from "tetrafront/project";
import { createStore, type StoreApi } from "zustand/vanilla";
import { meshKey, placedSurfacesKey, shownMeshKey, versionedKey } from "../document/content-keys";
import type { DocumentContent } from "../document/edit";
import { engineInput } from "../document/engine-input";
import { bodiesOf, bodyLabel } from "../document/entities";
import { formatCount } from "../strings/format";
import { logStrings, phaseNames, preparedText, stepNames } from "../strings";
import {
  newDocumentId,
  settledContent,
  settledProject,
  type DocumentState,
  type DocumentStore,
} from "./document-store";
import { failureText } from "./failure-text";
import { KeptMeshes } from "./kept-meshes";
import { diagnosticText, type LogLevel, noteText, type RunNote, sizeOf, summary, withLine } from "./run-log";
import { canImprove, emptyRun, isStale, type RunOutcome, type RunState } from "./run-state";
import { TimeLeft } from "tetrafront/internal";
import { improvedMesh, reasonsOf, shownParts, type Improvement, type ShownMesh } from "./shown-mesh";

/** How an improvement has ended. */
export type ImprovementEnd =
  | { readonly kind: "shown"; readonly improvement: Improvement | null }
  /** The model has changed meanwhile. */
  | { readonly kind: "discarded" }
  | { readonly kind: "failed"; readonly reasons: readonly string[] };

/** The triangles of bodies that are known, and where a run leaves those that it makes. */
export interface PreparedBodies {
  /** Returns those that a run of the project can use. */
  readonly allOf: (project: Project) => readonly PreparedBody[];
  readonly keep: (project: Project, prepared: PreparedBody) => void;
}

/**
 * Changes the model before a run meshes it. Calls `onPart` with what it does next, and with its progress from 0 to 1 if it takes long. Returns what was done, for the log; null if
 * the model must not be meshed. Rejects if it is aborted.
 */
export type RunPreparation = (control: {
  readonly signal: AbortSignal;
  readonly onPart: (text: string, fraction?: number) => void;
}) => Promise<readonly RunNote[] | null>;

/** What work on the shown mesh gets. */
export interface WorkControl {
  readonly mesher: Mesher;
  readonly signal: AbortSignal;
  /** Reports what is done next, and how much of the work is done, 0 to 1. */
  readonly onPart: (text: string, fraction: number) => void;
  /** Shows another mesh of the same model, unless the user has gone to another step of undo or another document. */
  readonly show: (shown: ShownMesh) => void;
}

/** Who has asked for a run. Only the runs of the user are steps of undo. */
export type RunOrigin = "user" | "app";

/** Meshes with more tetrahedra are not kept, to limit memory, unless no run can make them again. */
const maxKeptTetrahedra = 400_000;

/**
 * Time between two updates of the progress on the page: a fraction of the elapsed time, within limits in seconds.
 * Without graphics hardware, each update takes time from the mesher.
 */
const progressWait = { share: 0.04, min: 0.1, max: 1 };

/** Share of a run that preparing bodies takes, about. */
const maxPreparedShare = 0.4;

const madeByRun = { origin: null, improvement: null, edgeReference: "target", isValid: null } as const;

const nameOfBody = (project: Project, id: number): string => {
  const body = bodiesOf(project).find((one) => one.id === id);
  return body ? bodyLabel(body) : "";
};

const isShowable = ({ mesh }: MeshResult): boolean => mesh.tetrahedra.length > 0 || mesh.triangles.length > 0;

/** A run under way. It is cancelled, and changes the state no longer, once its document has been left. */
class ActiveRun {
  readonly signal: AbortSignal;
  readonly isLeft: () => boolean;
  readonly timeLeft = new TimeLeft();
  /** Seconds that were spent on the model before the mesher began. */
  preparedSeconds = 0;
  readonly #abort = new AbortController();
  readonly #state: StoreApi<RunState>;

  constructor(state: StoreApi<RunState>, left: AbortSignal) {
    this.#state = state;
    this.isLeft = () => left.aborted;
    this.signal = AbortSignal.any([left, this.#abort.signal]);
  }

  set(change: Partial<RunState> | ((state: RunState) => Partial<RunState>)): void {
    if (!this.isLeft()) this.#state.setState(change);
  }

  cancel(): void {
    this.set({ cancelling: true });
    this.#abort.abort();
  }
}

/** Meshes the project of the document, one run at a time, and keeps the results. Shows nothing that was made for another document. */
export class MeshRun {
  readonly state: StoreApi<RunState> = createStore<RunState>(() => emptyRun);
  readonly #documents: DocumentStore;
  readonly #mesher: Promise<Mesher>;
  readonly #kept: KeptMeshes;
  /** The run of the present document; null without one. */
  #active: ActiveRun | null = null;
  /** Resolves when the last run has ended, that of another document too. */
  #running: Promise<void> = Promise.resolve();

  readonly #preparations: PreparedBodies;

  constructor(
    documents: DocumentStore,
    mesher: Promise<Mesher>,
    preparations: PreparedBodies = { allOf: () => [], keep: () => undefined },
  ) {
    this.#documents = documents;
    this.#mesher = mesher;
    this.#preparations = preparations;
    this.#kept = new KeptMeshes(documents.state.getState().id);
    documents.state.subscribe(({ id }, before) => {
      if (id !== before.id) this.#kept.open(id, before.id);
    });
    documents.onSettled((content) => this.#showCached(content));
    documents.onLeave(() => {
      this.#active = null;
      this.state.setState(emptyRun);
    });
  }

  /** Meshes the current project, unless a run is active. Resolves when the run has ended. */
  generate(by: RunOrigin = "user", prepare?: RunPreparation): Promise<void> {
    if (!this.#active) this.#running = this.#generate(by, prepare, this.#running);
    return this.#running;
  }

  async #generate(by: RunOrigin, prepare: RunPreparation | undefined, earlier: Promise<void>): Promise<void> {
    const run = this.#begin("mesh");
    try {
      const notes = prepare ? await this.#prepared(run, prepare) : [];
      if (notes && !run.isLeft()) await this.#mesh(run, by, notes, earlier);
    } finally {
      this.#end(run);
    }
  }

  /** Prepares the model. Returns null if it must not be meshed. */
  async #prepared(run: ActiveRun, prepare: RunPreparation): Promise<readonly RunNote[] | null> {
    const began = performance.now();
    // A part may have begun before the run.
    let first: number | null = null;
    const onPart = (preparing: string, fraction?: number): void => {
      if (fraction === undefined) return run.set({ preparing });
      first ??= fraction;
      run.set({ preparing, preparedShare: maxPreparedShare * Math.max(0, fraction - first) });
    };
    try {
      return await prepare({ signal: run.signal, onPart });
    } catch (error) {
      if (run.signal.aborted) this.#log(run, 0, "warning", logStrings.cancelledBefore);
      else this.#fail(run, error, 0);
      return null;
    } finally {
      run.preparedSeconds = (performance.now() - began) / 1000;
      run.set({ preparing: null });
    }
  }

  async #mesh(
    run: ActiveRun,
    by: RunOrigin,
    notes: readonly RunNote[],
    earlier: Promise<void>,
  ): Promise<void> {
    const project = settledProject(this.#documents.state.getState());
    // Use the time that the run reports: a busy page receives progress messages late.
    let elapsedSeconds = 0;
    let expectedTetrahedra = 0;
    const log = (level: LogLevel, text: string): void => this.#log(run, elapsedSeconds, level, text);
    log("information", logStrings.meshing(project.name));
    for (const note of notes) log(note.level, noteText(note));
    const warnings = notes.filter(({ level }) => level === "warning");
    try {
      const [input, options] = engineInput(project);
      const preparedBodies = this.#preparations.allOf(project);
      const logBody = (prepared: PreparedBody): void =>
        log("information", preparedText(nameOfBody(project, prepared.body), prepared));
      preparedBodies.forEach(logBody);
      const [mesher] = await Promise.all([this.#mesher, earlier]);
      const result = await mesher.meshProject(
        input,
        { ...options, ...(preparedBodies.length > 0 && { preparedBodies }) },
        {
          signal: run.signal,
          onProgress: (progress) => {
            ({ elapsedSeconds, expectedTetrahedra } = progress);
            if (!run.isLeft()) this.#report(run, progress, log);
          },
          onBody: (prepared) => {
            logBody(prepared);
            this.#preparations.keep(project, prepared);
          },
          onFront: (front) => run.set({ front }),
          onUnoptimized: (mesh) => run.set({ unoptimized: { mesh }, front: null }),
        },
      );
      if (run.isLeft()) return;
      elapsedSeconds = result.report.seconds.total;
      const key = meshKey(project);
      this.#finish(project, { result, expectedTetrahedra, warnings }, log);
      await this.#documents.afterGesture();
      if (isShowable(result) && !run.isLeft()) this.#replaceVersion(key, by);
    } catch (error) {
      this.#fail(run, error, elapsedSeconds);
    }
  }

  #fail(run: ActiveRun, error: unknown, seconds: number): void {
    const failure = failureText(error);
    run.set({ failure });
    this.#log(run, seconds, "error", failure);
  }

  #begin(task: RunState["task"]): ActiveRun {
    const run = new ActiveRun(this.state, this.#documents.left);
    this.#active = run;
    const begun = { cancelling: false, progress: null, preparedShare: 0, secondsLeft: null, failure: null };
    this.state.setState({ busy: true, task, ...begun, log: [] });
    return run;
  }

  #end(run: ActiveRun): void {
    if (this.#active === run) this.#active = null;
    const ended = { busy: false, preparing: null, cancelling: false, progress: null, secondsLeft: null };
    run.set({ ...ended, preparedShare: 0, front: null, unoptimized: null });
  }

  /**
   * Improves the elements of the shown mesh as one step of undo. A cancelled improvement keeps what it has reached.
   * Returns null if no mesh can be improved now, or another document has been opened meanwhile.
   */
  async improve(): Promise<ImprovementEnd | null> {
    const state = this.state.getState();
    const { mesh } = state;
    if (this.#active || !mesh || !canImprove(state, this.#documents.state.getState())) return null;
    const improving = this.#improve(shownParts({ ...state, mesh }), this.#running);
    this.#running = improving.then(() => undefined);
    return improving;
  }

  async #improve(before: ShownMesh, earlier: Promise<void>): Promise<ImprovementEnd | null> {
    const run = this.#begin("improve");
    let elapsedSeconds = 0;
    const log = (level: LogLevel, text: string): void => this.#log(run, elapsedSeconds, level, text);
    const document = this.#documents.state.getState();
    const { project } = settledContent(document);
    log("information", logStrings.improving(formatCount(before.mesh.report.tetrahedra)));
    try {
      const { optimization = "default" } = project.meshing ?? {};
      const [mesher] = await Promise.all([this.#mesher, earlier]);
      const after = await improvedMesh(mesher, before, optimization, {
        signal: run.signal,
        onProgress: (progress) => {
          elapsedSeconds = progress.elapsedSeconds;
          this.#showProgress(run, progress);
        },
      });
      await this.#documents.afterGesture();
      if (run.isLeft()) return null;
      if (!this.#finishImprovement(document, before, after)) {
        log("warning", logStrings.improvementDiscarded);
        return { kind: "discarded" };
      }
      if (after.improvement) log("success", logStrings.improved(after.improvement));
      return { kind: "shown", improvement: after.improvement };
    } catch (error) {
      if (run.isLeft()) return null;
      const reasons = reasonsOf(error);
      for (const reason of reasons) log("error", reason);
      return { kind: "failed", reasons };
    } finally {
      this.#end(run);
    }
  }

  /** Shows a better mesh, unless the model has changed since `document`. Returns whether it is shown. */
  #finishImprovement(document: DocumentState, before: ShownMesh, after: ShownMesh): boolean {
    const { history } = this.#documents.state.getState();
    const key = shownMeshKey(settledContent(document));
    if (shownMeshKey(history.present) !== key) return false;
    if (after.mesh === before.mesh) {
      this.state.setState({ improvement: after.improvement });
      return true;
    }
    this.#kept.add(key, before);
    this.#documents.setMeshVersion(stepNames.improve, this.keep(history.present.project, after));
    return true;
  }

  /**
   * Does long work that makes other meshes of the model, unless a run is active or the shown mesh is out of date. The mesh that it returns is shown as one step of
   * undo, unless the model has changed meanwhile; null shows the mesh before. Returns whether it is shown. Rejects as the work does,
   * also when it is cancelled.
   */
  async adapt(work: (control: WorkControl) => Promise<ShownMesh | null>): Promise<boolean> {
    const state = this.state.getState();
    const { mesh } = state;
    if (this.#active || !mesh || isStale(state, this.#documents.state.getState())) return false;
    const adapting = this.#adapt(shownParts({ ...state, mesh }), work, this.#running);
    this.#running = adapting.then(
      () => undefined,
      () => undefined,
    );
    return adapting;
  }

  async #adapt(
    before: ShownMesh,
    work: (control: WorkControl) => Promise<ShownMesh | null>,
    earlier: Promise<void>,
  ): Promise<boolean> {
    const run = this.#begin("adapt");
    const document = this.#documents.state.getState();
    const key = shownMeshKey(settledContent(document));
    const began = performance.now();
    const show = (other: ShownMesh): void => {
      const { mesh, meshKey: shownKey } = this.state.getState();
      if (!run.isLeft() && mesh && shownKey === key) this.exchange(mesh, shownParts(other));
    };
    let made: ShownMesh | null;
    try {
      const [mesher] = await Promise.all([this.#mesher, earlier]);
      const onPart = (preparing: string, preparedShare: number): void =>
        run.set({ preparing, preparedShare });
      made = await work({ mesher, signal: run.signal, onPart, show });
      await this.#documents.afterGesture();
    } finally {
      // The work may have shown other meshes.
      show(before);
      this.#end(run);
    }
    const { history } = this.#documents.state.getState();
    if (run.isLeft() || made === null || made.mesh === before.mesh) return false;
    if (shownMeshKey(history.present) !== key) {
      this.#log(run, (performance.now() - began) / 1000, "warning", logStrings.adaptationDiscarded);
      return false;
    }
    this.#kept.add(key, before);
    this.#documents.setMeshVersion(stepNames.adapt, this.keep(history.present.project, made));
    this.#log(run, (performance.now() - began) / 1000, "success", logStrings.adapted(sizeOf(made.mesh)));
    return true;
  }

  /** Begins the log of a document with the file of its mesh. */
  logOpening(): void {
    const { mesh, origin } = this.state.getState();
    if (mesh && origin)
      this.state.setState({
        log: withLine([], {
          seconds: 0,
          level: "information",
          text: logStrings.opened(origin.fileName, sizeOf(mesh)),
        }),
      });
  }

  /** Keeps a mesh that no run makes. Returns its key: it is shown while it is that of the document. */
  keep(project: Project, shown: ShownMesh): string {
    const key = versionedKey(meshKey(project), newDocumentId());
    this.#kept.add(key, shown);
    return key;
  }

  /**
   * Shows another form of the shown mesh, or another mesh of the same work, as the same step of undo; nothing if another mesh is
   * shown by now.
   */
  exchange(before: MeshResult, after: Pick<ShownMesh, "mesh"> & Partial<ShownMesh>): void {
    const { mesh, outcome } = this.state.getState();
    if (mesh !== before || mesh === after.mesh) return;
    const isOfOutcome = outcome?.result === before;
    this.state.setState({ ...after, outcome: isOfOutcome ? { ...outcome, result: after.mesh } : outcome });
  }

  cancel(): void {
    this.#active?.cancel();
  }

  #report(run: ActiveRun, progress: CallProgress, log: (level: LogLevel, text: string) => void): void {
    const before = this.state.getState().progress;
    if (before?.phase !== progress.phase) {
      if (before?.phase === "surface")
        log("information", logStrings.boundaryTriangles(formatCount(progress.triangles)));
      log("information", phaseNames[progress.phase]);
    }
    this.#showProgress(run, progress);
  }

  #showProgress(run: ActiveRun, progress: CallProgress): void {
    if (!isDue(this.state.getState().progress, progress)) return;
    const { preparedShare } = this.state.getState();
    const fraction = preparedShare + (1 - preparedShare) * progress.fraction;
    const secondsLeft = run.timeLeft.add(fraction, run.preparedSeconds + progress.elapsedSeconds);
    run.set({ progress: { ...progress, fraction }, secondsLeft });
  }

  #finish(
    project: Project,
    ended: Omit<RunOutcome, "key">,
    log: (level: LogLevel, text: string) => void,
  ): void {
    const key = meshKey(project);
    const { result } = ended;
    const { report } = result;
    for (const diagnostic of report.diagnostics) log(diagnostic.severity, diagnosticText(diagnostic));
    log(report.status === "done" ? "success" : "warning", summary(ended));
    this.state.setState({ outcome: { ...ended, key } });
    if (!isShowable(result)) return;
    const shown: ShownMesh = { ...madeByRun, mesh: result };
    const meshedBodies = placedSurfacesKey(bodiesOf(project));
    this.state.setState({ ...shown, meshKey: key, meshedBodies, front: null, unoptimized: null });
    if (report.status === "done" && report.tetrahedra <= maxKeptTetrahedra)
      this.#kept.add(key, shown, ended.warnings);
  }

  /** A new mesh replaces one that was opened or improved, as a step of undo if the user has asked for it. */
  #replaceVersion(key: string, by: RunOrigin): void {
    const content = settledContent(this.#documents.state.getState());
    if (meshKey(content.project) !== key || shownMeshKey(content) === key) return;
    if (by === "app") this.#documents.forgetMeshVersion();
    else this.#documents.setMeshVersion(stepNames.generate, null);
  }

  #showCached(content: DocumentContent): void {
    const key = shownMeshKey(content);
    const kept = this.#kept.show(key);
    if (!kept) return;
    const { shown, warnings } = kept;
    const meshedBodies = placedSurfacesKey(bodiesOf(content.project));
    const outcome = { key, result: shown.mesh, expectedTetrahedra: 0, warnings };
    this.state.setState({ ...shown, meshKey: key, meshedBodies, outcome, failure: null });
  }

  #log(run: ActiveRun, seconds: number, level: LogLevel, text: string): void {
    run.set(({ log }) => ({ log: withLine(log, { seconds, level, text }) }));
  }
}

/** Returns whether to show the progress again. A new phase is shown at once. */
function isDue(before: CallProgress | null, { phase, elapsedSeconds }: CallProgress): boolean {
  if (before?.phase !== phase) return true;
  const { share, min, max } = progressWait;
  return elapsedSeconds - before.elapsedSeconds >= Math.min(max, Math.max(min, share * elapsedSeconds));
}
