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

  /** `step`: word for work other than a run, which has no elements yet. */
  update({ fraction, phase, tetrahedra, frontFaces, exactFillFraction }: CallProgress, step?: string): void {
    const left =
      exactFillFraction > 0
        ? `exact fill of remaining pockets: ${(100 * exactFillFraction).toFixed(1)} %`
        : `${String(frontFaces)} front faces`;
    const details = step === undefined ? ` | ${tetrahedra} tetrahedra | ${left}` : "";
    this.#bar.update(fraction, { phase: (step ?? phase).padEnd("surface".length), details });
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
