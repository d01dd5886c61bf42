/** What the lens examines in a state of the player: for the view, the panel and drawings. */
import type { AdvanceStep, Trace, TracedCandidate } from "tetrafront/trace";
import type { FrontChange } from "./judge";
import { decisive, examine, type LensCandidate } from "./lens";
import type { PlayerState } from "./player";
import { searchRegionOf, type SearchRegion } from "./search-region";

/** A step of the volume with the examined candidate. */
export interface LensScene {
  readonly trace: Trace;
  readonly step: AdvanceStep;
  readonly examined: LensCandidate | null;
  /** The other candidates of the step. */
  readonly others: readonly TracedCandidate[];
  readonly region: SearchRegion | null;
  /**
   * How the front would change with the examined candidate, if the view shows this: one was chosen that was refused, and whose
   * element would have a volume. Else null.
   */
  readonly supposed: FrontChange | null;
}

type Examined = Pick<PlayerState, "step" | "lensStep" | "isPlaying" | "sweep" | "candidate" | "showsRegion">;

/** What was examined last in each trace: the view and the panels ask for the same. */
const known = new WeakMap<Trace, { readonly state: Examined; readonly scene: LensScene | null }>();

/**
 * Returns the scene of a state; null while the front is played or scrubbed, and in steps that complete no face. It is the same
 * object as long as the state shows the same. O(faces of the front) for a new one.
 */
export function lensSceneOf(state: PlayerState): LensScene | null {
  const { trace } = state;
  if (!trace) return null;
  const before = known.get(trace);
  if (before && isSame(before.state, state)) return before.scene;
  const scene = sceneOf(trace, state);
  known.set(trace, { state, scene });
  return scene;
}

function isSame(a: Examined, b: Examined): boolean {
  return (
    a.step === b.step &&
    a.lensStep === b.lensStep &&
    a.isPlaying === b.isPlaying &&
    a.sweep === b.sweep &&
    a.candidate === b.candidate &&
    a.showsRegion === b.showsRegion
  );
}

/** Returns the scene of a state as `lensSceneOf` does, but always as a new object, which is not kept. */
export function sceneOf(trace: Trace, state: Examined): LensScene | null {
  // While the front is played or scrubbed, only its faces change.
  if (state.isPlaying || state.step !== state.lensStep || state.sweep !== null) return null;
  const step = trace.stepAt(state.lensStep);
  if (step?.kind !== "advance") return null;
  const index = state.candidate ?? decisive(step);
  const chosen = index === null ? undefined : step.candidates[index];
  const examined = chosen ? examine(trace, step, chosen) : null;
  return {
    trace,
    step,
    examined,
    others: step.candidates.filter((candidate) => candidate !== chosen),
    region: state.showsRegion ? searchRegionOf(trace, step) : null,
    supposed: state.candidate === null ? null : supposedChange(examined),
  };
}

/** Returns how the front would change with a refused candidate; null if it would not, or if it has changed so. */
function supposedChange(examined: LensCandidate | null): FrontChange | null {
  const verdict = examined?.candidate.verdict;
  const wasPossible = verdict === "crosses" || verdict === "too-close";
  return examined && wasPossible && !examined.isBehind ? examined.change : null;
}
