/** Candidates as bars, in the order in which they are tried: each bar is stacked from the parts of the score. */
import { digits, element } from "../../kit/dom";

export interface BarPart {
  /** Style of the part. */
  readonly kind: "shape" | "ideal" | "closing" | "wedge" | "pocket" | "lost";
  readonly label: string;
  /** Length; what is taken away is above 0 as well. */
  readonly value: number;
}

export interface ListedCandidate {
  /** Unique name, also shown. */
  readonly name: string;
  /** What the mark before the name shows. */
  readonly look: "accepted" | "refused" | "idle";
  readonly isNew: boolean;
  readonly parts: readonly BarPart[];
  readonly score: number;
  readonly decimals: number;
  /** Shape of its element, from 0 to 1. */
  readonly shape: number;
  readonly verdict: string;
  /** Corners of its triangle, for a picture; y goes up. */
  readonly triangle?: readonly (readonly [number, number])[];
}

/** Milliseconds in which a row moves to its place, and some more. */
const moveTime = 450;
/** Pixels of the picture of a triangle. */
const [pictureWidth, pictureHeight] = [38, 34] as const;

export interface ListOptions {
  /** Length of a whole bar. */
  readonly axis: number;
  /** A score that is marked in every bar. */
  readonly threshold?: number;
  /** Name of the candidate that is lit. */
  readonly lit: string | null;
}

/** Returns the corners of a triangle that fills the picture. */
function fitted(triangle: readonly (readonly [number, number])[]): string {
  const [xs, ys] = [triangle.map(([x]) => x), triangle.map(([, y]) => y)];
  const [left, right, low, high] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
  const scale = Math.min((pictureWidth - 4) / (right - left), (pictureHeight - 4) / (high - low));
  return triangle
    .map(([x, y]) => {
      const px = pictureWidth / 2 + (x - (left + right) / 2) * scale;
      const py = pictureHeight / 2 - (y - (low + high) / 2) * scale;
      return `${px.toFixed(1)},${py.toFixed(1)}`;
    })
    .join(" ");
}

class Row {
  readonly element: HTMLElement;
  readonly #name = element("span", { class: "name" });
  readonly #polygon = document.createElementNS("http://www.w3.org/2000/svg", "polygon");
  readonly #bar = element("span", { class: "stack" });
  readonly #score = element("span", { class: "score" });
  readonly #verdict = element("span", { class: "verdict" });

  constructor(name: string, hasPicture: boolean, light: (isLit: boolean) => void) {
    const picture = document.createElementNS("http://www.w3.org/2000/svg", "svg");
    picture.setAttribute("aria-hidden", "true");
    picture.append(this.#polygon);
    this.#name.append(...(hasPicture ? [picture] : []), element("b", {}, name));
    this.element = element(
      "li",
      { class: "candidate", tabindex: "0" },
      this.#name,
      this.#bar,
      this.#score,
      this.#verdict,
    );
    for (const [type, isLit] of [
      ["pointerenter", true],
      ["focus", true],
      ["pointerleave", false],
      ["blur", false],
    ] as const)
      this.element.addEventListener(type, () => light(isLit));
  }

  show(candidate: ListedCandidate, rank: number, { axis, threshold, lit }: ListOptions): void {
    this.element.dataset["look"] = candidate.look;
    this.element.toggleAttribute("data-new", candidate.isNew);
    this.element.toggleAttribute("data-lit", candidate.name === lit);
    this.element.style.setProperty("--rank", String(rank));
    this.#score.textContent = digits(candidate.score, candidate.decimals);
    this.#verdict.replaceChildren(
      candidate.verdict,
      element("small", {}, `shape ${digits(candidate.shape, 2)}`),
    );
    if (candidate.triangle) this.#polygon.setAttribute("points", fitted(candidate.triangle));
    this.#bar.toggleAttribute("data-threshold", threshold !== undefined);
    if (threshold !== undefined) this.#bar.style.setProperty("--threshold", `${(100 * threshold) / axis}%`);
    this.#bar.replaceChildren(
      ...candidate.parts
        .filter(({ value }) => value > 1e-4)
        .map(({ kind, label, value }) => {
          const part = element("span", {
            class: kind,
            title: `${label} ${digits(value, candidate.decimals)}`,
          });
          part.style.width = `${(100 * value) / axis}%`;
          return part;
        }),
    );
    const parts = candidate.parts
      .filter(({ value }) => value > 1e-4)
      .map(
        ({ kind, label, value }) =>
          `${label} ${kind === "lost" ? "−" : ""}${digits(value, candidate.decimals)}`,
      );
    this.element.setAttribute(
      "aria-label",
      `${rank + 1}. ${candidate.name}: ${digits(candidate.score, candidate.decimals)}, ${candidate.verdict}. ${parts.join(", ")}`,
    );
  }
}

export class CandidateList {
  readonly element = element("ol", { class: "candidate-list" });
  readonly #rows = new Map<string, Row>();
  #sorting = 0;

  /** @param light Lights a candidate by its name; null for none. */
  constructor(readonly light: (name: string | null) => void) {}

  show(candidates: readonly ListedCandidate[], options: ListOptions): void {
    const names = new Set(candidates.map(({ name }) => name));
    for (const [name, row] of this.#rows)
      if (!names.has(name)) {
        row.element.remove();
        this.#rows.delete(name);
      }
    candidates.forEach((candidate, rank) => {
      let row = this.#rows.get(candidate.name);
      if (!row) {
        row = new Row(candidate.name, candidate.triangle !== undefined, (isLit) =>
          this.light(isLit ? candidate.name : null),
        );
        this.#rows.set(candidate.name, row);
        this.element.append(row.element);
      }
      row.show(candidate, rank, options);
    });
    this.element.style.setProperty("--rows", String(candidates.length));
    // Keys and screen readers follow the order of the elements. It changes after the rows have moved, which it would stop.
    clearTimeout(this.#sorting);
    this.#sorting = window.setTimeout(() => this.#sort(candidates), moveTime);
  }

  #sort(candidates: readonly ListedCandidate[]): void {
    if (this.element.contains(document.activeElement)) return;
    const sorted = candidates.flatMap(({ name }) => this.#rows.get(name)?.element ?? []);
    if (sorted.some((row, i) => row !== this.element.children[i])) this.element.append(...sorted);
  }
}
