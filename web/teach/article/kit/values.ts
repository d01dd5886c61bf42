/** The values of one figure: inputs that the reader sets within their ranges, and values that the figure computes. */
import { batch, signal, type Signal } from "@preact/signals-core";
import type { FigurePlan, Range } from "../declaration";

export type Value = number | string;

export class Values {
  readonly #signals = new Map<string, Signal<Value | undefined>>();
  readonly #ranges: Readonly<Record<string, Range>>;

  constructor(plan: Pick<FigurePlan, "ranges" | "words">) {
    this.#ranges = plan.ranges;
    for (const [name, { start }] of Object.entries(plan.ranges)) this.#signal(name).value = start;
    for (const [name, word] of Object.entries(plan.words)) this.#signal(name).value = word;
  }

  /** Returns a value and notes within an effect that it was read; undefined before the figure has computed it. */
  get(name: string): Value | undefined {
    return this.#signal(name).value;
  }

  /** Returns a number; NaN if the value is a text or not known. */
  number(name: string): number {
    const value = this.get(name);
    return typeof value === "number" ? value : NaN;
  }

  word(name: string): string {
    const value = this.get(name);
    return typeof value === "string" ? value : "";
  }

  range(name: string): Range | undefined {
    return this.#ranges[name];
  }

  /** Sets an input as a reader asks: within its range, at a multiple of its step. */
  ask(name: string, value: number): void {
    const range = this.#ranges[name];
    if (!range || Number.isNaN(value)) return;
    const steps = Math.round((value - range.min) / range.step);
    const rounded = Number((range.min + steps * range.step).toFixed(9));
    this.#signal(name).value = Math.min(range.max, Math.max(range.min, rounded));
  }

  /** Sets values that the figure has computed; truth values become 1 and 0. */
  put(values: Readonly<Record<string, Value | boolean>>): void {
    batch(() => {
      for (const [name, value] of Object.entries(values))
        this.#signal(name).value = typeof value === "boolean" ? Number(value) : value;
    });
  }

  /** Returns all values, for tests. */
  all(): Readonly<Record<string, Value>> {
    const known = [...this.#signals].flatMap(([name, { value }]) =>
      value === undefined ? [] : [[name, value]],
    );
    return Object.fromEntries(known) as Record<string, Value>;
  }

  #signal(name: string): Signal<Value | undefined> {
    let known = this.#signals.get(name);
    if (!known) this.#signals.set(name, (known = signal(undefined)));
    return known;
  }
}
