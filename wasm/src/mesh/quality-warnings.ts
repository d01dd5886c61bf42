/** Warnings about the shapes of a surface's triangles and of a mesh's elements. */
import { plural } from "../base/plural.js";
import type { Steps } from "../base/steps.js";
import { joined, withCounting } from "../diagnostics/describe.js";
import type { Diagnostic, DiagnosticOf } from "../diagnostics/diagnostic.js";
import { nameByIndex } from "../diagnostics/entity-names.js";
import type { SurfaceInput } from "./mesh.js";
import type { ElementQuality, QualityReport } from "./quality.js";
import { triangleShapes } from "./triangle-shapes.js";

/** Smallest dihedral angle, in degrees, that finite elements tolerate well. */
const POOR_ANGLE = 10;
/** Share of poor elements above which a mesh is of little use, however good the others are. */
const MAX_POOR = 0.01;

const REMESH =
  'Remesh the surface (`surface: "remesh"` or `remeshSurface()`), or export it with more uniform triangles.';

/** Number of poor elements that the warning names. */
const NAMED_ELEMENTS = 5;

/** Returns a warning if the triangles are not fit: too many are needles or caps. O(n). */
export function* needleWarnings(surface: SurfaceInput): Steps<Diagnostic[]> {
  const shapes = yield* triangleShapes(surface);
  if (shapes.isFit) return [];
  const { needles: count, triangles } = shapes;
  const warning: DiagnosticOf<"needle-surface"> = {
    code: "needle-surface",
    severity: "warning",
    message: `${shareOf(count, triangles, "triangle")} needles or caps; elements next to them would have small angles`,
    remedy: REMESH,
    entities: [],
    data: { count, triangles },
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
      : 'Use smaller elements in narrow gaps and at sharp edges, or `optimization: "thorough"`.',
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
