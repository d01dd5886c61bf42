import { MultiBar, Presets, SingleBar } from "cli-progress";

import type { Progress } from "../api/types.js";

/** A progress bar on stderr, for terminals. */
export class ProgressBar {
  readonly #bar = new SingleBar(
    {
      format: "{phase} {bar} {percentage} % | {tetrahedra} tetrahedra | {left}",
      stream: process.stderr,
      clearOnComplete: true,
      hideCursor: true,
      // Interrupting is the command's own business.
      gracefulExit: false,
    },
    Presets.shades_classic,
  );

  constructor() {
    this.#bar.start(1, 0, { phase: "check", tetrahedra: 0, left: "" });
  }

  update({ fraction, phase, tetrahedra, frontFaces, exactFillFraction }: Progress): void {
    const left =
      exactFillFraction > 0
        ? `exact fill of what the front left: ${(100 * exactFillFraction).toFixed(1)} %`
        : `${String(frontFaces)} faces in the front`;
    this.#bar.update(fraction, { phase: phase.padEnd("surface".length), tetrahedra, left });
  }

  stop(): void {
    this.#bar.stop();
  }
}

/** How many files of a batch are through, with messages above it. */
export class BatchBar {
  readonly #bars = new MultiBar(
    {
      format: "{bar} {value} of {total} files",
      stream: process.stderr,
      clearOnComplete: true,
      hideCursor: true,
      gracefulExit: false,
    },
    Presets.shades_classic,
  );
  readonly #bar;

  constructor(files: number) {
    this.#bar = this.#bars.create(files, 0);
  }

  advance(): void {
    this.#bar.increment();
  }

  say(lines: string): void {
    this.#bars.log(lines);
  }

  stop(): void {
    this.#bars.stop();
  }
}
