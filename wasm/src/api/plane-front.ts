/** Fills polygons by the loaded module, and reads the record of the steps. */
import * as v from "valibot";
import { withoutPause } from "../base/steps.js";
import { checkArgument } from "../calls/argument-checks.js";
import { objectWith } from "../calls/schemas.js";
import { failureError } from "../diagnostics/mesher-error.js";
import type { EngineFill, PlaneEngine } from "../engine/plane-loader.js";
import { failureOf } from "../engine/slices.js";
import { FRONT_ORDERS, PLANE_DEFAULTS, PLANE_STATUSES, type PlaneStatus } from "../generated/constants.js";
import { joined } from "../formats/bytes.js";
import { MAX_TOLERANCE } from "../trace/experiment.js";
import { Fingerprint } from "../trace/fingerprint.js";
import { SurfaceReplay } from "../trace/surface-replay.js";
import { SurfaceTrace } from "../trace/surface-trace.js";
import { TraceCursor } from "../trace/trace-cursor.js";
import { loopName, loopsSchema, planeLoops, type PlaneLoops, segmentOf } from "./plane-loops.js";
import { type PlaneField, planeField, sizesSchema } from "./plane-sizes.js";
import type {
  FilledPlane,
  FillPlaneOptions,
  FillPlaneResult,
  PlaneLoop,
  PlaneMesh,
  PlaneSizes,
  UnfilledPlane,
} from "./plane-types.js";

const wholeNumber = (max: number) => v.pipe(v.number(), v.safeInteger(), v.minValue(0), v.maxValue(max));
const MAX_UINT32 = 0xffffffff;
const MIN_HEIGHT = 0.1;
const MAX_HEIGHT = 10;

const optionsSchema = objectWith({
  order: v.optional(v.picklist(FRONT_ORDERS)),
  seed: v.optional(wholeNumber(MAX_UINT32)),
  boundary: v.optional(v.picklist(["divided", "given"])),
  improve: v.optional(v.boolean()),
  height: v.optional(v.pipe(v.number(), v.minValue(MIN_HEIGHT), v.maxValue(MAX_HEIGHT))),
  maxSteps: v.optional(wholeNumber(PLANE_DEFAULTS.maxSteps)),
  experiment: v.optional(
    objectWith({
      relaxation: v.optional(v.boolean()),
      tolerance: v.optional(v.pipe(v.number(), v.minValue(0), v.maxValue(MAX_TOLERANCE))),
    }),
  ),
});

/** Fills a polygon; throws a `MesherError` if an argument is of another kind, an option is invalid or memory runs out. */
export function filledPlane(
  engine: PlaneEngine,
  loops: readonly PlaneLoop[],
  sizes: PlaneSizes,
  options: FillPlaneOptions,
): FillPlaneResult {
  checkArgument("loops", loops, loopsSchema);
  checkArgument("sizes", sizes, sizesSchema);
  checkArgument("options", options, optionsSchema);
  const polygon = planeLoops(loops);
  if ("success" in polygon) return polygon;
  const field = planeField(sizes, polygon);
  if ("success" in field) return field;
  const fill = answerOf(engine, polygon, field, options);
  const status = PLANE_STATUSES[fill.status] ?? "stalled";
  return status === "done" || status === "stalled" || status === "stopped"
    ? recordOf(fill, status)
    : unfilled(polygon, status, [...fill.culprits]);
}

function answerOf(
  engine: PlaneEngine,
  { points, counts }: PlaneLoops,
  { size, grid }: PlaneField,
  { boundary = "divided", order = PLANE_DEFAULTS.order, experiment = {}, ...options }: FillPlaneOptions,
): EngineFill {
  const { seed, improve, height, maxSteps } = { ...PLANE_DEFAULTS, ...definedOf(options) };
  const { relaxation = true, tolerance = 1 } = experiment;
  const work = engine.fillPlane(
    points,
    counts,
    grid,
    {
      size,
      order: FRONT_ORDERS.indexOf(order),
      seed,
      divide: boundary === "divided",
      improve,
      height,
      maxSteps,
    },
    { relaxation, tolerance, linearSearch: false },
  );
  const bytes = engine.memoryBytes();
  if (work === null) throw failureError({ reason: "out-of-memory", message: "", bytes }, undefined, 0);
  try {
    const fill = work.result();
    const reason = failureOf(work);
    if (reason !== "none")
      throw failureError({ reason, message: work.failureMessage(), bytes }, undefined, 0);
    return fill;
  } finally {
    work.delete();
  }
}

/** Returns the options that are not undefined. */
function definedOf<T extends object>(options: T): { [Key in keyof T]?: Exclude<T[Key], undefined> } {
  return Object.fromEntries(Object.entries(options).filter(([, value]) => value !== undefined)) as {
    [Key in keyof T]?: Exclude<T[Key], undefined>;
  };
}

/** The first byte of a trace after the events of lines and patches. */
const END_OF_SURFACE = Uint8Array.of(0);

function recordOf({ events, points, triangles }: EngineFill, status: FilledPlane["status"]): FilledPlane {
  const cursor = new TraceCursor(joined([events, END_OF_SURFACE]));
  const replayed = withoutPause(new SurfaceReplay(cursor).readEvents());
  const [front] = replayed.fronts;
  if (front === undefined) throw new RangeError("the record of a polygon has no front");
  // Nodes of the surface: those of the boundary have other indices than in the patch, the others follow.
  const positions = new Float64Array((3 * points.length) / 2);
  for (let node = 0; 2 * node < points.length; node++) {
    const at = 3 * (front.surfaceNodes[node] ?? node);
    positions.set(points.subarray(2 * node, 2 * node + 2), at);
  }
  const mesh = { points, triangles };
  return {
    success: true,
    status,
    trace: new SurfaceTrace(cursor.file, replayed, positions),
    front,
    mesh,
    get fingerprint() {
      return fingerprintOf(mesh);
    },
  };
}

function fingerprintOf({ points, triangles }: PlaneMesh): string {
  const fingerprint = new Fingerprint();
  fingerprint.addDoubles(points);
  fingerprint.addIntegers(triangles);
  return fingerprint.text();
}

function unfilled(
  loops: PlaneLoops,
  status: Exclude<PlaneStatus, FilledPlane["status"]>,
  [first = 0, second = 0]: readonly number[],
): UnfilledPlane {
  const base = { success: false, code: status, loops: [], segments: [] } as const;
  switch (status) {
    case "crossing": {
      const segments = [segmentOf(loops, first), segmentOf(loops, second)] as const;
      return {
        ...base,
        message: crossingText(segments),
        remedy: "Move a corner so that the segments do not meet.",
        loops: [...new Set(segments.map(({ loop }) => loop))],
        segments,
      };
    }
    case "hole-outside":
      return {
        ...base,
        message: `${loopName(first)} is outside the outer loop`,
        remedy: "Move it into the outer loop.",
        loops: [first],
      };
    case "nested-holes":
      return {
        ...base,
        message: `${loopName(first)} is inside ${loopName(second)}`,
        remedy: "Move it out, or fill it as a polygon of its own.",
        loops: [first, second],
      };
    case "too-many-sides": {
      const segment = segmentOf(loops, first);
      return {
        ...base,
        message: `the sizes ask for more than 10 000 sides, counted up to segment ${segment.segment} of ${loopName(segment.loop)}`,
        remedy: "Use larger sizes.",
        loops: [segment.loop],
        segments: [segment],
      };
    }
  }
}

function crossingText([a, b]: readonly [
  UnfilledPlane["segments"][number],
  UnfilledPlane["segments"][number],
]): string {
  return a.loop === b.loop
    ? `${loopName(a.loop)} crosses itself: segments ${a.segment} and ${b.segment} meet`
    : `segment ${a.segment} of ${loopName(a.loop)} meets segment ${b.segment} of ${loopName(b.loop)}`;
}
