import type { Histogram, QualityMeasure } from "../document/mesh-quality";
import type { DrawnFaces, Look, Surveyed } from "./mesh-queries";

/** What the page and the surveying worker say to each other. Types only. */

/** Each is answered once, in order. */
export type Question =
  | { readonly kind: "faces"; readonly look: Look }
  | { readonly kind: "histogram"; readonly measure: QualityMeasure; readonly barCount: number };

export interface Answers {
  readonly faces: DrawnFaces;
  readonly histogram: Histogram;
}

export type Request =
  /** The mesh that all later questions are about; null for none. */
  | { readonly kind: "mesh"; readonly mesh: Surveyed | null }
  | { readonly kind: "question"; readonly id: number; readonly question: Question };

export type Reply =
  | { readonly kind: "answer"; readonly id: number; readonly answer: Answers[keyof Answers] }
  | { readonly kind: "failure"; readonly id: number; readonly message: string };
