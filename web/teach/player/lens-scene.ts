/** What the lens examines in a state of the player: for the view, the panel and drawings. */
import type { AdvanceStep, Trace, TracedCandidate } from "tetrafront/trace";
import { isBeforeTest } from "./beats";
import { beatAt, isFleeting } from "./film-state";
import type { Beat } from "../strings/film";
import type { FrontChange } from "./judge";
import { decisive, examine, type LensCandidate } from "./lens";
import type { PlayerState } from "./player";
import { searchRegionOf, type SearchRegion } from "./search-region";

/** A step of the volume with the examined candidate. */
export interface LensScene {
  readonly trace: Trace;
  readonly step: AdvanceStep;
  readonly examined: LensCandidate | null;
  /** The beat of the step; null if the step is shown as a whole. */
  readonly beat: Beat | null;
  /** The other candidates of the step. */
  readonly others: readonly TracedCandidate[];
  readonly region: SearchRegion | null;
  /**
   * How the front would change with the examined candidate, if the view shows this: one was chosen that was refused, and whose
   * element would have a volume. Else null.
   */
  readonly supposed: FrontChange | null;
}

const examinedParts = [
  "step",
  "lensStep",
  "isPlaying",
  "speed",
  "sweep",
  "candidate",
  "showsRegion",
  "film",
  "beat",
] as const;
type Examined = Pick<PlayerState, (typeof examinedParts)[number]>;

/** What was examined last in each trace: the view and the panels ask for the same. */
const known = new WeakMap<Trace, { readonly state: Examined; readonly scene: LensScene | null }>();

/**
 * Returns the scene of a state; null while the front is played or scrubbed, and in steps that complete no face. It is the same
 * object as long as the state shows the same. O(faces of the front) for a new one.
 */
export function lensSceneOf(state: PlayerState): LensScene | null {
  const { trace } = state;
  // Between elements that are pulled apart, marks would be in the way.
  if (!trace || state.apart > 0) return null;
  const before = known.get(trace);
  if (before && isSame(before.state, state)) return before.scene;
  const scene = sceneOf(trace, state);
  known.set(trace, { state, scene });
  return scene;
}

const isSame = (a: Examined, b: Examined): boolean => examinedParts.every((part) => a[part] === b[part]);

/** Returns the scene of a state as `lensSceneOf` does, but always as a new object, which is not kept. */
export function sceneOf(trace: Trace, state: Examined): LensScene | null {
  if (isFleeting(state) || state.sweep !== null) return null;
  const step = trace.stepAt(state.lensStep);
  if (step?.kind !== "advance") return null;
  const beat = beatAt({ ...state, trace });
  const index = state.candidate ?? examinedIn(step, beat);
  const chosen = index === null ? undefined : step.candidates[index];
  const examined = chosen ? examine(trace, step, chosen) : null;
  return {
    trace,
    step,
    beat,
    examined,
    others: step.candidates.filter((candidate) => candidate !== chosen),
    region: state.showsRegion || beat === "ideal" ? searchRegionOf(trace, step) : null,
    supposed: state.candidate === null || isBeforeTest(beat) ? null : supposedChange(examined),
  };
}

/** Returns the candidate that is examined if none is chosen: in the beat of the test, the first one that was refused. */
export function examinedIn(step: AdvanceStep, beat: Beat | null): number | null {
  const refused = step.candidates.findIndex(({ verdict }) => verdict !== "accepted");
  return beat === "test" && refused >= 0 ? refused : decisive(step);
}

/** Returns how the front would change with a refused candidate; null if it would not, or if it has changed so. */
function supposedChange(examined: LensCandidate | null): FrontChange | null {
  const verdict = examined?.candidate.verdict;
  const wasPossible = verdict === "crosses" || verdict === "too-close";
  return examined && wasPossible && !examined.isBehind ? examined.change : null;
}
