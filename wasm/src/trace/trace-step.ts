/** One step of a trace, decoded when it is asked for. */
import type { FrontChange, Refusal } from "./layout.js";
import type { ScoreParts } from "./score.js";

/** x y z. */
export type TracePosition = readonly [number, number, number];

/** A candidate for the fourth node of an element, with the verdict on it. */
export interface TracedCandidate {
  /** Index of the node; null for a new node that was refused. */
  readonly node: number | null;
  /** Whether the node did not exist before this step. */
  readonly isNew: boolean;
  readonly position: TracePosition;
  /** Higher scores are tried first. Four digits are right, two decimals for a pocket; in files of version 3 or earlier, two digits. */
  readonly score: number;
  /** What the score is made of; null in files of version 3 or earlier. */
  readonly parts: ScoreParts | null;
  readonly verdict: "accepted" | Refusal;
  /** Index of the face that the element would cross, or that the new node is too close to; else null. */
  readonly culprit: number | null;
}

/** What every step does to the state; indices of things ever made. */
export interface StepChanges {
  /** The step, from 1. */
  readonly step: number;
  readonly removedFaces: readonly number[];
  readonly addedFaces: readonly number[];
  readonly removedElements: readonly number[];
  readonly addedElements: readonly number[];
  readonly addedNodes: readonly number[];
}

/** A base face and the candidates tried over it. */
export interface AdvanceStep extends StepChanges {
  readonly kind: "advance";
  /** Index of the base face. */
  readonly face: number;
  /** Number of rule classes under which the face has failed before; 0: the strict rules. */
  readonly ruleClass: number;
  /** Whether the step is part of local remeshing, after a stall. */
  readonly isRemeshing: boolean;
  /** Bucket of the face's size; lower ones come first. */
  readonly bucket: number;
  /** Sum of the layers of the face's nodes; in a bucket, lower ones come first. */
  readonly layers: number;
  /** Target edge length in front of the face; in a stretched field, in the space of the tensor. */
  readonly targetEdge: number;
  /** Size tensor xx, yy, zz, xy, xz, yz; null in a field without stretching. */
  readonly tensor: readonly [number, number, number, number, number, number] | null;
  readonly idealPoint: TracePosition;
  /** Number of the front's faces near the face. */
  readonly nearbyFaces: number;
  /** Number of candidates that were ranked; only those tried are listed. */
  readonly rankedCandidates: number;
  /** Candidates tried, in their order. */
  readonly candidates: readonly TracedCandidate[];
  readonly outcome: "accepted" | "postponed";
  /** Rule class under which a postponed face comes again; null if it is set aside, or was completed. */
  readonly nextRuleClass: number | null;
}

/** A step of recovery from a stall. */
export interface RecoveryStep extends StepChanges {
  readonly kind: "recovery";
  readonly change: FrontChange;
}

/** One step of a trace. */
export type TraceStep = AdvanceStep | RecoveryStep;
