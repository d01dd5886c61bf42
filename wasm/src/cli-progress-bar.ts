import { Presets, SingleBar } from "cli-progress";

import type { Progress } from "./types.js";

/** A progress bar on stderr, for terminals. */
export class ProgressBar {
  readonly #bar = new SingleBar(
    {
      format: "{phase} {bar} {percentage} % | {tetrahedra} tetrahedra | {frontFaces} faces in the front",
      stream: process.stderr,
      clearOnComplete: true,
      hideCursor: true,
      // Interrupting is the command's own business.
      gracefulExit: false,
    },
    Presets.shades_classic,
  );

  constructor() {
    this.#bar.start(1, 0, { phase: "check", tetrahedra: 0, frontFaces: 0 });
  }

  update({ fraction, phase, tetrahedra, frontFaces }: Progress): void {
    this.#bar.update(fraction, { phase: phase.padEnd("surface".length), tetrahedra, frontFaces });
  }

  stop(): void {
    this.#bar.stop();
  }
}
