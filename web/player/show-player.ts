import type { Trace } from "tetrafront";
import type { StoreApi } from "zustand/vanilla";
import { cornersOf } from "./judge";
import { decisive, examine } from "./lens";
import { LensLayer, type LensScene } from "./lens-layer";
import type { PlayerState } from "./player";
import { surfaceState } from "./phases";
import { ReplayLayer } from "./replay-layer";
import { searchRegionOf } from "./search-region";
import { SurfaceLayer } from "./surface-layer";
import { SweepLayer } from "./sweep-layer";
import { chosenCandidate, type VolumeTask } from "./volume-game";
import type { Viewer } from "../viewer/viewer";

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
      shown = state.trace && { trace: state.trace, ...drawTrace(state.trace, viewer) };
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

function drawTrace(trace: Trace, viewer: Viewer) {
  const replay = new ReplayLayer(trace);
  const lens = new LensLayer();
  const sweeps = new SweepLayer(trace);
  const surface = new SurfaceLayer(trace);
  const ends = [replay, surface, sweeps, lens].map((layer) => viewer.addLayer(layer));
  return {
    show: (state: PlayerState): void => {
      replay.show(state);
      surface.show(surfaceState(trace, state.step));
      sweeps.show(state.sweep);
      // While the front is played or scrubbed, only its faces change.
      const isMoving = state.isPlaying || state.step !== state.lensStep;
      const scene = state.task
        ? taskScene(trace, state.task)
        : isMoving || state.sweep !== null
          ? null
          : lensScene(trace, state);
      lens.show(scene);
      if (state.follows && scene) viewer.fitPosition(cornersOf(trace, scene.step.face)[0]);
      viewer.requestFrame();
    },
    end: (): void => ends.forEach((end) => end()),
  };
}

/** The base face that is asked for, and what the choice would make. */
function taskScene(trace: Trace, task: VolumeTask): LensScene {
  const { step } = task.question;
  const chosen = chosenCandidate(trace, task);
  const examined = chosen && examine(trace, step, chosen);
  return { trace, step, examined, region: null, showsIdeal: task.showsIdeal };
}

function lensScene(trace: Trace, { step: number, candidate, showsRegion }: PlayerState): LensScene | null {
  const step = trace.stepAt(number);
  if (step?.kind !== "advance") return null;
  const index = candidate ?? decisive(step);
  const chosen = index === null ? undefined : step.candidates[index];
  return {
    trace,
    step,
    examined: chosen ? examine(trace, step, chosen) : null,
    region: showsRegion ? searchRegionOf(trace, step) : null,
    showsIdeal: true,
  };
}
