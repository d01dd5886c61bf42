/** Numbers and names of the trace file (docs/TRACE.md). */

/** Before the version, the last of the first eight bytes. */
export const MAGIC = "TFTRACE";
export const TRACE_VERSION = 1;

/** Kinds of events, the lowest three bits of an event's first byte. */
export const EVENT = {
  pass: 0,
  base: 1,
  refused: 2,
  accepted: 3,
  postponed: 4,
  change: 5,
  end: 6,
} as const;

export const KIND_BITS = 3;

/** Bits of the detail of a `base` event, above the rule class. */
export const STRETCHED_BIT = 8;
export const REMESHING_BIT = 16;
export const RULE_CLASSES = 5;
/** Bit of the detail of `refused`: the candidate is a new node. */
export const NEW_REFUSED_BIT = 4;
/** Bit of the detail of `accepted`: the candidate is a new node. */
export const NEW_ACCEPTED_BIT = 8;
/** Detail of `postponed`: the face is set aside. */
export const SET_ASIDE = 31;

/** Reasons for refusing a candidate, by their number in the file. */
export const REFUSALS = ["behind", "crosses", "too-close"] as const;
/** See docs/TRACE.md; `behind`: the candidate is not on the empty side of the base face. */
export type Refusal = (typeof REFUSALS)[number];

/** Steps of recovery, by their number in the file. */
export const FRONT_CHANGES = ["star", "reopened", "closed", "undone", "exact-fill"] as const;
/** What a step of recovery does; see docs/TRACE.md. */
export type FrontChange = (typeof FRONT_CHANGES)[number];

/** Ways in which a recorded front ends. */
export const TRACE_STATUSES = ["done", "stalled", "cancelled"] as const;
/** How a recorded front has ended. */
export type TraceStatus = (typeof TRACE_STATUSES)[number];

/** Step at which things die that are part of the final state. */
export const NEVER = 0xffffffff;
/** Index of no node, face or element. */
export const NONE = 0xffffffff;
