import type { Histogram, QualityMeasure } from "../document/mesh-quality";
import type { DrawnFaces, QueriedMesh, ViewOptions } from "./mesh-queries";

/** Messages between the page and the mesh query worker. Types only. */

/** Each query gets one reply, in order. */
export type Query =
  | { readonly kind: "faces"; readonly options: ViewOptions }
  | { readonly kind: "histogram"; readonly measure: QualityMeasure; readonly barCount: number };

export interface Answers {
  readonly faces: DrawnFaces;
  readonly histogram: Histogram;
}

export type Request =
  /** The mesh that all later queries are about; null for none. */
  | { readonly kind: "mesh"; readonly mesh: QueriedMesh | null }
  | { readonly kind: "query"; readonly id: number; readonly query: Query };

export type Reply =
  | { readonly kind: "answer"; readonly id: number; readonly answer: Answers[keyof Answers] }
  | { readonly kind: "failure"; readonly id: number; readonly message: string };
