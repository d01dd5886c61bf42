/** What happens if the process is asked to end. */

import { constants } from "node:os";

/** Signals that ask a process to end: from a terminal, from another program, and if the terminal is closed. */
export const ENDING_SIGNALS = ["SIGINT", "SIGTERM", "SIGHUP"] as const;
export type EndingSignal = (typeof ENDING_SIGNALS)[number];

/** Set for the processes of a batch, which counts how they ended. */
export const IN_BATCH = "TETRAFRONT_IN_BATCH";

type Listener = (signal: EndingSignal) => void;

export function onEndingSignals(listener: Listener): void {
  for (const signal of ENDING_SIGNALS) process.on(signal, listener);
}

export function offEndingSignals(listener: Listener): void {
  for (const signal of ENDING_SIGNALS) process.off(signal, listener);
}

/** The first signal that cancelled calls, if any: a process runs one command. */
let received: EndingSignal | undefined;

/** Says that a signal ends the command. */
export function endsBy(signal: EndingSignal): void {
  received ??= signal;
}

/**
 * Returns the exit code of a command with this one: that of the signal if SIGTERM or SIGHUP cancelled it. After an interrupt, the
 * user has cancelled the command, which is no different from other ends without a result.
 */
export function exitCodeAfterSignals(exitCode: number): number {
  const isEnded = received !== undefined && received !== "SIGINT" && exitCode === 1;
  return isEnded ? 128 + constants.signals[received ?? "SIGTERM"] : exitCode;
}

/** How long a call may say nothing after a signal before the process ends without it, in milliseconds. */
const SILENCE_MS = 1000;
/** How often this is checked, in milliseconds. */
const CHECK_MS = 100;

/**
 * Cancels calls if the process is asked to end. It listens to signals only while a call that can be cancelled is under way:
 * otherwise, and for a second signal, the system ends the process at once, also in the middle of other work. A call whose
 * worker says nothing for a second does not delay the end either.
 */
export class Interruption {
  readonly #stop = new AbortController();
  #calls = 0;
  #heardAt = 0;
  #timer: ReturnType<typeof setInterval> | undefined;
  readonly #onSignal = (signal: EndingSignal): void => {
    // A terminal sends its signal to a batch and to its processes, and the batch then sends them the other one.
    process.off(signal, this.#onSignal);
    endsBy(signal);
    this.#heardAt = performance.now();
    this.#timer ??= setInterval(() => {
      if (performance.now() - this.#heardAt <= SILENCE_MS) return;
      this.#release();
      process.kill(process.pid, signal);
    }, CHECK_MS);
    this.#stop.abort();
  };

  get signal(): AbortSignal {
    return this.#stop.signal;
  }

  /** Says that a call goes on. */
  hear(): void {
    this.#heardAt = performance.now();
  }

  /** Waits for a call that can be cancelled. */
  async during<T>(call: () => Promise<T>): Promise<T> {
    if (this.#calls++ === 0 && !this.signal.aborted) onEndingSignals(this.#onSignal);
    try {
      return await call();
    } finally {
      if (--this.#calls === 0) this.#release();
    }
  }

  #release(): void {
    offEndingSignals(this.#onSignal);
    clearInterval(this.#timer);
  }
}
