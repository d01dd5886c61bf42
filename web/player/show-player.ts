import type { Trace } from "tetrafront";
import type { StoreApi } from "zustand/vanilla";
import type { Position } from "../document/position";
import { cornersOf } from "./judge";
import { LensLayer } from "./lens-layer";
import { lensMarks } from "./lens-marks";
import { lensSceneOf, type LensScene } from "./lens-scene";
import { endsOf } from "./planar-judge";
import { initialPlayerState, type PlayerState } from "./player";
import { firstState, surfaceState } from "./phases";
import { ReplayLayer } from "./replay-layer";
import { SurfaceLayer } from "./surface-layer";
import { inSpace } from "./surface-scene";
import { SweepLayer } from "./sweep-layer";
import type { Viewer } from "../viewer/viewer";

/** Speed in steps per second up to which the view follows while the front is played: faster, it would jerk. */
const maxFollowedSpeed = 5;

/** Draws the trace of a player in a view, instead of the model's surfaces and mesh. Returns a function that ends this. */
export function showPlayer(player: StoreApi<PlayerState>, viewer: Viewer): () => void {
  let shown: {
    readonly trace: Trace;
    readonly end: () => void;
    readonly show: (state: PlayerState) => void;
  } | null = null;
  const update = (state: PlayerState): void => {
    if (shown?.trace !== state.trace) {
      shown?.end();
      // A trace from a file can be of another model.
      viewer.replaceModel(state.isOpened ? (state.trace?.nodes.positions ?? null) : null);
      shown = state.trace && { trace: state.trace, ...drawTrace(state.trace, viewer, player) };
      viewer.show({ isReplaying: shown !== null });
    }
    shown?.show(state);
  };
  update(player.getState());
  const stop = player.subscribe(update);
  return () => {
    stop();
    shown?.end();
    viewer.replaceModel(null);
    viewer.show({ isReplaying: false });
  };
}

function drawTrace(trace: Trace, viewer: Viewer, player: StoreApi<PlayerState>) {
  const replay = new ReplayLayer(trace);
  const lens = new LensLayer();
  const sweeps = new SweepLayer(trace);
  const surface = new SurfaceLayer(trace);
  /** What the view has moved to last; null if the last state was about no face or edge, or was shown too briefly. */
  let followed: { readonly step: number; readonly scene: LensScene | null } | null = null;
  const follow = (state: PlayerState, scene: LensScene | null): void => {
    if (followed?.step === state.step && followed.scene === scene) return;
    const positions = positionsToFollow(trace, state, scene);
    followed = positions && { step: state.step, scene };
    if (positions) viewer.fitPositions(positions);
  };
  const ends = [replay, surface, sweeps, lens].map((layer) => viewer.addLayer(layer));
  const draw = (state: PlayerState): LensScene | null => {
    const scene = lensSceneOf(state);
    replay.show(state, scene !== null && state.fades);
    surface.show(surfaceState(trace, state.step), state.candidate, state.edgeTask);
    sweeps.show(state.sweep);
    lens.show(scene);
    return scene;
  };
  const rehearsal = new AbortController();
  const rehearsed = statesToRehearse(trace).map(
    (step) => (): void => void draw({ ...initialPlayerState, trace, step, lensStep: step }),
  );
  void viewer.rehearse(rehearsed, () => void draw(player.getState()), rehearsal.signal);
  return {
    show: (state: PlayerState): void => {
      const scene = draw(state);
      if (state.follows) follow(state, scene);
      else followed = null;
      viewer.requestFrame();
    },
    end: (): void => {
      rehearsal.abort();
      ends.forEach((end) => end());
    },
  };
}

/** Returns a state of each phase with what its lens shows: a face that is completed, and an edge of a patch. */
function statesToRehearse(trace: Trace): readonly number[] {
  const first = firstState(trace);
  const edge = trace.surface
    ? nextSuch(first, 0, (step) => trace.surface?.stepAt(step - first)?.kind === "edge")
    : null;
  const face = nextSuch(1, trace.stepCount + 1, (step) => trace.stepAt(step)?.kind === "advance");
  return [edge, face].filter((step) => step !== null);
}

function nextSuch(from: number, to: number, isSuch: (step: number) => boolean): number | null {
  for (let step = from; step < to; step++) if (isSuch(step)) return step;
  return null;
}

/** Returns what the step of a state is about; null if it is not about a face or an edge, or if steps follow each other too fast. */
function positionsToFollow(
  trace: Trace,
  { step: number, isPlaying, speed, lensStep }: PlayerState,
  scene: LensScene | null,
): readonly Position[] | null {
  if (scene) {
    const { base, ideal, candidate, culprit } = lensMarks(scene);
    return [...base, ...ideal, ...candidate, ...culprit];
  }
  if (isPlaying ? speed > maxFollowedSpeed : number !== lensStep) return null;
  const step = trace.stepAt(number);
  if (step?.kind === "advance") return cornersOf(trace, step.face);
  const state = surfaceState(trace, number);
  const edgeStep = state === null ? undefined : trace.surface?.stepAt(state);
  const front = edgeStep?.kind === "edge" ? trace.surface?.fronts[edgeStep.front] : undefined;
  return edgeStep?.kind === "edge" && front
    ? endsOf(front, edgeStep.edge).map((node) => inSpace(front, node))
    : null;
}
