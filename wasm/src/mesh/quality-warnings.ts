/** Warnings about the shapes of a surface's triangles and of a mesh's elements. */
import { plural } from "../base/plural.js";
import { positionText } from "../base/position-text.js";
import type { Steps } from "../base/steps.js";
import { joined, withCounting } from "../diagnostics/describe.js";
import type { Diagnostic, DiagnosticOf } from "../diagnostics/diagnostic.js";
import { nameByIndex } from "../diagnostics/entity-names.js";
import { MESH_DEFAULTS } from "../generated/constants.js";
import type { SurfaceInput } from "./mesh.js";
import type { ElementQuality, PoorElements, QualityReport } from "./quality.js";
import { type TriangleShapes, triangleShapes } from "./triangle-shapes.js";

/** Smallest dihedral angle, in degrees, that finite elements tolerate well. */
const POOR_ANGLE = 10;
/** Dihedral angles, in degrees, beyond which a single element spoils a computation. */
const HARMFUL_ANGLE = 5;
const HARMFUL_OBTUSE_ANGLE = 170;
/** Share of poor elements above which a mesh is of little use, however good the others are. */
const MAX_POOR = 0.01;

const REMESH =
  'Remesh the surface (`surface: "remesh"` or `remeshSurface()`), or export it with more uniform triangles.';

/** Significant digits of positions: an element is larger than what they leave out. */
const DIGITS = 4;

/** Number of poor elements that the warning names. */
const NAMED_ELEMENTS = 5;

/** Returns a warning if the triangles are not fit: too many are needles or caps, or one spoils the elements beside it. O(n). */
export function* needleWarnings(surface: SurfaceInput): Steps<Diagnostic[]> {
  const shapes = yield* triangleShapes(surface);
  return shapes.isFit ? [] : [needleWarning(shapes)];
}

/**
 * Returns a warning if a few needles among good triangles spoil the elements beside them: too few to count among the poor
 * elements. O(n).
 */
export function* harmfulNeedles(surface: SurfaceInput): Steps<Diagnostic[]> {
  const shapes = yield* triangleShapes(surface);
  return shapes.isFit || shapes.statedSize === undefined ? [] : [needleWarning(shapes)];
}

function needleWarning({ needles: count, triangles, smallestAngle }: TriangleShapes): Diagnostic {
  const warning: DiagnosticOf<"needle-surface"> = {
    code: "needle-surface",
    severity: "warning",
    message: `${shareOf(count, triangles, "triangle")} ${count === 1 ? "a needle or cap" : "needles or caps"}; elements next to them would have small angles. The smallest angle of a triangle is ${angleText(smallestAngle)}`,
    remedy: REMESH,
    entities: [],
    data: { count, triangles },
  };
  return warning;
}

/**
 * Returns a warning that names the worst elements, with the reason of the worst one, if more than one in a hundred has a dihedral
 * angle below 10°, or one has an angle below 5° or above 170°. `isGiven`: whether another program made the mesh.
 */
export function poorElementWarnings(quality: QualityReport, isGiven = false): Diagnostic[] {
  const { regions, binWidths, poor, shapes } = quality;
  const bins = POOR_ANGLE / binWidths.dihedral;
  const all = regions.reduce((sum, { tetrahedra }) => sum + tetrahedra, 0);
  const count = regions.reduce(
    (sum, { smallestDihedral }) => sum + smallestDihedral.slice(0, bins).reduce((a, b) => a + b, 0),
    0,
  );
  const isObtuse = shapes.dihedral.max > HARMFUL_OBTUSE_ANGLE;
  const isHarmful = poor.worst !== null && (isObtuse || poor.worst.dihedral.min < HARMFUL_ANGLE);
  if (count <= MAX_POOR * all && !isHarmful) return [];
  const worst = worstOf(quality);
  const entities = worst.map(({ tetrahedron }) => nameByIndex("tetrahedron", tetrahedron));
  const names = joined(entities.map(({ label }) => label));
  const share = `${shareOf(count, all, "tetrahedron")} poor`;
  const message = `${share}: ${count === 1 ? "its" : "their"} smallest dihedral angle is below ${POOR_ANGLE}°; the worst ${worst.length === 1 ? "is" : "are"} ${names}`;
  const warning: DiagnosticOf<"poor-elements"> = {
    code: "poor-elements",
    severity: "warning",
    message: `${withCounting(message, entities)}${reasonText(poor)}${isObtuse ? `. The largest angle is ${Math.round(shapes.dihedral.max)}°` : ""}`,
    remedy: remedyFor(quality, isGiven),
    entities,
    position: worst[0]?.centroid,
    data: { count, tetrahedra: all, reason: poor.reason, angle: worst[0]?.dihedral.min ?? 0 },
  };
  return [warning];
}

/** Returns where the worst element is, its angle and the reason, as the end of a sentence. */
function reasonText({ worst, reason, value, edge }: PoorElements): string {
  if (worst === null) return "";
  const begin = `. The smallest angle is ${angleText(worst.dihedral.min)}, at ${positionText(worst.centroid, DIGITS)}`;
  switch (reason) {
    case "wedge":
      return `${begin}: two faces meet at an angle of ${angleText(value)} at the edge from ${positionText(edge.from, DIGITS)} to ${positionText(edge.to, DIGITS)}`;
    case "triangle":
      return `${begin}: a triangle of the surface has an angle of ${angleText(value)} there`;
    case "thickness":
      return `${begin}: the region is only ${rounded(value)} thick there`;
    case "other":
      return begin;
  }
}

/** Returns what helps against the reason of the worst element. */
function remedyFor(
  { poor, limitedByBoundary: { edges, needles, narrowGaps } }: QualityReport,
  isGiven: boolean,
): string {
  switch (poor.worst === null ? "other" : poor.reason) {
    case "wedge":
      return "No element can open this angle, so smaller elements do not help: blunt the edge in the program that made the shape, or accept it.";
    case "triangle":
      return REMESH;
    case "thickness":
      return thicknessRemedy(poor);
    case "other":
      if (isGiven) return "Improve the mesh (`improveMesh()`).";
      return needles > edges + narrowGaps
        ? REMESH
        : 'Use smaller elements there, or `optimization: "thorough"`.';
  }
}

function thicknessRemedy({ goodSize, goodTetrahedra }: PoorElements): string {
  const needed = `One layer of good elements needs a size of ${rounded(goodSize)} there, with about ${rounded(goodTetrahedra)} tetrahedra in all`;
  return goodTetrahedra > MESH_DEFAULTS.maxTetrahedra
    ? `${needed}: more than can be made. Compute such a thin part with shell elements, or thicken it.`
    : `${needed}. Use such a size, or compute the thin part with shell elements.`;
}

/** Returns two significant digits, "0.04" or "58 million". */
function rounded(value: number): string {
  const number = Number(value.toPrecision(2));
  if (number >= 1e6) return `${Number((number / 1e6).toPrecision(2))} million`;
  return String(number);
}

function angleText(degrees: number): string {
  return `${Number(degrees.toPrecision(2))}°`;
}

/** Returns the poor elements with the smallest angles, of those that the report lists. */
function worstOf({ worst, limitedByBoundary, poor }: QualityReport): ElementQuality[] {
  const worstOfAll = poor.worst === null ? [] : [poor.worst];
  const listed = new Map(
    [...worstOfAll, ...worst, ...limitedByBoundary.worst].map((one) => [one.tetrahedron, one]),
  );
  return [...listed.values()]
    .filter(({ dihedral }) => dihedral.min < POOR_ANGLE)
    .sort((a, b) => a.dihedral.min - b.dihedral.min || a.tetrahedron - b.tetrahedron)
    .slice(0, NAMED_ELEMENTS);
}

/** Returns "1 of 8 triangles (13 %) is" or "3 of 8 triangles (38 %) are". */
function shareOf(count: number, all: number, noun: string): string {
  const percent = Math.round((100 * count) / all);
  const share = percent === 0 ? "less than 1 %" : `${percent} %`;
  return `${count} of ${plural(all, noun)} (${share}) ${count === 1 ? "is" : "are"}`;
}
