/**
 * A step as a film: a few beats that can be scrubbed. The last beat is the state after the step; the beats before it show the
 * front as the step found it. Beats are counted from 1.
 */
import type { FrontChange, Trace } from "tetrafront/trace";
import { surfaceState } from "./phases";
import type { PlayerState } from "./player";

export type Beat =
  | "base"
  | "ideal"
  | "candidates"
  | "test"
  | "element"
  | "postponed"
  | "pocket"
  | "node"
  | "star"
  | "filled"
  | "opened"
  | "attempt"
  | "undone"
  | "edge"
  | "triangle"
  | "station"
  | "averages"
  | "side";

const recoveryBeats: Readonly<Record<FrontChange, readonly Beat[]>> = {
  star: ["pocket", "node", "star"],
  closed: ["pocket", "node", "star"],
  "exact-fill": ["pocket", "node", "filled"],
  reopened: ["pocket", "opened"],
  undone: ["attempt", "undone"],
};

const noBeats: readonly Beat[] = [];
const edgeBeats = (last: Beat): readonly Beat[] => ["edge", "ideal", "candidates", "test", last];
const advanceBeats = (last: Beat): readonly Beat[] => ["base", "ideal", "candidates", "test", last];
const beatsByKind: Readonly<Partial<Record<string, readonly Beat[]>>> = {
  accepted: edgeBeats("triangle"),
  postponed: edgeBeats("postponed"),
  station: ["station", "averages", "side"],
};
const [acceptedBeats, postponedBeats] = [advanceBeats("element"), advanceBeats("postponed")];

/** Returns the beats of a step; none before the first step, and for steps about a whole line or patch. */
export function beatsOf(trace: Trace, step: number): readonly Beat[] {
  const state = surfaceState(trace, step);
  if (state !== null) return beatsByKind[trace.surface?.kindAt(state) ?? ""] ?? noBeats;
  const outcome = trace.steps.outcomes[step];
  if (step < 1 || outcome === undefined) return noBeats;
  if (outcome === 0) return acceptedBeats;
  if (outcome === 1) return postponedBeats;
  const shown = trace.stepAt(step);
  return shown?.kind === "recovery" ? recoveryBeats[shown.change] : noBeats;
}

/** Returns the number of a beat as the player keeps it: null for the last one, and for steps without beats. */
export function knownBeat(trace: Trace, step: number, beat: number | null): number | null {
  const count = beatsOf(trace, step).length;
  return beat === null || beat >= count ? null : Math.max(1, Math.round(beat));
}

type Filmed = Pick<PlayerState, "trace" | "step" | "film" | "beat">;

/** Returns the beat that a state shows; null without a film, and for steps without beats. */
export function beatAt({ trace, step, film, beat }: Filmed): Beat | null {
  if (!trace || !film) return null;
  const beats = beatsOf(trace, step);
  return (beat === null ? beats.at(-1) : beats[beat - 1]) ?? null;
}

/** Whether a beat shows nothing of the verdicts on candidates yet. */
export const isBeforeTest = (beat: Beat | null): boolean =>
  beat === "base" || beat === "edge" || beat === "ideal" || beat === "candidates";

/** Whether a state shows a step that has not ended: its front is that before the step. */
export const isUnfinished = ({ film, beat }: Pick<PlayerState, "film" | "beat">): boolean =>
  film && beat !== null;

/** Fastest speed at which a film is played beat by beat, in steps per second. */
const maxFilmSpeed = 1;
/** Beats of most steps. */
export const usualBeats = 5;

/** Whether playing shows every beat of a step. */
export const playsBeats = ({ film, speed }: Pick<PlayerState, "film" | "speed">): boolean =>
  film && speed <= maxFilmSpeed;

/** Whether the view shows only the front's faces, because steps follow each other too fast to look into them. */
export const isFleeting = (
  state: Pick<PlayerState, "isPlaying" | "film" | "speed" | "step" | "lensStep">,
): boolean => (state.isPlaying && !playsBeats(state)) || state.step !== state.lensStep;

/** Whether a film has come to its end: the front is closed, and the view shows the filled volume. */
export function isFilled({ trace, step, film, beat }: Filmed): boolean {
  if (!trace || !film || beat !== null || step !== trace.stepCount) return false;
  return step > 0 && trace.steps.frontSizes[step] === 0;
}

/** Returns which elements a state shows: at the end of a film all, cut open, instead of the last ones. */
export const elementsShown = (state: Filmed & Pick<PlayerState, "elements">): PlayerState["elements"] =>
  isFilled(state) && (state.elements === "last" || state.elements === "recent") ? "cut" : state.elements;

/** Whether a state shows all elements, which can be pulled apart. */
export function showsWhole(state: PlayerState): boolean {
  const elements = elementsShown(state);
  const isAtRest = !state.isPlaying && state.step === state.lensStep;
  return isAtRest && state.step >= 0 && state.sweep === null && (elements === "all" || elements === "cut");
}

/** Whether the colours of the view are data of the front's faces, and not depth and age as in a film at rest. */
export const showsData = (state: PlayerState): boolean =>
  state.sweep !== null || !state.film || isFleeting(state) || beatAt(state) === null;
