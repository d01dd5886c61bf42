/** Texts about the film of a step, and about the filled volume at its end. */
import { formatCounted } from "../../strings/format";

const short = (value: number): string => Number(value.toPrecision(3)).toString();

export const filmStrings = {
  film: "Film of the step",
  filmHint:
    "A step at rest is shown beat by beat, with only what is near it. At 1 step per second and slower, playing shows every beat.",
  beat: "Beat of the step",
  noBeats: "This step has no beats.",
  beatOf: (beat: number, beats: number, name: string) => `${beat} of ${beats}: ${name}`,
  /** Names on the scale of the beats: short, so that five fit beside each other on a phone. */
  beats: {
    base: "active face",
    ideal: "ideal point",
    candidates: "candidates",
    test: "test",
    element: "new element",
    postponed: "postponed",
    pocket: "pocket",
    node: "node",
    star: "star",
    filled: "exact fill",
    opened: "opened",
    attempt: "attempt",
    undone: "undone",
    edge: "active edge",
    triangle: "new triangle",
    station: "station",
    averages: "averages",
    side: "next side",
  },
  /** What an early beat shows, where the lens says later why the step ended as it did. */
  sentences: {
    base: "The front takes its active face: an element is to be made over it.",
    ideal:
      "The ideal point is where a new node would make the best element. Nodes in the circles around it are candidates.",
    candidates: (count: number) =>
      count === 1
        ? "One candidate is tried."
        : `${formatCounted(count, "candidate")} are tried, the best score first.`,
  },
  planarSentences: {
    edge: "The front takes its active edge: a triangle is to be made over it.",
    ideal: "The ideal point is where a new node would make the best triangle.",
  },
  /** Instead of the verdict on a candidate, in beats before the test. */
  untested: "not tested yet",
  /** Labels of a station on a line. */
  station: {
    size: (size: number) => `size ${short(size)}`,
    averages: (rounds: number) => (rounds === 0 ? "no averaging" : formatCounted(rounds, "averaging")),
    side: (length: number) => `side ${short(length)}`,
  },
  pullApart: "Cut them open, or pull them apart, with the sliders below the steps.",
  filled: "Filled volume",
  apart: "Pull apart",
  apartText: (share: number) => `${Math.round(100 * share)} %`,
  cut: "Cut",
  /** Names of the dots of candidates in the view. */
  candidate: (rank: number, name: string, verdict: string) => `Candidate ${rank}, ${name}: ${verdict}`,
  candidates: "Candidates in the view",
} as const;

/** What a part of a film shows. */
export type Beat = keyof typeof filmStrings.beats;
