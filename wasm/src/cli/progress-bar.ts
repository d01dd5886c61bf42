import { MultiBar, Presets, SingleBar } from "cli-progress";
import type { CallProgress } from "../base/progress.js";

/** Progress bar on stderr, for terminals. */
export class ProgressBar {
  readonly #bar = new SingleBar(
    {
      format: "{phase} {bar} {percentage} %{details}",
      stream: process.stderr,
      clearOnComplete: true,
      hideCursor: true,
      // The command handles signals itself.
      gracefulExit: false,
    },
    Presets.shades_classic,
  );

  constructor() {
    this.#bar.start(1, 0, { phase: "check", details: "" });
  }

  /** Shows how far the work is; `timeLeft`: text, empty if it is not known. */
  update(
    { fraction, phase, tetrahedra, frontFaces, exactFillFraction }: CallProgress,
    timeLeft: string,
  ): void {
    const open =
      exactFillFraction > 0
        ? `exact fill of remaining pockets: ${(100 * exactFillFraction).toFixed(1)} %`
        : `${String(frontFaces)} front faces`;
    const made = tetrahedra > 0 ? [`${tetrahedra} tetrahedra`, open] : [];
    const details = [...made, timeLeft].map((text) => text && ` | ${text}`).join("");
    this.#bar.update(fraction, { phase: phase.padEnd("surface".length), details });
  }

  stop(): void {
    this.#bar.stop();
  }
}

/** Progress bar for a batch of files, with messages above it. */
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

  print(lines: string): void {
    this.#bars.log(lines);
  }

  stop(): void {
    this.#bars.stop();
  }
}
