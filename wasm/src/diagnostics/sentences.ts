/**
 * One sentence and one remedy per code of the engine, with the entities by the names that the user gave them, the
 * position and the numbers.
 */
import { LIMITS, limitText } from "../base/limits.js";
import { plural } from "../base/plural.js";
import {
  type CheckedOption,
  type EngineCode,
  type EntityKind,
  MAX_DIRECTION_COSINE,
  MAX_LAYERS,
  MAX_SIZE_FACTOR,
  MAX_REMESH_ANGLE,
  MIN_LENGTH,
  MIN_REMESH_ANGLE,
  MIN_SIZE_FACTOR,
} from "../generated/constants.js";
import type { DiagnosticData } from "./data.js";

/** Input of a sentence. */
export interface Subject<Code extends EngineCode> {
  readonly data: DiagnosticData[Code];
  /** Label of the first entity of that kind, else for example "a line". */
  readonly the: (kind: EntityKind) => string;
  /** Labels of all entities of these kinds, "patch 1 and patch 2"; else `otherwise`. */
  readonly all: (kinds: readonly EntityKind[], otherwise: string) => string;
  /** Number of different entities of these kinds. */
  readonly count: (kinds: readonly EntityKind[]) => number;
  /** " at (1, 2, 3)", or empty. */
  readonly at: string;
  /** Label of the first entity, else "the model". */
  readonly main: string;
  /** Kind of the first entity, if there is one. */
  readonly kind: EntityKind | undefined;
  /** Whether lines or patches are involved, which a given surface does not have. */
  readonly drawn: boolean;
}

interface Sentence<Code extends EngineCode> {
  readonly message: (subject: Subject<Code>) => string;
  readonly remedy: string | ((subject: Subject<Code>) => string);
}

const LENGTH = limitText(LIMITS.length);
const SHELL_KINDS: readonly EntityKind[] = ["patch", "triangle", "surface-node"];

const SIZE_RANGE = `a size above 0 and up to ${LENGTH}`;
const ANGLE_RANGE = `an angle from ${MIN_REMESH_ANGLE} to ${MAX_REMESH_ANGLE} degrees`;

/** Name and range of the options that the engine checks. */
const OPTION_WORDS: Readonly<Record<CheckedOption, readonly [name: string, range: string]>> = {
  size: ["size", SIZE_RANGE],
  growth: ["growth", `a growth from 0 to ${LIMITS.growth}`],
  gradation: ["gradation", `a gradation of 0, or above 1 and up to ${LIMITS.gradation}`],
  "min-size": ["smallest size", SIZE_RANGE],
  "max-size": ["largest size", SIZE_RANGE],
  tolerance: ["tolerance", `a distance above 0 and up to ${LENGTH}`],
  "feature-angle": ["feature angle", ANGLE_RANGE],
  "angle-per-edge": ["angle per edge", ANGLE_RANGE],
  "drop-details": ["length of dropped details", `a distance from 0 up to ${LENGTH}`],
  layers: ["number of layers", `a number from 0 to ${MAX_LAYERS}`],
  "size-factor": ["factor on the sizes", `a factor from ${MIN_SIZE_FACTOR} to ${MAX_SIZE_FACTOR}`],
  "max-volume": ["largest volume of a tetrahedron", "a volume above 0"],
};

interface UnresolvedPlace {
  readonly triangle: string;
  readonly at: string;
  readonly count: number;
  readonly limit: number;
}

/** Returns why an exact repair failed; the reasons are those of the engine. */
function unresolved(reason: number, { triangle, at, count, limit }: UnresolvedPlace): string {
  switch (reason) {
    case 1:
      return "its triangles enclose no volume, also after its holes are closed";
    case 2:
      // Without a position, no given triangle is left out: what closes the holes overlaps itself.
      return `more than half of its area encloses nothing${at === "" ? "" : `, for example ${triangle}${at}`}`;
    case 3:
      return `at least ${limit} pairs of triangles intersect, for example ${triangle}${at}`;
    case 4:
      return `separating ${triangle}${at} and others takes more than the ${limit} triangles and pairs that are allowed (${plural(count, "pair")} left)`;
    case 5:
      return `${triangle}${at} intersects others again whenever its cuts are rounded (${plural(count, "pair")} left)`;
    default:
      return `what it encloses has no valid boundary${at === "" ? "" : ` near ${triangle}${at}`}`;
  }
}

const UNRESOLVED_REMEDIES = [
  "Use a surface that encloses a volume: thicken sheets in the program that made them, or close large holes.",
  "Remove the triangles that enclose nothing, or close the surface that they belong to.",
  "Remove copies of the surface, or repair its parts one by one.",
  "Repair the surface near this position, or its parts one by one, or weld its nodes first (`weld`).",
  "Weld the nodes near this position (`weld`), or move the parts apart by more than the rounding of their coordinates.",
  "Separate the parts that touch near this position, or weld their nodes (`weld`).",
];

/** One entry per engine code: the compiler rejects a table with a gap. */
export const SENTENCES: { readonly [Code in EngineCode]: Sentence<Code> } = {
  "not-finite": {
    message: ({ main, data: { coordinate } }) => {
      if (coordinate === 0) return "All points lie at the origin";
      return Number.isFinite(coordinate)
        ? `${main} has the coordinate ${short(coordinate)}, whose magnitude is too large or too small`
        : `${main} has a coordinate that is not a finite number`;
    },
    remedy: `Use finite coordinates with magnitudes from 1e-75 to ${LENGTH}, or 0. If all of them are below ${limitText(MIN_LENGTH)}, scale the model up.`,
  },
  "index-out-of-range": {
    message: ({ main, data }) => `${main} refers to index ${data.index}, which does not exist`,
    remedy: "Correct the index, or remove the reference.",
  },
  "wrong-point-count": {
    message: ({ the, data }) =>
      `${the("line")} has ${plural(data.points, "point")}, which its type does not permit`,
    remedy:
      "Use two points for a straight line, three for a parabolic line or an arc, at least three for a spline, and for a circle three and the first of them again.",
  },
  "coincident-points": {
    message: ({ the, all, at }) =>
      `${the("line")} has ${all(["point"], "two points")} at the same position${at}`,
    remedy: "Move one of the points, or remove it from the line.",
  },
  "collinear-points": {
    message: ({ the, at }) =>
      `The points of ${the("line")} lie on one straight line${at}, so they define no circle`,
    remedy: "Move one of its points, or make it a straight line.",
  },
  "open-circle": {
    message: ({ the }) => `${the("line")} is a circle, but its last point is not its first`,
    remedy: "Make the first of its four points the last one too, or choose the type arc or spline.",
  },
  "zero-length-line": {
    message: ({ the, at }) => `${the("line")} has no length${at}`,
    remedy: "Move its points apart, or delete the line.",
  },
  "wrong-line-count": {
    message: ({ the, data }) =>
      `${the("patch")} has ${plural(data.lines, "line")} in its outer loop, but its type requires ${data.required}`,
    remedy: "Change the patch's type, or join or split lines until it has the required number.",
  },
  "wrong-line-type": {
    message: ({ the }) => `${the("patch")} requires parabolic lines, but ${the("line")} is not parabolic`,
    remedy:
      "Make the line parabolic by adding its middle point (the mid-point of a straight line keeps it straight), or choose a patch type that permits any line.",
  },
  "wrong-loop-count": {
    message: ({ the, data }) =>
      `${the("patch")} is a tube, which has two loops, but it has ${plural(data.loops, "loop")}`,
    remedy: "Give it the loops of its two rims, or choose another patch type.",
  },
  "misplaced-section": {
    message: ({ the }) =>
      `${the("line")} is a section of ${the("patch")}, but does not run from an inner point of its fourth line to one of its second, beyond the section before it`,
    remedy:
      "Draw the patch's fourth and second line through the ends of its sections, and list the sections from its first line to its third; a negative id reverses a line.",
  },
  "loop-not-closed": {
    message: ({ the, at }) =>
      `A loop of ${the("patch")} is not closed: the next line does not begin where ${the("line")} ends${at}`,
    remedy: "Continue the loop with a line that begins where this one ends; a negative id reverses a line.",
  },
  "loops-intersect": {
    message: ({ the, all, at }) => `Loops of ${the("patch")} cross or touch${along(all)}${at}`,
    remedy: "Move the lines apart, or split the patch where they touch.",
  },
  "not-planar": {
    message: ({ the, all, data, at }) =>
      `${the("patch")} is planar, but ${all(["point"], the("line"))} is ${short(data.distance)} away from its plane${at}`,
    remedy: "Move the points into the plane, or choose a curved patch type.",
  },
  "empty-model": {
    message: () => "There is nothing to mesh: the model has no surface",
    remedy: "Add patches or triangles that enclose a region.",
  },
  "degenerate-patch": {
    message: ({ the, all, at }) => {
      const lines = all(["line"], "");
      const cause = lines === "" ? "" : `: the middle point of ${lines} is too close to one end`;
      return `${the("patch")} has no area or folds over itself${at}${cause}`;
    },
    remedy: ({ all }) =>
      all(["line"], "") === ""
        ? "Move its points apart so that it has area everywhere, or split it into simpler patches."
        : "Move the middle point of the line into the middle half of its length.",
  },
  "hole-outside": {
    message: ({ the, at }) =>
      `The hole of ${the("patch")} that begins with ${the("line")} is outside the outer loop or inside another hole${at}`,
    remedy: "Move the hole into the patch, or list the outermost loop first.",
  },
  "hole-off-patch": {
    message: ({ the, data, at }) =>
      `${the("line")} bounds a hole of ${the("patch")}, but is up to ${short(data.distance)} away from the patch${at}`,
    remedy: "Draw the line through points on the patch; the more it is curved, the more points it needs.",
  },
  "option-out-of-range": {
    message: ({ data }) =>
      `The ${OPTION_WORDS[data.option][0]} is ${short(data.given)}, which is out of range`,
    remedy: ({ data }) => `Use ${OPTION_WORDS[data.option][1]}.`,
  },
  "line-self-intersection": {
    message: ({ the, at }) => `${the("line")} crosses or overlaps itself${at}`,
    remedy: "Move its points, or split it into lines that share a point.",
  },
  "patches-intersect": {
    message: ({ all, at }) => `${all(["patch"], "Two patches")} intersect or overlap${at}`,
    remedy:
      "Move them apart, or split both along a common line. Remove parts that lie inside, unless they are interfaces between two regions.",
  },
  "duplicate-lines": {
    message: ({ all, at }) => `${all(["line"], "Two lines")} are identical${at}`,
    remedy: "Use one of them in all patches, and delete the other.",
  },
  "duplicate-points": {
    message: ({ all, at }) => `${all(["point"], "Two points")} have the same position${at}`,
    remedy: "Use one of them in all lines, and delete the other.",
  },
  "size-too-large": {
    message: ({ data }) =>
      `An element size, ${short(data.size)}, is larger than the model, ${short(data.extent)}`,
    remedy:
      "Use a smaller size: large elements follow lines and patches only roughly, and in a given surface the sizes follow its own edges.",
  },
  "nested-regions": {
    message: ({ data }) => regionCounts(data),
    remedy: "",
  },
  "surface-contact": {
    message: ({ at, data: { edges, nodes } }) =>
      `The surface touches itself at ${[
        ...(edges > 0 ? [plural(edges, "edge")] : []),
        ...(nodes > 0 ? [plural(nodes, "node")] : []),
      ].join(" and ")}${at}: the tetrahedra on both sides share only these`,
    remedy:
      "If what touches should be one body, let it overlap, and use `repair: true` or `repairSurface()`.",
  },
  "empty-background-grid": {
    message: () => "The project has no background grid, so the element sizes are unknown",
    remedy: "Set a uniform element size (`size`), or create a background grid that covers the model.",
  },
  "size-out-of-range": {
    message: ({ main, data }) => `${main} has the element size ${short(data.size)}, which is out of range`,
    remedy: `Use a size above 0, of at least 1e-12 of the extent of the background grid and at most ${LENGTH}.`,
  },
  "stretching-out-of-range": {
    message: ({ main, data }) =>
      `${main} has the stretching ${short(data.stretching)} or no direction, which is invalid`,
    remedy: "Use a stretching from 1 (none) to 1e6, and a direction that is not zero.",
  },
  "second-stretching-out-of-range": {
    message: ({ main, data }) =>
      data.cosine > MAX_DIRECTION_COSINE
        ? `${main} has two directions at an angle of ${short((180 / Math.PI) * Math.acos(Math.min(1, data.cosine)))}°, which must be orthogonal`
        : `${main} has the second stretching ${short(data.stretching)} or no second direction, which is invalid`,
    remedy:
      "Use a second stretching from 1 (none) to 1e6, and a second direction that is not zero and orthogonal to the first.",
  },
  "degenerate-background-tetrahedron": {
    message: ({ the, at }) => `${the("background-tetrahedron")} has no volume${at}`,
    remedy: "Move one of its nodes out of the plane of the others, or remove the tetrahedron.",
  },
  "outside-background-grid": {
    message: ({ main, at }) => `${main} is outside the background grid${at}`,
    remedy: "Extend the background grid until it covers the model, or replace it by a covering grid.",
  },
  "too-many-elements": {
    message: ({ main, kind, at, data: { expected, limit } }) => {
      switch (kind) {
        case "line":
        case "patch":
          return `The sizes at ${main} require ${estimated(expected, "tetrahedron")}; the limit is ${limit}`;
        case "triangle":
          return `The surface would have ${estimated(expected, "triangle")}, most of them in ${main}; the limit is ${limit}`;
        case "source":
        case "background-node":
          return `The sizes require ${estimated(expected, "tetrahedron")}, especially at ${main}; the limit is ${limit}`;
        default:
          return `The sizes require ${estimated(expected, "tetrahedron")}; the limit is ${limit}${at === "" ? "" : `, reached${at}`}`;
      }
    },
    remedy: ({ kind, data: { expected, limit } }) => {
      // Triangles of a refined surface are not counted in three dimensions.
      const factor = kind === "triangle" ? NaN : Math.cbrt(expected / limit);
      if (!(factor > 1)) return "Use larger elements.";
      if (isBeyondCounting(expected)) return "Use far larger elements.";
      return `Use elements at least ${(Math.ceil(10 * factor) / 10).toFixed(1)} times as large.`;
    },
  },
  "source-out-of-range": {
    message: ({ main, data }) =>
      `${main} has the size ${short(data.size)}, the distance ${short(data.distance)} and the growth ${short(data.growth)}; at least one is out of range`,
    remedy: `Use a size from ${limitText(MIN_LENGTH)} to ${LENGTH}, a distance of at least 0, and a growth from 0 to ${LIMITS.growth}.`,
  },
  "open-edge": {
    message: ({ all, at, data }) =>
      `The surface is not closed at ${all(["line", "patch", "triangle"], "an edge")}${at}${total(data.count, "open edge")}`,
    remedy: ({ drawn }) =>
      drawn
        ? "Add the missing patch, or use the same line in the neighbouring patch. Every line of an interface must belong to other patches too."
        : 'Close the surface: every edge needs at least two triangles. `surface: "remesh"`, or a repair (`repair: true` or `repairSurface()`), closes cracks and holes if the surface then encloses a volume; `weld` and `fillHoles` set limits.',
  },
  "dangling-sheet": {
    message: ({ all, at }) =>
      `${all(SHELL_KINDS, "A sheet")} separates nothing: the same volume is on both sides${at}`,
    remedy: ({ drawn }) =>
      drawn
        ? "Remove the patch, or add others until it encloses a region."
        : 'Extend the sheet until it encloses a region, or remove it: `surface: "remesh"`, or a repair (`repair: true` or `repairSurface()`), removes sheets.',
  },
  "inconsistent-orientation": {
    message: ({ all, at }) =>
      `${all(SHELL_KINDS, "A component of the surface")} cannot be oriented consistently with its neighbours${at}`,
    remedy: "Remove the twist, as in a Möbius strip: a closed surface needs an inside and an outside.",
  },
  "self-intersection": {
    message: ({ all, count, at, data }) => {
      const pair =
        count(SHELL_KINDS) === 1
          ? `${all(SHELL_KINDS, "")} intersects itself`
          : `${all(SHELL_KINDS, "two triangles")} intersect`;
      return `The surface intersects itself: ${pair}${at}${totalOfPairs(data.count, data.isLowerBound === true)}`;
    },
    remedy: ({ drawn }) =>
      drawn
        ? "Move the patches apart, or use smaller elements where curved patches are close to each other."
        : 'Triangles may have only shared nodes and edges in common. `surface: "remesh"`, or a repair (`repair: true` or `repairSurface()`), cuts them where they intersect, and keeps the boundary of what they enclose.',
  },
  "duplicate-triangle": {
    message: ({ all, at }) => `${all(SHELL_KINDS, "Two triangles")} are duplicates${at}`,
    remedy: ({ drawn }) =>
      drawn
        ? "Remove one of them."
        : "Remove one of them, also between two regions, where one interface is enough: a repair (`repair: true` or `repairSurface()`) removes duplicates and lists each change.",
  },
  "degenerate-triangle": {
    message: ({ all, at }) =>
      `${all(["triangle", "patch"], "A triangle")} is degenerate: its corners lie on a line${at}`,
    remedy: "Merge two of its corners, or move one of them.",
  },
  "zero-volume": {
    message: ({ all, at }) =>
      `${all(SHELL_KINDS, "A triangle")} belongs to a shell that encloses no volume${at}`,
    remedy: "Remove the flat shell, or move its corners apart.",
  },
  "reoriented-patch": {
    message: ({ all, count, data: { triangles }, main }) => {
      if (triangles !== undefined) {
        return `The component of the surface with ${main} was inside out: in the mesh, its ${plural(triangles, "triangle")} ${triangles === 1 ? "faces" : "face"} outward`;
      }
      const were = count(["patch"]) > 1 ? "were" : "was";
      return `${all(["patch"], "A patch")} ${were} drawn inside out; in the mesh, the orientation is corrected`;
    },
    remedy: "",
  },
  "flipped-triangle": {
    message: ({ main, at }) => `${main} faces inward, but other triangles of its component face outward${at}`,
    remedy: ({ data }) =>
      `Flip it: a repair (\`repair: true\` or \`repairSurface()\`) flips such triangles and lists each change.${
        data.isBetweenRegions
          ? ' To mesh the volumes on both of its sides, use `innerShells: "regions"`.'
          : ""
      }`,
  },
  "coincident-nodes": {
    message: ({ all, at }) =>
      `${all(["point", "surface-node", "line", "patch"], "Two nodes")} have the same position but are not the same node${at}`,
    remedy: ({ drawn }) =>
      drawn
        ? "Use one point in both lines, or move them apart."
        : "Weld them (`weld` or `repairSurface()`), or move them apart.",
  },
  "coarse-surface": {
    message: ({ the, at, data: { triangles, lengthRatio } }) =>
      `${the("triangle")}${at} has an edge ${short(lengthRatio)} times the target length${triangles === 1 ? "" : `; ${triangles} triangles have edges above twice the target length`}, and elements next to ${triangles === 1 ? "it" : "them"} will be as large`,
    remedy:
      'Refine the surface (`surface: "refine"` or `refineSurface()`), remesh it (`surface: "remesh"` or `remeshSurface()`), or use larger elements.',
  },
  "inconsistent-regions": {
    message: ({ the, at, data }) =>
      `${the("triangle")}${at} has given regions that contradict those of other triangles${total(data.count, "triangle")}`,
    remedy: "Repair the surface before its regions are located.",
  },
  "unresolved-surface": {
    message: ({ the, at, data: { reason, count, limit } }) =>
      `The surface could not be resolved, and stays as it is: ${unresolved(reason, { triangle: the("triangle"), at, count, limit })}`,
    remedy: ({ data: { reason } }) =>
      UNRESOLVED_REMEDIES[reason - 1] ?? "Close the surface, and remove sheets.",
  },
  "large-tetrahedra": {
    message: ({ at, data: { count, volumeRatio } }) =>
      `The largest tetrahedron has ${short(volumeRatio)} times the permitted volume${at}${total(count, "tetrahedron")}`,
    remedy:
      'Split the triangles of the surface (`surface: "refine"` or `refineSurface()`), replace them (`surface: "remesh"` or `remeshSurface()`), or permit a larger volume.',
  },
  stalled: {
    message: ({ data, all, at }) => {
      const neighbours = all(["patch", "triangle", "surface-node"], "");
      const where = neighbours === "" ? at : ` next to ${neighbours}${at}`;
      return `The front stalled${where} with ${plural(data.faces, "face")} that no tetrahedron can complete; the mesh is partial`;
    },
    remedy:
      'Use sizes that vary more gradually there. Remesh a given surface (`surface: "remesh"` or `remeshSurface()`), or use sizes closer to its edge lengths.',
  },
  "verification-failed": {
    message: ({ all, data }) => {
      const defects = all(["tetrahedron", "node", "triangle"], "");
      return `The finished mesh failed ${plural(data.count, "check")} of its verification${defects === "" ? "" : `, for example at ${defects}`}`;
    },
    remedy: "Report this error of Tetrafront, together with the model.",
  },
  "degenerate-tetrahedron": {
    message: ({ the, at, data }) =>
      `${the("tetrahedron")} has no volume${at}${total(data.count, "such tetrahedron")}`,
    remedy: "Remove it together with its neighbours, or mesh the region again.",
  },
  "non-manifold-face": {
    message: ({ all, at, data }) =>
      `${all(["tetrahedron"], "More than two tetrahedra")} share one face${at}; a face belongs to at most two tetrahedra${total(data.count, "such face")}`,
    remedy: "Make the mesh conform: remove all but two of them, or mesh the region again.",
  },
  "overlapping-tetrahedra": {
    message: ({ all, at, data }) =>
      `${all(["tetrahedron"], "Two tetrahedra")} overlap, or touch without a common face${at}${totalOfTetrahedra(data.count)}`,
    remedy:
      "Remove duplicates, connect parts that touch at common nodes and faces, or mesh the region again.",
  },
};

/** Says how many regions and cavities a model has; `parts`: number of parts of which the regions consist. */
export function regionCounts(
  { regions, cavities }: DiagnosticData["nested-regions"],
  parts = regions,
): string {
  const separate = parts === regions ? "" : ` in ${parts} separate parts`;
  const hollow = cavities === 0 ? "" : ` and ${plural(cavities, "cavity")}`;
  return `The model has ${plural(regions, "region")}${separate}${hollow}`;
}

/** Returns whether an estimate is the engine's largest value, which stands for all above it (`counted` there). */
function isBeyondCounting(estimate: number): boolean {
  return estimate >= 1e15;
}

/** Returns text such as "about 30000000 tetrahedra". */
function estimated(count: number, noun: string): string {
  return `${isBeyondCounting(count) ? "more than" : "about"} ${plural(short(count), noun)}`;
}

function along(all: Subject<EngineCode>["all"]): string {
  const lines = all(["line"], "");
  return lines === "" ? "" : ` at ${lines}`;
}

function total(count: number, noun: string): string {
  return count === 1 ? "" : ` (${plural(count, noun)} in all)`;
}

function totalOfTetrahedra(count: number): string {
  return count === 1 ? "" : ` (${count} such pairs in all)`;
}

/** `isLowerBound`: the search was ended before all pairs were found. */
function totalOfPairs(count: number, isLowerBound: boolean): string {
  if (count === 1) return "";
  return ` (${isLowerBound ? "at least " : ""}${count} pairs of triangles in all)`;
}

/** Formats whole numbers in full, others with six significant digits. */
export function short(value: number): string {
  return Number.isSafeInteger(value) ? String(value) : String(Number(value.toPrecision(6)));
}
