import type { Trace } from "tetrafront/trace";
import type { StoreApi } from "zustand/vanilla";
import type { Position } from "../../document/position";
import { addScaled, cross, dot, scale, subtract, unit } from "../../document/vectors";
import { beatAt, isFilled, isFleeting, isUnfinished } from "./film-state";
import { cornersOf } from "./judge";
import { LensLayer } from "./lens-layer";
import { lensMarks, pointedMarks } from "./lens-marks";
import { lensSceneOf, sceneOf, type LensScene } from "./lens-scene";
import { neighbourhoodOf } from "./near-faces";
import { NearLayer, type ShownNear } from "./near-layer";
import { initialPlayerState, type PlayerState } from "./player";
import { firstState, surfaceState } from "./phases";
import { recoveryMarks, recoveryMarksOf, type RecoveryMarks } from "./recovery-marks";
import { ReplayLayer } from "./replay-layer";
import { SurfaceLayer } from "./surface-layer";
import { stepMarks } from "./surface-scene";
import { SweepLayer } from "./sweep-layer";
import type { Viewer } from "../../viewer/viewer";

/** Speed in steps per second up to which the view follows while the front is played: faster, it would jerk. */
const maxFollowedSpeed = 5;
/** Surroundings of a step in a film, in halves of the diagonal of what it is about: what is drawn around it fills the view. */
const filmSurroundings = 1.2;

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
      viewer.framing.replaceModel(state.isOpened ? (state.trace?.nodes.positions ?? null) : null);
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
    viewer.framing.replaceModel(null);
    viewer.show({ isReplaying: false });
  };
}

function drawTrace(trace: Trace, viewer: Viewer, player: StoreApi<PlayerState>) {
  const replay = new ReplayLayer(trace);
  const near = new NearLayer(trace);
  const lens = new LensLayer();
  const sweeps = new SweepLayer(trace);
  const surface = new SurfaceLayer(trace);
  /** What the view has moved to last; null if the last state was about no face or edge, or was shown too briefly. */
  let followed: {
    readonly step: number;
    readonly scene: LensScene | null;
    readonly isFilled: boolean;
  } | null = null;
  /** Whether the view shows the whole model, as far as following has moved it. */
  let isWhole = true;
  const follow = (state: PlayerState, scene: LensScene | null): void => {
    const filled = isFilled(state);
    // The beats of a film are seen from one place, but for the filled volume at its end.
    const isSeen = followed?.step === state.step && followed.isFilled === filled;
    if (isSeen && (state.film || followed?.scene === scene)) return;
    const isMoving = state.isPlaying || state.step !== state.lensStep;
    if (state.film && !isMoving && (filled || state.step === 0)) {
      if (!isWhole) viewer.framing.fit(null);
      [isWhole, followed] = [true, { step: state.step, scene, isFilled: filled }];
      return;
    }
    const positions = positionsToFollow(trace, state, scene);
    followed = positions && { step: state.step, scene, isFilled: filled };
    if (!positions) return;
    isWhole = false;
    const from = state.film && scene ? emptySide(scene, viewer) : null;
    viewer.framing.fitPositions(positions, from, state.film ? filmSurroundings : undefined);
  };
  const ends = [replay, near, surface, sweeps, lens].map((layer) => viewer.addLayer(layer));
  const draw = (state: PlayerState, scene = lensSceneOf(state)): LensScene | null => {
    const recovered = recoveryMarksOf(state);
    const shownNear = nearOf(state, scene, recovered);
    const isFaded = (scene !== null || recovered !== null) && state.fades && !isFilled(state);
    replay.show(state, { isFaded, isNear: shownNear !== null, supposed: scene?.supposed ?? null });
    near.show(shownNear);
    surface.show(surfaceState(trace, state.step), state.candidate, {
      beat: isFleeting(state) ? null : beatAt(state),
      isUnfinished: isUnfinished(state),
    });
    sweeps.show(state.sweep);
    lens.show(scene, recovered);
    lens.point(pointedMarks(scene, state.pointed));
    return scene;
  };
  // Not with the scene of `lensSceneOf`: the one that is followed would be made again.
  const drawHidden = (step: number): void => {
    const { coloring, faces, elements } = player.getState();
    const state = { ...initialPlayerState, trace, step, lensStep: step, coloring, faces, elements };
    draw(state, sceneOf(trace, state));
  };
  const warmUp = new AbortController();
  const hidden = statesToWarmUp(trace).map((step) => (): void => drawHidden(step));
  const stopMoved = viewer.onUserMoved(() => {
    // The user's own view stays.
    if (player.getState().follows) player.setState({ follows: false });
  });
  void viewer.warmUp(hidden, () => void draw(player.getState()), warmUp.signal);
  return {
    show: (state: PlayerState): void => {
      const scene = draw(state);
      if (state.follows) follow(state, scene);
      else followed = null;
      viewer.requestFrame();
    },
    end: (): void => {
      warmUp.abort();
      stopMoved();
      ends.forEach((end) => end());
    },
  };
}

/** Returns a state of the patches and one of the volume, with what the lens shows there: an edge, and a face. */
function statesToWarmUp(trace: Trace): readonly number[] {
  const { surface } = trace;
  const first = firstState(trace);
  const isEdge = (step: number): boolean => {
    const kind = surface?.kindAt(step - first);
    return kind === "accepted" || kind === "postponed";
  };
  const edge = surface && findStep(first + surface.lastLineStep + 1, 0, isEdge);
  const face = findStep(1, trace.stepCount + 1, (step) => trace.stepAt(step)?.kind === "advance");
  return [edge, face].filter((step) => step !== null);
}

/** Returns the first step from `from` to before `to` that meets a condition; null if there is none. */
function findStep(from: number, to: number, isFound: (step: number) => boolean): number | null {
  for (let step = from; step < to; step++) if (isFound(step)) return step;
  return null;
}

/** No more candidates count as what a step is about: far ones would make all else small. */
const maxTried = 9;

/** Returns what of the front is drawn in a film instead of all of it; null if all of it is drawn. */
function nearOf(
  state: PlayerState,
  scene: LensScene | null,
  recovered: RecoveryMarks | null,
): ShownNear | null {
  const { step } = state;
  if (!state.film || isFilled(state)) return null;
  const about = scene
    ? aboutScene(scene)
    : [...(recovered?.left ?? []), ...(recovered?.joined ?? []), ...(recovered?.nodes ?? [])];
  const neighbourhood = neighbourhoodOf(about);
  if (!neighbourhood) return null;
  const supposed = scene?.supposed ?? null;
  const before = supposed !== null || isUnfinished(state);
  return { ...neighbourhood, state: before ? step - 1 : step, leftOut: supposed?.left ?? none };
}

const none: readonly number[] = [];

/** Returns what a step is about, the same in all of its beats. */
const aboutScene = ({ trace, step }: LensScene): readonly Position[] => [
  ...cornersOf(trace, step.face),
  step.idealPoint,
  ...step.candidates.slice(0, maxTried).map(({ position }) => position),
];

/** The base face is seen if the direction to the eye is this far from its plane, as a cosine. */
const seenFromEmpty = 0.35;

/**
 * Returns a direction from which the empty side of a step's base face is seen, as near as possible to the present one; null if
 * the present one is good.
 */
function emptySide({ trace, step }: LensScene, viewer: Viewer): Position | null {
  const [a, b, c] = cornersOf(trace, step.face);
  const { eye, target } = viewer.pose;
  const normal = unit(cross(subtract(b, a), subtract(c, a)));
  const toEye = unit(subtract(eye, target));
  if (!normal || !toEye) return null;
  const along = dot(normal, toEye);
  if (along > seenFromEmpty) return null;
  const beside = unit(addScaled(toEye, normal, -along)) ?? unit(subtract(b, a)) ?? toEye;
  return addScaled(scale(normal, 0.62), beside, 0.78);
}

/** Returns what the step of a state is about; null if it is not about a face or an edge, or if steps follow each other too fast. */
function positionsToFollow(
  trace: Trace,
  { step: number, isPlaying, speed, lensStep, film }: PlayerState,
  scene: LensScene | null,
): readonly Position[] | null {
  if (scene && film) return aboutScene(scene);
  if (scene) {
    const { base, ideal, candidate, culprit } = lensMarks(scene);
    return [...base, ...ideal, ...candidate, ...culprit];
  }
  if (isPlaying ? speed > maxFollowedSpeed : number !== lensStep) return null;
  const step = trace.stepAt(number);
  if (step?.kind === "advance") return cornersOf(trace, step.face);
  const state = surfaceState(trace, number);
  const { left = [], joined = [] } = (step?.kind === "recovery" && recoveryMarks(trace, step)) || {};
  const about = state === null ? [...left, ...joined] : stepMarks(trace, state, null).base;
  return about.length > 0 ? about : null;
}
