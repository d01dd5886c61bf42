/** What a command is doing, and a line about it every ten seconds: a log shows no progress bar. */
import type { CallProgress, ProgressPhase } from "../base/progress.js";
import { roundTime, TimeLeft } from "../base/time-left.js";
import { print } from "./messages.js";

/** Time between two lines, in milliseconds. */
const EVERY_MS = 10_000;

/** Set for the processes of a batch, whose messages appear at their end. */
export const SILENT = "TETRAFRONT_NO_PROGRESS";

const WORDS: Readonly<Record<ProgressPhase | "improve" | "curve" | "solution" | "adapt", string>> = {
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
  solution: "using the solution",
  adapt: "adapting the mesh",
};

interface Stage {
  readonly words: string;
  /** Share of the whole that is done, from 0 to 1; undefined if it is not known. */
  readonly fraction: number | undefined;
  /** Text for the time left; empty if it is not known. */
  readonly left: string;
}

/** The process runs one command. */
let current: Stage = { words: "starting", fraction: undefined, left: "" };
let timeLeft = new TimeLeft();
let isBarShown = false;

/** Says what the command does from now on; how far that is, is not known. */
export function enterStage(words: string): void {
  current = { words, fraction: undefined, left: "" };
  timeLeft = new TimeLeft();
}

/** Says how far the whole is; returns the text for the time left. `step`: word for a call that is not a run. */
export function enterPhase(
  {
    phase,
    fraction,
    elapsedSeconds,
    meshNumber = 1,
  }: Pick<CallProgress, "phase" | "fraction" | "elapsedSeconds" | "meshNumber">,
  step: string | undefined,
): string {
  const words = WORDS[isKnown(step) ? step : phase];
  const left = leftText(timeLeft.add(fraction, elapsedSeconds));
  current = { words: meshNumber > 1 ? `mesh ${meshNumber}: ${words}` : words, fraction, left };
  return left;
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

function stageLine({ words, fraction, left }: Stage, seconds: number): string {
  const share = fraction === undefined ? "" : `, ${Math.floor(100 * fraction)} %`;
  return `${words}${share}, ${Math.round(seconds)} s so far${left && `, ${left}`}`;
}

function leftText(seconds: number | null): string {
  if (seconds === null) return "";
  const { value, unit } = roundTime(seconds);
  return `about ${value} ${unit} left`;
}
