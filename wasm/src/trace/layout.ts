/** Numbers and names of the trace file (docs/TRACE.md). */

/** Before the version, the last of the first eight bytes. */
export const MAGIC = "TFTRACE";
export const TRACE_VERSION = 3;
/** Version without sweeps of the optimizer. */
export const FRONT_ONLY_VERSION = 2;
/** Version without events of lines and patches. */
export const VOLUME_ONLY_VERSION = 1;

/** Kinds of events, the lowest three bits of an event's first byte. */
export const EVENT = {
  pass: 0,
  base: 1,
  refused: 2,
  accepted: 3,
  postponed: 4,
  change: 5,
  end: 6,
  sweep: 7,
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

/** Kinds of sweeps, by their number in the file, from 1. */
export const SWEEP_KINDS = ["swap", "move", "newton", "split", "collapse", "improve", "last-resort"] as const;
/** What a sweep of the optimizer does; see docs/TRACE.md. */
export type SweepKind = (typeof SWEEP_KINDS)[number];
/** Detail of the event after which the mesh of an earlier sweep is the result. */
export const SWEEP_RESTORED = 8;
/** Bit of the detail of a `sweep` event: the changed nodes and elements follow. */
export const SWEEP_GEOMETRY_BIT = 16;

/** Ways in which a recorded front ends. */
export const TRACE_STATUSES = ["done", "stalled", "cancelled"] as const;
/** How a recorded front has ended. */
export type TraceStatus = (typeof TRACE_STATUSES)[number];

/** Kinds of events of lines and patches, the lowest four bits of an event's first byte; 0 is the first of the volume. */
export const SURFACE_EVENT = {
  line: 1,
  station: 2,
  divided: 3,
  halved: 4,
  numbered: 5,
  patch: 6,
  base: 7,
  refused: 8,
  accepted: 9,
  postponed: 10,
  ended: 11,
  improved: 12,
} as const;

export const SURFACE_KIND_BITS = 4;

/** Bits of the detail of a `patch` event. */
export const CURVED_BIT = 1;
export const REPEATED_BIT = 2;
export const CARRIERS_BIT = 4;
/** Bit of the detail of a `base` event of a patch, above the pass: size and metric are those of the base edge before. */
export const SAME_SAMPLE_BIT = 4;
export const PASSES = 3;
/** Bit of the detail of `refused` and `accepted` in a patch: the candidate is a new node. */
export const NEW_NODE_BIT = 8;
/** Detail of `postponed` in a patch: the edge is set aside. */
export const EDGE_SET_ASIDE = 15;

/** Where a step along a line ends, by its number in the file. */
export const STATION_ENDS = ["settled", "capped", "knot"] as const;
/** `settled`: where the side of step S3 ends; `capped`: at the limit of the parameter; `knot`: at a knot of the line. */
export type StationEnd = (typeof STATION_ENDS)[number];

/** Reasons for refusing a candidate over an edge of a 2-D front, by their number in the file. */
export const EDGE_REFUSALS = ["behind", "crosses", "too-close", "same-node", "outside"] as const;
/** See docs/TRACE.md; `behind`: the candidate is not on the unmeshed side of the base edge. */
export type EdgeRefusal = (typeof EDGE_REFUSALS)[number];

/** Ways in which a 2-D front ends, by their number in the file. */
export const PLANAR_ENDS = ["covered", "stalled", "stopped"] as const;
/**
 * `covered`: the front has covered its patch; `stalled`: edges were set aside, because the patch folds over itself or rules were
 * taken away; `stopped`: it was ended while it had edges to take.
 */
export type PlanarEnd = (typeof PLANAR_ENDS)[number];

/** Step at which things die that are part of the final state. */
export const NEVER = 0xffffffff;
/** Index of no node, face or element. */
export const NONE = 0xffffffff;

/** Number of events, or of items of a list, in a slice of reading: some milliseconds of work. */
export const EVENTS_PER_SLICE = 128;
