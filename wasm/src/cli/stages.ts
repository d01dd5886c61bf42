/** What a command is doing, and a line about it every ten seconds: a log shows no progress bar. */
import type { CallProgress, ProgressPhase } from "../base/progress.js";
import { print } from "./messages.js";

/** Time between two lines, in milliseconds. */
const EVERY_MS = 10_000;

/** Set for the processes of a batch, whose messages appear at their end. */
export const SILENT = "TETRAFRONT_NO_PROGRESS";

const WORDS: Readonly<Record<ProgressPhase | "improve" | "curve", string>> = {
  bodies: "preparing the bodies",
  check: "checking the surface",
  sides: "dividing the lines",
  surface: "meshing the patches",
  volume: "filling the volume",
  optimize: "improving the elements",
  verify: "verifying the mesh",
  remesh: "remeshing the surface",
  improve: "improving the elements",
  curve: "curving the edges",
};

interface Stage {
  readonly words: string;
  /** Share that is done, from 0 to 1; undefined if it is not known. */
  readonly fraction: number | undefined;
}

/** The process runs one command. */
let current: Stage = { words: "starting", fraction: undefined };
let isBarShown = false;

/** Says what the command does from now on. */
export function enterStage(words: string, fraction?: number): void {
  current = { words, fraction };
}

/** Says how far a run or another call is. `step`: word for a call that is not a run. */
export function enterPhase(
  { phase, fraction, meshNumber = 1 }: Pick<CallProgress, "phase" | "fraction" | "meshNumber">,
  step: string | undefined,
): void {
  const words = WORDS[isKnown(step) ? step : phase];
  enterStage(meshNumber > 1 ? `mesh ${meshNumber}: ${words}` : words, fraction);
}

function isKnown(step: string | undefined): step is keyof typeof WORDS {
  return step !== undefined && step in WORDS;
}

/** While a progress bar is shown, lines would interrupt it. */
export function setBarShown(isShown: boolean): void {
  isBarShown = isShown;
}

/** Prints a line every ten seconds; returns how to end this. The timer does not keep the process alive. */
export function startStageLines(): () => void {
  if (process.env[SILENT] !== undefined) return () => undefined;
  const began = performance.now();
  const timer = setInterval(() => {
    if (!isBarShown) print(stageLine(current, (performance.now() - began) / 1000));
  }, EVERY_MS);
  timer.unref();
  return () => clearInterval(timer);
}

function stageLine({ words, fraction }: Stage, seconds: number): string {
  const share = fraction === undefined ? "" : `, ${Math.floor(100 * fraction)} %`;
  return `${words}${share}, ${Math.round(seconds)} s so far`;
}
