import { createStore, type StoreApi } from "zustand/vanilla";
import type { CameraPose } from "../viewer/camera";
import type { Viewer } from "../viewer/viewer";

export interface ReplayState {
  /** Whether the view shows it in place of the model. */
  readonly isShown: boolean;
  readonly isRecording: boolean;
  /** What the status bar says of it while it is shown. */
  readonly text: string | null;
  /** Attributes of the view's element, for tests. */
  readonly data: Readonly<Record<string, string>>;
}

/** The part of a link that describes a replay, unchecked. */
export type LinkedReplay = Readonly<Record<string, unknown>>;

/** What can be played in the view in place of the model. The app knows no more of what teaches (web/teach). */
export interface Replay {
  readonly state: StoreApi<ReplayState>;
  /** Moves by a number of steps, and pauses. */
  move(steps: number): void;
  /** Plays or pauses. */
  toggle(): void;
  /** Draws what is shown in a view. Returns a function that ends this. */
  drawIn(viewer: Viewer): () => void;
  /** Draws its labels, which are not in the canvas of the view, in CSS pixels of the view. */
  drawLabels(viewer: Viewer, paper: CanvasRenderingContext2D): Promise<void>;
  /** Returns its part of a link to the project; null if nothing is shown. */
  link(): LinkedReplay | null;
  /** Shows what a link says of it, which may be anything. `camera`: null for one that shows the whole model. */
  showLinked(linked: LinkedReplay, camera: CameraPose | null): Promise<void>;
}

/** The replay of an app without what teaches. */
export const noReplay: Replay = {
  state: createStore<ReplayState>(() => ({ isShown: false, isRecording: false, text: null, data: {} })),
  move: () => undefined,
  toggle: () => undefined,
  drawIn: () => () => undefined,
  drawLabels: () => Promise.resolve(),
  link: () => null,
  showLinked: () => Promise.resolve(),
};
