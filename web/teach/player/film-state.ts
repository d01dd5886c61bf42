/** What the view shows of a film: the beat, the neighbourhood of a step, or the filled volume at the end. */
import { playsBeats, beatsOf } from "./beats";
import type { PlayerState } from "./player";
import type { Beat } from "../strings/film";

type Filmed = Pick<PlayerState, "trace" | "step" | "film" | "beat">;

/** Returns the beat that a state shows; null without a film, and for steps without beats. */
export function beatAt({ trace, step, film, beat }: Filmed): Beat | null {
  if (!trace || !film) return null;
  const beats = beatsOf(trace, step);
  return (beat === null ? beats.at(-1) : beats[beat - 1]) ?? null;
}

/** Whether a state shows a step that has not ended: its front is that before the step. */
export const isUnfinished = ({ film, beat }: Pick<PlayerState, "film" | "beat">): boolean =>
  film && beat !== null;

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
