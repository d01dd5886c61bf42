/** The view of a player: when it follows what a step is about. */
import type { Trace } from "tetrafront/trace";
import { beforeAll, beforeEach, expect, it, vi } from "vitest";
import { createStore, type StoreApi } from "zustand/vanilla";
import { firstState, phasesOf } from "../../../web/teach/player/phases";
import { initialPlayerState, type PlayerState } from "../../../web/teach/player/player";
import { nextStop } from "../../../web/teach/player/stops";
import { showPlayer } from "../../../web/teach/player/show-player";
import type { Layer } from "../../../web/viewer/layers/layer";
import type { Viewer } from "../../../web/viewer/viewer";
import { galleryProject, recordFront } from "../../support/recorded-models";

let trace: Trace;
beforeAll(async () => {
  trace = await recordFront(galleryProject("unit-cube"));
});

const fitPositions = vi.fn();
const fit = vi.fn();
/** What the viewer calls when the user moves the camera. */
let userMoved = (): void => undefined;
const warmUp = vi.fn<Viewer["warmUp"]>(() => Promise.resolve());
/** Layers in the order in which they were added last. */
let layers: Layer[] = [];
const viewer = {
  addLayer: (layer: Layer) => {
    layers.push(layer);
    return vi.fn();
  },
  warmUp,
  show: vi.fn(),
  framing: { replaceModel: vi.fn(), fitPositions, fit },
  pose: { eye: [3, -3, 2], target: [0, 0, 0] },
  onUserMoved: (listener: () => void) => {
    userMoved = listener;
    return vi.fn();
  },
  requestFrame: vi.fn(),
} as unknown as Viewer;
beforeEach(() => {
  layers = [];
  fitPositions.mockReset();
  fit.mockReset();
  warmUp.mockClear();
});

/** Shows a player that follows the front, in the first state. */
function following(): StoreApi<PlayerState> {
  const first = firstState(trace);
  const player = createStore<PlayerState>(() => ({
    ...initialPlayerState,
    trace,
    step: first,
    lensStep: first,
    follows: true,
  }));
  showPlayer(player, viewer);
  fitPositions.mockReset();
  return player;
}

/** Numbers of two states of patches that are about an edge. */
function edgeSteps(): readonly [number, number] {
  const patches = phasesOf(trace).find(({ phase }) => phase === "patches");
  const [a, b] = Array.from(
    { length: trace.surface?.stepCount ?? 0 },
    (_, i) => firstState(trace) + i,
  ).filter(
    (step) =>
      step >= (patches?.from ?? 0) && trace.surface?.stepAt(step - firstState(trace))?.kind === "edge",
  );
  if (a === undefined || b === undefined) throw new Error("no patch was meshed");
  return [a, b];
}

it("moves to the edge of a patch once its state has settled after fast steps", () => {
  const player = following();
  const [step, next] = edgeSteps();
  player.setState({ step });
  expect(fitPositions).not.toHaveBeenCalled();
  player.setState({ lensStep: step });
  expect(fitPositions).toHaveBeenCalledTimes(1);
  // The user may turn the view then.
  player.setState({ coloring: "size" });
  expect(fitPositions).toHaveBeenCalledTimes(1);
  player.setState({ step: next, lensStep: next });
  expect(fitPositions).toHaveBeenCalledTimes(2);
});

it("moves to the edge of a patch when fast playing is paused", () => {
  const player = following();
  const [step] = edgeSteps();
  player.setState({ isPlaying: true, speed: 500 });
  player.setState({ step, lensStep: step });
  expect(fitPositions).not.toHaveBeenCalled();
  player.setState({ isPlaying: false });
  expect(fitPositions).toHaveBeenCalledTimes(1);
});

/** Draws the states that are drawn out of sight, calling back after each, and shows the present one again. */
function drawHidden(after: () => void = () => undefined): void {
  const [states = [], restore] = warmUp.mock.calls.at(-1) ?? [];
  expect(states).toHaveLength(2);
  for (const show of states) {
    show();
    after();
    restore?.();
  }
}

it("draws a face and an edge under the lens out of sight, shows the present state again, and stops at the end", () => {
  const player = createStore<PlayerState>(() => ({ ...initialPlayerState, trace }));
  const end = showPlayer(player, viewer);
  expect(warmUp).toHaveBeenCalledTimes(1);
  const visible = (): readonly boolean[] => layers.map(({ root }) => root.visible);
  const wasVisible = layers.map(() => false);
  drawHidden(() => visible().forEach((isVisible, i) => (wasVisible[i] ||= isVisible)));
  expect(visible()).toEqual([true, false, false, false, false]);
  const [replay, near, surface, , lens] = wasVisible;
  expect([replay, near, surface, lens]).toEqual([true, true, true, true]);
  const signal = warmUp.mock.calls[0]?.[2];
  expect(signal?.aborted).toBe(false);
  end();
  expect(signal?.aborted).toBe(true);
});

it("does not move again to what it follows after states were drawn out of sight", () => {
  const player = createStore<PlayerState>(() => ({ ...initialPlayerState, trace, follows: true }));
  showPlayer(player, viewer);
  const step = nextStop(trace, 0, 1, "new-node") ?? 0;
  player.setState({ step, lensStep: step });
  const moves = fitPositions.mock.calls.length;
  expect(moves).toBeGreaterThan(0);
  drawHidden();
  player.setState({ coloring: "size" });
  expect(fitPositions).toHaveBeenCalledTimes(moves);
});

it("is seen from one place in all beats of a step, until the user moves the view", () => {
  const player = following();
  let step = 1;
  while (trace.stepAt(step)?.kind !== "advance") step++;
  player.setState({ step, lensStep: step });
  expect(fitPositions).toHaveBeenCalledTimes(1);
  for (const beat of [1, 2, 3, 4, null]) player.setState({ beat });
  player.setState({ candidate: 0 });
  expect(fitPositions).toHaveBeenCalledTimes(1);
  // The direction, if it is another one, is that of the empty side.
  const [, from] = fitPositions.mock.lastCall as [unknown, readonly number[] | null];
  const [a = 0, b = 0, c = 0] = trace.faces.nodes.subarray(3 * faceOf(step));
  const at = (node: number): readonly number[] => [...trace.nodes.positions.subarray(3 * node, 3 * node + 3)];
  const [u, v] = [b, c].map((node) => at(node).map((x, i) => x - (at(a)[i] ?? 0)));
  const normal = [0, 1, 2].map(
    (i) =>
      (u?.[(i + 1) % 3] ?? 0) * (v?.[(i + 2) % 3] ?? 0) - (u?.[(i + 2) % 3] ?? 0) * (v?.[(i + 1) % 3] ?? 0),
  );
  const seen = from ?? [3, -3, 2];
  expect(normal.reduce((sum, x, i) => sum + x * (seen[i] ?? 0), 0)).toBeGreaterThan(0);
  userMoved();
  expect(player.getState().follows).toBe(false);
  player.setState({ step: step + 1, lensStep: step + 1 });
  expect(fitPositions).toHaveBeenCalledTimes(1);
});

function faceOf(step: number): number {
  const shown = trace.stepAt(step);
  return shown?.kind === "advance" ? shown.face : 0;
}

it("shows the whole model again at the end of a film", () => {
  const player = following();
  player.setState({ step: 5, lensStep: 5 });
  expect(fit).not.toHaveBeenCalled();
  player.setState({ step: trace.stepCount, lensStep: trace.stepCount });
  expect(fit).toHaveBeenCalledWith(null);
  expect(fit).toHaveBeenCalledTimes(1);
  player.setState({ apart: 0.5 });
  expect(fit).toHaveBeenCalledTimes(1);
  // The earlier beats of the last step are about its face, all from one place.
  fitPositions.mockReset();
  for (const beat of [1, 2]) player.setState({ beat });
  expect(fitPositions).toHaveBeenCalledTimes(1);
  player.setState({ beat: null });
  expect(fit).toHaveBeenCalledTimes(2);
});
