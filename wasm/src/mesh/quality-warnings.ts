/** Warnings about the shapes of a surface's triangles and of a mesh's elements. */
import { plural } from "../base/plural.js";
import { type Steps, stepwise } from "../base/steps.js";
import { joined, withCounting } from "../diagnostics/describe.js";
import type { Diagnostic, DiagnosticOf } from "../diagnostics/diagnostic.js";
import { nameByIndex } from "../diagnostics/entity-names.js";
import type { SurfaceInput } from "./mesh.js";
import type { ElementQuality, QualityReport } from "./quality.js";

/** Needles and caps, as the engine's statistics count them (quality_statistics.h). */
const NEEDLE_RADIUS_RATIO = 0.3;
/** Share of needles above which they shape a large part of the mesh: each has several elements next to it. */
const MAX_NEEDLES = 0.1;
/** Smallest dihedral angle, in degrees, that finite elements tolerate well. */
const POOR_ANGLE = 10;
/** Share of poor elements above which a mesh is of little use, however good the others are. */
const MAX_POOR = 0.01;

const REMESH =
  "Remesh the surface (--surface remesh or remeshSurface()), or export it with more uniform triangles.";

/** Number of poor elements that the warning names. */
const NAMED_ELEMENTS = 5;

/** Returns a warning if more than a tenth of the triangles are needles or caps. O(n). */
export function* needleWarnings({ points, triangles }: SurfaceInput): Steps<Diagnostic[]> {
  let count = 0;
  const all = triangles.length / 3;
  yield* stepwise(all, (t) => {
    if (radiusRatio(points, triangles.subarray(3 * t, 3 * t + 3)) < NEEDLE_RADIUS_RATIO) count++;
  });
  if (count <= MAX_NEEDLES * all) return [];
  const warning: DiagnosticOf<"needle-surface"> = {
    code: "needle-surface",
    severity: "warning",
    message: `${shareOf(count, all, "triangle")} needles or caps; elements next to them will have small angles`,
    remedy: REMESH,
    entities: [],
    data: { count, triangles: all },
  };
  return [warning];
}

/** Returns a warning that names the worst elements if more than one in a hundred has a dihedral angle below 10°. */
export function poorElementWarnings(quality: QualityReport): Diagnostic[] {
  const { regions, binWidths, limitedByBoundary } = quality;
  const bins = POOR_ANGLE / binWidths.dihedral;
  const all = regions.reduce((sum, { tetrahedra }) => sum + tetrahedra, 0);
  const count = regions.reduce(
    (sum, { smallestDihedral }) => sum + smallestDihedral.slice(0, bins).reduce((a, b) => a + b, 0),
    0,
  );
  if (count <= MAX_POOR * all) return [];
  const { edges, needles, narrowGaps } = limitedByBoundary;
  const isByNeedles = needles > edges + narrowGaps;
  const worst = worstOf(quality);
  const entities = worst.map(({ tetrahedron }) => nameByIndex("tetrahedron", tetrahedron));
  const names = joined(entities.map(({ label }) => label));
  const share = `${shareOf(count, all, "tetrahedron")} poor`;
  const message = `${share}: their smallest dihedral angle is below ${POOR_ANGLE}°; the worst ${worst.length === 1 ? "is" : "are"} ${names}`;
  const warning: DiagnosticOf<"poor-elements"> = {
    code: "poor-elements",
    severity: "warning",
    message: withCounting(message, entities),
    remedy: isByNeedles
      ? REMESH
      : "Use smaller elements in narrow gaps and at sharp edges, or --optimize thorough.",
    entities,
    position: worst[0]?.centroid,
    data: { count, tetrahedra: all },
  };
  return [warning];
}

/** Returns the poor elements with the smallest angles, of those that the report lists. */
function worstOf({ worst, limitedByBoundary }: QualityReport): ElementQuality[] {
  const listed = new Map([...worst, ...limitedByBoundary.worst].map((one) => [one.tetrahedron, one]));
  return [...listed.values()]
    .filter(({ dihedral }) => dihedral.min < POOR_ANGLE)
    .sort((a, b) => a.dihedral.min - b.dihedral.min || a.tetrahedron - b.tetrahedron)
    .slice(0, NAMED_ELEMENTS);
}

/** Returns "1 of 8 triangles (13 %) is" or "3 of 8 triangles (38 %) are". */
function shareOf(count: number, all: number, noun: string): string {
  return `${count} of ${plural(all, noun)} (${Math.round((100 * count) / all)} %) ${count === 1 ? "is" : "are"}`;
}

/** Returns 2 × inradius / circumradius: 1 for the equilateral triangle, 0 without area or of invalid nodes. */
function radiusRatio(points: Float64Array, [a = 0, b = 0, c = 0]: Uint32Array): number {
  const [p, q, r] = [distance(points, a, b), distance(points, b, c), distance(points, c, a)];
  const product = (q + r - p) * (r + p - q) * (p + q - r);
  return product > 0 ? product / (p * q * r) : 0;
}

function distance(points: Float64Array, a: number, b: number): number {
  const along = (axis: number) => (points[3 * b + axis] ?? 0) - (points[3 * a + axis] ?? 0);
  return Math.hypot(along(0), along(1), along(2));
}
