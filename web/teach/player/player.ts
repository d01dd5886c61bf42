import type { Mesher, CallProgress } from "tetrafront";
import type { Trace } from "tetrafront/trace";
import { createStore, type StoreApi } from "zustand/vanilla";
import { settledProject, type DocumentStore } from "../../session/document-store";
import { failureText } from "../../session/failure-text";
import type { MeshRun } from "../../session/run";
import { beatsOf, knownBeat, playsBeats, usualBeats } from "./beats";
import { entityLabels, type EntityLabels } from "./entity-labels";
import type { FrontColoring } from "./front-values";
import type { Loop } from "./loop";
import { firstState, phaseEnd, phaseStart } from "./phases";
import { Playback } from "./playback";
import { recordProject, type PreparedOf, type Recorded, type RecordingChoices } from "./recording";
import { nextStop, refusedIn, type Stop } from "./stops";

/** Which faces of the front are drawn: all, or those that look towards the eye, as seen from the empty volume. */
export const frontFaces = ["inside", "all"] as const;
export type FrontFaces = (typeof frontFaces)[number];
/** Which elements are drawn besides the front: `all` and `cut`, as soon as the front is at rest, what they fill, whole or cut open. */
export const shownElements = ["none", "last", "recent", "all", "cut"] as const;
export type ShownElements = (typeof shownElements)[number];

export interface PlayerState {
  /** A recording that is under way. */
  readonly recording: { readonly progress: CallProgress | null; readonly isStopping: boolean } | null;
  /** Fraction of a trace that has been read, 0 to 1; null while none is read. */
  readonly reading: number | null;
  /** Why nothing was recorded or read last; null without a failure. */
  readonly failure: readonly string[] | null;
  /** The trace that the view shows; null if it shows the model and its mesh. */
  readonly trace: Trace | null;
  /** What lines and patches of the recorded model are called; null for a trace from a file. */
  readonly labels: EntityLabels | null;
  /** Whether the trace was opened from a file: it may belong to another model. */
  readonly isOpened: boolean;
  /** The trace as a file. */
  readonly file: Uint8Array<ArrayBuffer> | null;
  /** The state that is shown: the one after this step. Negative in lines and patches (phases.ts). */
  readonly step: number;
  /** The state that the lens shows: the same, or the one before while the user scrubs. */
  readonly lensStep: number;
  readonly isPlaying: boolean;
  /** Whether playing shows one picture per second, because the user prefers no motion. */
  readonly playsStills: boolean;
  /** Steps per second. */
  readonly speed: number;
  /** Playing repeats the steps from `from` to `to`; null: it ends with the trace. */
  readonly loop: Loop | null;
  /** Whether the user wants playing to pause at steps of the chosen kind. */
  readonly pausesThere: boolean;
  /** Playing pauses at these steps; null also while the condition has an error. */
  readonly stopAt: Stop | null;
  /** The text of a condition at which playing can pause; it may be wrong. */
  readonly condition: string;
  readonly coloring: FrontColoring;
  readonly faces: FrontFaces;
  readonly elements: ShownElements;
  /** Index of the candidate in the step that the lens shows; null: the one that decides the step. */
  readonly candidate: number | null;
  /** The candidate under the pointer or the focus, in the list or in the view; null: none. */
  readonly pointed: number | null;
  /** Whether a step at rest is shown as a film: beat by beat, and only what is near it. */
  readonly film: boolean;
  /** The beat of the step, from 1; null for the last one, the state after the step (beats.ts). */
  readonly beat: number | null;
  /** How far the elements of the filled volume are pulled apart, 0 to 1. */
  readonly apart: number;
  /** Position of the plane that cuts the elements open, 0 to 1: the share of the model behind it. */
  readonly cutAt: number;
  /** Whether the view shows the search region of the step. */
  readonly showsRegion: boolean;
  /**
   * The sweep of the optimizer whose mesh is shown, from 1; 0 for the mesh of the front; null if the front is shown.
   */
  readonly sweep: number | null;
  /** Whether the front is faded while the lens shows a step, without a film. */
  readonly fades: boolean;
  /** Whether the view follows the base face; until the user moves it. */
  readonly follows: boolean;
}

/** Speeds to choose from, in steps per second. */
export const speeds = [0.2, 1, 5, 25, 100, 500, 2500, 10_000] as const;
/** Steps of the keys that jump. */
export const jump = 100;

/** States that are shown within this time of each other, in milliseconds, are scrubbed or played: the lens waits for the last. */
const scrubbedMs = 250;
/**
 * Time after the last state until the lens shows it, in milliseconds: longer than two frames of a slow machine, because the
 * view then moves to the step, and this would slow down the states that follow.
 */
const settledMs = 300;

/** Seconds between two pictures of who prefers no motion: each has the steps that have become due. */
const stillSeconds = 1;
const prefersStills = (): boolean => matchMedia("(prefers-reduced-motion: reduce)").matches;

export const initialPlayerState: PlayerState = {
  recording: null,
  reading: null,
  failure: null,
  trace: null,
  labels: null,
  isOpened: false,
  file: null,
  step: 0,
  lensStep: 0,
  isPlaying: false,
  playsStills: false,
  speed: 25,
  loop: null,
  pausesThere: false,
  stopAt: null,
  condition: "",
  coloring: "age",
  faces: "inside",
  elements: "recent",
  candidate: null,
  pointed: null,
  film: true,
  beat: null,
  apart: 0,
  cutAt: 0.5,
  showsRegion: false,
  sweep: null,
  fades: true,
  follows: true,
};

export interface PlayerOptions {
  readonly documents: DocumentStore;
  readonly run: MeshRun;
  readonly mesher: Promise<Mesher>;
  readonly preparedOf: PreparedOf;
}

/** Records the front of the present model, and plays it. */
export class Player {
  readonly state: StoreApi<PlayerState> = createStore<PlayerState>(() => initialPlayerState);
  readonly #options: PlayerOptions;
  readonly #playback = new Playback((steps) => this.#advance(steps));
  /** Labels of the recorded traces. */
  readonly #labels = new WeakMap<Trace, EntityLabels>();
  #abort: AbortController | null = null;
  /** When a state was sought last. */
  #soughtAt = -Infinity;
  #settling: ReturnType<typeof setTimeout> | undefined;

  constructor(options: PlayerOptions) {
    this.#options = options;
    let { id } = options.documents.state.getState();
    options.documents.state.subscribe((state) => {
      if (state.id === id) return;
      id = state.id;
      this.#abandon();
    });
    // The view can show only one of them.
    options.run.state.subscribe(({ busy }, before) => {
      if (busy && !before.busy) this.#abandon();
    });
  }

  /**
   * Meshes the present model with the options of Generate mesh or those of `choices`, and shows the trace of its front.
   * Returns null if a recording is under way, or if another document, run or trace has ended this one.
   */
  async record(choices: RecordingChoices = {}): Promise<Recorded | null> {
    if (this.#abort) return null;
    const abort = (this.#abort = new AbortController());
    this.close();
    this.state.setState({ recording: { progress: null, isStopping: false }, failure: null });
    const { documents, mesher, preparedOf } = this.#options;
    const onProgress = (progress: CallProgress): void => {
      if (this.#abort !== abort) return;
      this.state.setState({ recording: { progress, isStopping: abort.signal.aborted } });
    };
    const project = settledProject(documents.state.getState());
    const control = { signal: abort.signal, onProgress };
    const recorded = await recordProject(await mesher, project, preparedOf, choices, control);
    // Another document was opened, or a run was started.
    if (this.#abort !== abort) return null;
    this.#abort = null;
    this.state.setState({ recording: null });
    if (recorded.kind === "failed") {
      this.state.setState({ failure: recorded.isStopped ? null : recorded.reasons });
      return recorded;
    }
    const trace = await this.#read(recorded.file);
    if (!trace) {
      const { failure } = this.state.getState();
      return failure && { kind: "failed", reasons: failure, isStopped: false };
    }
    this.#labels.set(trace, entityLabels(project));
    this.show(trace, recorded.file);
    return { ...recorded, trace };
  }

  /**
   * Shows a trace from a file, which may belong to another model. What is shown stays until the trace is read, and if it is
   * invalid. Does nothing during a recording.
   */
  async open(file: Uint8Array<ArrayBuffer>): Promise<void> {
    if (this.state.getState().recording) return;
    this.#endReading();
    this.pause();
    const trace = await this.#read(file);
    if (trace) this.#show(trace, file, true);
  }

  /** Stops reading a trace. What was shown before stays. */
  stopReading(): void {
    if (this.state.getState().reading !== null) this.#endReading();
  }

  /** Stops a recording. What it has recorded until then is shown. */
  stopRecording(): void {
    const { recording } = this.state.getState();
    if (!recording || !this.#abort) return;
    this.state.setState({ recording: { ...recording, isStopping: true } });
    this.#abort.abort();
  }

  /** Shows the model again. */
  close(): void {
    this.#playback.stop();
    const { recording, reading, speed, coloring, faces, elements, showsRegion } = this.state.getState();
    const { film, fades, follows, condition } = this.state.getState();
    this.state.setState({
      ...initialPlayerState,
      recording,
      reading,
      speed,
      coloring,
      faces,
      elements,
      showsRegion,
      film,
      fades,
      follows,
      condition,
    });
  }

  /**
   * Shows the state after a step; numbers out of range show the first or the last state. `isScrubbed`: others may follow at
   * once, so the lens waits for the last.
   */
  seek(step: number, isScrubbed = performance.now() - this.#soughtAt < scrubbedMs): void {
    const { trace, step: before } = this.state.getState();
    if (!trace) return;
    const to = Math.min(Math.max(firstState(trace), Math.round(step)), trace.stepCount);
    if (to === before) return;
    this.#soughtAt = performance.now();
    clearTimeout(this.#settling);
    if (isScrubbed) this.#settling = setTimeout(() => this.#settle(), settledMs);
    this.#showState(to, null, isScrubbed);
  }

  #showState(step: number, beat: number | null, isScrubbed: boolean): void {
    const shown = { step, beat, candidate: null, pointed: null, sweep: null, apart: 0 };
    this.state.setState({ ...shown, ...(!isScrubbed && { lensStep: step }) });
  }

  /** Shows a beat of the present step, and pauses. Null or a number beyond the last one: the state after the step. */
  showBeat(beat: number | null): void {
    this.pause();
    const { trace, step } = this.state.getState();
    if (trace) this.state.setState({ beat: knownBeat(trace, step, beat), pointed: null, sweep: null });
  }

  /** Shows steps as films, or as a whole. */
  setFilm(film: boolean): void {
    this.state.setState({ film, beat: null });
    if (this.state.getState().isPlaying) this.#start();
  }

  /** Shows the state after a step, and pauses. Others may follow at once, so the lens waits for the last. */
  scrub(step: number): void {
    this.#halt();
    this.seek(step, true);
  }

  /** Lets the lens show the present state. */
  #settle(): void {
    clearTimeout(this.#settling);
    const { step, lensStep } = this.state.getState();
    if (step !== lensStep) this.state.setState({ lensStep: step });
  }

  /** Moves by a number of steps, and pauses. Infinitely many lead to the first or last state of the phase. */
  move(steps: number): void {
    this.#halt();
    const { trace, step } = this.state.getState();
    if (!trace) return;
    if (Number.isFinite(steps)) this.seek(step + steps);
    else this.seek(steps < 0 ? phaseStart(trace, step) : phaseEnd(trace, step));
  }

  /** Moves to the nearest step of a kind or that meets a condition, and pauses. Returns whether there is one. */
  jump(stop: Stop, direction: 1 | -1): boolean {
    const { trace, step } = this.state.getState();
    if (!trace) return false;
    const found = nextStop(trace, step, direction, stop);
    if (found === null) return false;
    this.#halt();
    this.seek(found);
    this.#settle();
    this.state.setState({ candidate: refusedIn(trace, found, stop) });
    return true;
  }

  /** Chooses a candidate of the present step. Its verdict is not known before the beat of the test, so an earlier beat gives way to it. */
  choose(rank: number): void {
    const { trace, step, beat } = this.state.getState();
    const test = trace && beat !== null ? beatsOf(trace, step).indexOf("test") + 1 : 0;
    this.state.setState({ candidate: rank, ...(beat !== null && beat < test && { beat: test }) });
  }

  /** Plays from the present state; from the first one of the volume if the present one is the last. */
  play(): void {
    const { trace, step, loop, beat } = this.state.getState();
    if (!trace || trace.stepCount === firstState(trace)) return;
    const last = loop?.to ?? trace.stepCount;
    const isOver = step >= last && beat === null;
    if (isOver || (loop && step < loop.from)) this.seek(loop?.from ?? 0);
    this.state.setState({ isPlaying: true, playsStills: prefersStills() });
    this.#start();
  }

  pause(): void {
    this.#halt();
    this.#settle();
  }

  /** Ends playing; the lens shows the present state when it is due. */
  #halt(): void {
    this.#playback.stop();
    if (this.state.getState().isPlaying) this.state.setState({ isPlaying: false });
  }

  toggle(): void {
    if (this.state.getState().isPlaying) this.pause();
    else this.play();
  }

  setSpeed(speed: number): void {
    this.state.setState({ speed });
    if (this.state.getState().isPlaying) this.#start();
  }

  #start(): void {
    const { speed, playsStills } = this.state.getState();
    const isFilm = playsBeats(this.state.getState());
    // Fast playing knows no beats.
    if (!isFilm) this.state.setState({ beat: null });
    this.#playback.start(isFilm ? usualBeats * speed : speed, playsStills ? stillSeconds : 0);
  }

  /** Ends a recording or the reading of a trace without a result, and shows the model again. */
  #abandon(): void {
    this.#endReading();
    this.state.setState({ recording: null });
    this.close();
  }

  #endReading(): void {
    this.#abort?.abort();
    this.#abort = null;
    this.state.setState({ reading: null });
  }

  /** Reads a trace in slices. Returns null if it is invalid, or if the reading was ended. */
  async #read(file: Uint8Array<ArrayBuffer>): Promise<Trace | null> {
    const abort = (this.#abort = new AbortController());
    this.state.setState({ reading: 0, failure: null });
    const onProgress = (reading: number): void => {
      if (this.#abort === abort) this.state.setState({ reading });
    };
    const read = await import("tetrafront/trace")
      .then(({ loadTrace }) => loadTrace(file, { signal: abort.signal, onProgress }))
      .catch((error: unknown) => ({
        success: false as const,
        errors: [{ message: failureText(error), remedy: "" }],
      }));
    // What follows, the player's panel, takes as long as a slice of the reading.
    await new Promise((resolve) => setTimeout(resolve));
    if (this.#abort !== abort) return null;
    this.#abort = null;
    // What was shown before would appear for a moment: `show` ends the reading too.
    if (read.success) return read.value;
    const failure = read.errors.map(({ message, remedy }) => `${message}. ${remedy}`.trimEnd());
    this.state.setState({ reading: null, failure });
    return null;
  }

  /** Shows a recorded trace and the file it was read from, in the first state. */
  show(trace: Trace, file: Uint8Array<ArrayBuffer>): void {
    this.#show(trace, file, false);
  }

  #show(trace: Trace, file: Uint8Array<ArrayBuffer>, isOpened: boolean): void {
    this.pause();
    const labels = this.#labels.get(trace) ?? null;
    this.state.setState({
      reading: null,
      trace,
      labels,
      file,
      isOpened,
      step: 0,
      lensStep: 0,
      loop: null,
      candidate: null,
      pointed: null,
      beat: null,
      apart: 0,
      sweep: null,
      failure: null,
    });
  }

  /** Plays a number of steps, or of beats. */
  #advance(due: number): void {
    if (!playsBeats(this.state.getState())) return this.#playSteps(due);
    for (let i = 0; i < due && this.state.getState().isPlaying; i++) this.#playBeat();
  }

  /** Shows the next beat, or the first one of the next step. */
  #playBeat(): void {
    const { trace, step, beat, loop } = this.state.getState();
    if (!trace) return;
    if (beat === null && step < (loop?.to ?? trace.stepCount)) return this.#playSteps(1);
    if (beat !== null) this.state.setState({ beat: knownBeat(trace, step, beat + 1) });
    // The film of the last step has been shown, or its repetition begins.
    else if (loop) this.#playSteps(1);
    else this.pause();
  }

  /** Plays a number of steps: up to the next stop, the end of the loop, or the end. */
  #playSteps(steps: number): void {
    const { trace, step, loop, stopAt } = this.state.getState();
    if (!trace) return;
    const last = loop?.to ?? trace.stepCount;
    const show = (to: number): void => {
      const isFilm = playsBeats(this.state.getState()) && beatsOf(trace, to).length > 1;
      if (isFilm) this.#showState(to, 1, false);
      else this.seek(to);
    };
    // The last step of the loop has been shown.
    if (loop && step >= last) return show(loop.from);
    const stop = stopAt && nextStop(trace, step, 1, stopAt, Math.min(last, step + steps));
    const end = stop ?? last;
    if (step + steps < end) return show(step + steps);
    if (stop === null) show(end);
    else this.seek(end);
    // The film of the last step is still to be shown.
    if (stop === null && (loop || this.state.getState().beat !== null)) return;
    this.pause();
    if (stopAt && stop !== null) this.state.setState({ candidate: refusedIn(trace, stop, stopAt) });
  }
}
