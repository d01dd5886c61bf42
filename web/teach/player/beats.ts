/**
 * A step as a film: a few beats that can be scrubbed. The last beat is the state after the step; the beats before it show the
 * front as the step found it. Beats are counted from 1.
 */
import type { FrontChange, Trace } from "tetrafront/trace";
import type { Beat } from "../strings/film";
import { surfaceState } from "./phases";

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

/** Whether a beat shows nothing of the verdicts on candidates yet. */
export const isBeforeTest = (beat: Beat | null): boolean =>
  beat === "base" || beat === "edge" || beat === "ideal" || beat === "candidates";

/** Fastest speed at which a film is played beat by beat, in steps per second. */
const maxFilmSpeed = 1;
/** Beats of most steps. */
export const usualBeats = 5;

/** Whether playing shows every beat of a step. */
export const playsBeats = ({ film, speed }: { readonly film: boolean; readonly speed: number }): boolean =>
  film && speed <= maxFilmSpeed;
