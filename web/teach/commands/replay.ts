import type { Mesher } from "tetrafront";
import { createStore } from "zustand/vanilla";
import type { App } from "../../app/app";
import type { Replay, ReplayState } from "../../app/replay";
import { formatCount } from "../../strings/format";
import type { Viewer } from "../../viewer/viewer";
import { frontSizeAt, phaseAt } from "../player/phases";
import { Player, type PlayerState } from "../player/player";
import { frontStrings } from "../strings/front";
import { setPlayer } from "./player-of";

/** Makes the player of an app, which the app knows as a replay. */
export function replayOf(app: App, mesher: Promise<Mesher>): Replay {
  const { documents, run } = app;
  const preparedOf = app.bodies.preparations.allOf.bind(app.bodies.preparations);
  const player = new Player({ documents, run, mesher, preparedOf });
  setPlayer(app, player);
  player.state.subscribe(({ trace }, { trace: before }) => {
    if ((trace === null) === (before === null)) return;
    app.shell.setState(({ leftTab }) => ({
      leftTab: trace ? "lens" : leftTab === "lens" ? "model" : leftTab,
    }));
  });
  const state = createStore(() => replayState(player.state.getState()));
  player.state.subscribe((now, before) => {
    const isSame = now.trace === before.trace && now.step === before.step;
    if (!isSame || (now.recording === null) !== (before.recording === null)) state.setState(replayState(now));
  });
  return {
    state,
    move: (steps) => player.move(steps),
    toggle: () => player.toggle(),
    drawIn: (viewer) => drawIn(player, viewer),
    drawLabels: async (viewer, paper) => {
      const { drawLabels } = await import("./step-pictures");
      drawLabels(player, viewer, paper);
    },
    link: () => {
      const { trace, step, coloring, faces, elements, candidate, beat } = player.state.getState();
      return trace && { step, order: trace.header.order, coloring, faces, elements, candidate, beat };
    },
    showLinked: async (linked, camera) => {
      const { showLinkedFront } = await import("./step-links");
      await showLinkedFront(app, linked, camera);
    },
  };
}

function replayState({ trace, step, recording }: PlayerState): ReplayState {
  const isRecording = recording !== null;
  if (!trace) return { isShown: false, isRecording, text: null, data: {} };
  const { phase, from, to } = phaseAt(trace, step);
  return {
    isShown: true,
    isRecording,
    // Steps are counted in each phase, as in the player.
    text: frontStrings.at[phase](formatCount(step - from), formatCount(to - from)),
    data: {
      step: String(step),
      steps: String(trace.stepCount),
      frontFaces: String(frontSizeAt(trace, step)),
    },
  };
}

/** Draws the recorded front when there is one. Its code is loaded then. Returns a function that ends this. */
function drawIn(player: Player, viewer: Viewer): () => void {
  let end: (() => void) | null = null;
  let isOver = false;
  const load = async (): Promise<void> => {
    const { showPlayer } = await import("../player/show-player");
    if (!isOver) end = showPlayer(player.state, viewer);
  };
  let loading: Promise<void> | null = null;
  const stop = player.state.subscribe(({ trace }) => {
    if (trace) loading ??= load();
  });
  if (player.state.getState().trace) loading = load();
  return () => {
    isOver = true;
    stop();
    end?.();
  };
}
