/**
 * What the engine found, said in sentences: the entities by the names the user gave them, the place,
 * the numbers, and what to do about it.
 */
import { aFunction, aNumber, arrayOf, checkArgument, objectOf } from "./argument-checks.js";
import { ENGINE_OPTIONS, engineCodeName, type EngineCode } from "./diagnostic-codes.js";
import { ENGINE_DATA } from "./diagnostic-data.js";
import { capitalised } from "./package-diagnostic.js";
import { plural } from "./plural.js";
import type { EntityNamer } from "./project-arrays.js";
import type { Diagnostic, EntityKind, EntityRef, Severity } from "./types.js";

/** A diagnostic as it leaves the engine. */
export interface EngineDiagnostic {
  readonly code: number;
  /** 0 information, 1 warning, 2 error. */
  readonly severity: number;
  /** Kind and position per entity, the most telling first. */
  readonly entities: Uint32Array;
  /** x y z, or nothing. */
  readonly place: Float64Array;
  readonly values: Float64Array;
}

/** The engine's numbers of severities. */
export const SEVERITIES: readonly Severity[] = ["information", "warning", "error"];

/** The engine's numbers of entity kinds (cpp/include/tetrafront/status.h). */
export const ENTITY_KINDS: readonly EntityKind[] = [
  "point",
  "line",
  "patch",
  "background-node",
  "background-tetrahedron",
  "triangle",
  "surface-node",
  "source",
];

/** What a sentence is made from. */
interface Subject {
  /** The first entity of that kind by name, else e.g. "a line". */
  readonly the: (kind: EntityKind) => string;
  /** All entities of these kinds, "patch 1 and patch 2"; else `otherwise`. */
  readonly all: (kinds: readonly EntityKind[], otherwise: string) => string;
  /** How many different entities of these kinds there are. */
  readonly count: (kinds: readonly EntityKind[]) => number;
  /** " at (1, 2, 3)", or nothing. */
  readonly at: string;
  /** The value of that number, written short; "?" if the engine gave none. */
  readonly value: (index: number) => string;
  /** The entity the diagnostic names first, else "the model". */
  readonly main: string;
  /** Its kind, if there is one. */
  readonly kind: EntityKind | undefined;
  /** Whether lines or patches are involved, which a given surface does not have. */
  readonly drawn: boolean;
}

interface Sentence {
  readonly message: (subject: Subject) => string;
  readonly remedy: string | ((subject: Subject) => string);
}

const SHELL_KINDS: readonly EntityKind[] = ["patch", "triangle", "surface-node"];

/** One entry per engine code: the compiler refuses a table with a gap. */
const SENTENCES: Readonly<Record<EngineCode, Sentence>> = {
  "not-finite": {
    message: ({ main, value }) => {
      const coordinate = Number(value(0));
      if (coordinate === 0) return "All points lie at the origin";
      return Number.isFinite(coordinate)
        ? `${main} has the coordinate ${value(0)}, too large or too small to compute with`
        : `${main} has a coordinate that is not a finite number`;
    },
    remedy:
      "Give finite coordinates, not beyond 1e30, and 0 for those below 1e-75; scale a model that is all below 1e-30.",
  },
  "index-out-of-range": {
    message: ({ main, value }) => `${main} refers to number ${value(0)}, which does not exist`,
    remedy: "Refer to something that exists, or remove the reference.",
  },
  "wrong-point-count": {
    message: ({ the, value }) =>
      `${the("line")} has ${plural(value(0), "point")}, which does not fit its type`,
    remedy: "Give a straight line two points, a parabolic line three, a spline four or more.",
  },
  "coincident-points": {
    message: ({ the, all, at }) =>
      `${the("line")} runs through ${all(["point"], "two points")} at one place${at}`,
    remedy: "Move one of the points, or remove it from the line.",
  },
  "zero-length-line": {
    message: ({ the, at }) => `${the("line")} has no length${at}`,
    remedy: "Move its points apart, or delete the line.",
  },
  "wrong-line-count": {
    message: ({ the, value }) =>
      `${the("patch")} has ${plural(value(0), "line")} in its outer loop, its type takes ${value(1)}`,
    remedy: "Change the patch's type, or join or split lines until the number fits.",
  },
  "wrong-line-type": {
    message: ({ the }) => `${the("patch")} takes parabolic lines only, and ${the("line")} is not`,
    remedy:
      "Make the line parabolic, with the point it passes at its middle (the mid-point keeps a straight line straight), or give the patch a type that takes any line.",
  },
  "loop-not-closed": {
    message: ({ the, at }) => `A loop of ${the("patch")} is not closed: it breaks after ${the("line")}${at}`,
    remedy: "Let the next line begin where this one ends; a minus sign walks a line backwards.",
  },
  "loop-touches-itself": {
    message: ({ the, all, at }) => `A loop of ${the("patch")} crosses or touches itself${along(all)}${at}`,
    remedy: "Move the lines apart, or split the patch where they meet.",
  },
  "not-planar": {
    message: ({ the, all, value, at }) =>
      `${the("patch")} is planar, but its plane misses ${all(["point"], the("line"))} by ${value(0)}${at}`,
    remedy: "Move the points into the plane, or give the patch a type that is curved.",
  },
  "empty-model": {
    message: () => "There is nothing to mesh: the model has no surface",
    remedy: "Draw patches, or give triangles, that enclose a region.",
  },
  "degenerate-patch": {
    message: ({ the, all, at }) => {
      const lines = all(["line"], "");
      const cause = lines === "" ? "" : `: a mid-point is too near one end of ${lines}`;
      return `${the("patch")} has no area or folds over itself${at}${cause}`;
    },
    remedy: ({ all }) =>
      all(["line"], "") === ""
        ? "Move its points so that it spreads out, or split it into simpler patches."
        : "Move the middle point of the line into the middle half of its length.",
  },
  "hole-outside": {
    message: ({ the, at }) =>
      `The hole of ${the("patch")} that begins with ${the("line")} is not inside its outer loop, or lies in another hole${at}`,
    remedy: "Move the hole into the patch, or list the outermost loop first.",
  },
  "hole-off-patch": {
    message: ({ the, value, at }) =>
      `${the("line")} bounds a hole of ${the("patch")}, but leaves the patch by ${value(0)}${at}`,
    remedy: "Draw the line through points on the patch, the more the stronger it is curved.",
  },
  "bad-option": {
    message: ({ value }) => `The ${ENGINE_OPTIONS[Number(value(0))] ?? "option"} is ${value(1)}`,
    remedy:
      "Give a size above 0 and up to 1e30, a growth from 0 to 10, and a gradation of 0, or above 1 and up to 10.",
  },
  "line-crosses-itself": {
    message: ({ the, at }) => `${the("line")} crosses or runs over itself${at}`,
    remedy: "Move its points, or split it into lines that meet at a common point.",
  },
  "patches-meet": {
    message: ({ all, at }) => `${all(["patch"], "Two patches")} overlap or cross each other${at}`,
    remedy:
      "Move them apart, or cut both along a common line; leave out what lies inside, unless it is a wall between two regions.",
  },
  "duplicate-lines": {
    message: ({ all, at }) => `${all(["line"], "Two lines")} run along the same course${at}`,
    remedy: "Let all patches use one of them, and delete the other.",
  },
  "duplicate-points": {
    message: ({ all, at }) => `${all(["point"], "Two points")} lie at one place${at}`,
    remedy: "Let all lines use one of them, and delete the other.",
  },
  "size-too-large": {
    message: ({ value }) => `An element size, ${value(0)}, is larger than the whole model, ${value(1)}`,
    remedy:
      "Give a smaller size: lines and patches are followed only roughly, and a given surface's own edges tell the sizes in it.",
  },
  "nested-bodies": {
    message: ({ value }) =>
      `The model has ${plural(value(0), "region")}${value(1) === "0" ? "" : ` and ${plural(value(1), "cavity")}`}`,
    remedy: "",
  },
  "empty-background-grid": {
    message: () => "The project has no background grid, so no element size is known",
    remedy:
      "Give a uniform element size (--size on the command line), or make a background grid that covers the model.",
  },
  "bad-size": {
    message: ({ main, value }) => `${main} has the element size ${value(0)}`,
    remedy: "Give a size above 0, not below 1e-12 of the extent of the background grid, and up to 1e30.",
  },
  "bad-stretching": {
    message: ({ main, value }) => `${main} has the stretching ${value(0)}`,
    remedy: "Give a stretching from 1 (none) to 1e6, and a direction that is not zero.",
  },
  "flat-background-tetrahedron": {
    message: ({ the, at }) => `${the("background-tetrahedron")} has no volume${at}`,
    remedy: "Move one of its nodes out of the plane of the others, or remove it.",
  },
  "outside-background-grid": {
    message: ({ main, at }) => `${main} lies outside the background grid${at}`,
    remedy:
      "Extend the background grid until it covers the whole model, or make a covering grid in its place.",
  },
  "too-many-elements": {
    message: ({ main, kind, value }) => {
      switch (kind) {
        case "line":
          return `${main} asks for more than ${plural(value(1), "side")}`;
        case "patch":
          return `${main} asks for more than ${plural(value(1), "triangle")}`;
        case "triangle":
          return `Refined, the surface would have ${estimated(value(0), "triangle")}, the most of them in ${main}; the limit is ${value(1)}`;
        default:
          return `The sizes ask for ${estimated(value(0), "tetrahedron")}, the limit is ${value(1)}`;
      }
    },
    remedy: ({ kind, value }) => {
      // Where lines or patches alone are too many, the estimate is of those, not of the tetrahedra.
      const factor = kind === undefined ? Math.cbrt(Number(value(0)) / Number(value(1))) : NaN;
      if (!(factor > 1)) return "Ask for larger elements.";
      if (isBeyondCounting(value(0))) return "Ask for far larger elements.";
      return `Ask for elements at least ${(Math.ceil(10 * factor) / 10).toFixed(1)} times as large.`;
    },
  },
  "bad-source": {
    message: ({ main, value }) =>
      `${main} has the size ${value(0)}, the distance ${value(1)} and the growth ${value(2)}`,
    remedy: "Give a size from 1e-30 to 1e30, a distance of 0 or more, and a growth from 0 to 10.",
  },
  "open-edge": {
    message: ({ all, at, value }) =>
      `The surface is not closed: one side is missing at ${all(["line", "patch", "triangle"], "an edge")}${at}${total(value(0), "open edge")}`,
    remedy: ({ drawn }) =>
      drawn
        ? "Add the patch that is missing there, or let its neighbour use the same line. A wall must end at lines of other patches all round."
        : "Close the gap in the surface; at least two triangles must meet at every edge. A repair joins points that are nearly in one place (--weld, or repairSurface), and fills holes (--fill-holes).",
  },
  "dangling-sheet": {
    message: ({ all, at }) =>
      `${all(SHELL_KINDS, "A sheet")} separates nothing: the same space lies on both sides${at}`,
    remedy: ({ drawn }) =>
      drawn
        ? "Remove the patch, or add others until it closes a space of its own."
        : "Remove the sheet, or close a space with it.",
  },
  "inconsistent-orientation": {
    message: ({ all, at }) =>
      `${all(SHELL_KINDS, "A part of the surface")} cannot be turned so that all of its shell faces outward${at}`,
    remedy: "A closed surface has an inside and an outside: remove the twist, as of a Möbius band.",
  },
  "self-intersection": {
    message: ({ all, count, at, value }) => {
      const meet =
        count(SHELL_KINDS) === 1
          ? `${all(SHELL_KINDS, "")} crosses itself`
          : `${all(SHELL_KINDS, "two triangles")} meet`;
      return `The surface cuts itself: ${meet}${at}${totalOfPairs(value(0), value(1) === "1")}`;
    },
    remedy: ({ drawn }) =>
      drawn
        ? "Move the patches apart, or use smaller elements where they bend close to each other."
        : "Repair the surface so that triangles meet only in shared corners and edges.",
  },
  "duplicate-triangle": {
    message: ({ all, at }) => `${all(SHELL_KINDS, "Two triangles")} lie on one another${at}`,
    remedy: ({ drawn }) =>
      drawn
        ? "Remove one of them."
        : "Remove one of them, also where two bodies meet: one wall is enough. A repair does so and lists each: --repair, or repairSurface.",
  },
  "degenerate-triangle": {
    message: ({ all, at }) => `${all(["triangle", "patch"], "A triangle")} has corners on one line${at}`,
    remedy: "Remove it by merging its corners, or move one of them.",
  },
  "zero-volume": {
    message: ({ all, at }) => `${all(SHELL_KINDS, "A shell")} belongs to a shell that encloses nothing${at}`,
    remedy: "Remove the flat shell, or move its corners apart.",
  },
  "reoriented-patch": {
    message: ({ all, count, value, main, drawn }) => {
      if (!drawn) {
        return `The part of the surface with ${main} is inside out: the mesh has all of its ${plural(value(1), "triangle")} turned outward`;
      }
      const [were, have] = count(["patch"]) > 1 ? ["were", "have"] : ["was", "has"];
      return `${all(["patch"], "A patch")} ${were} drawn inside out and ${have} been turned round`;
    },
    remedy: "",
  },
  "turned-triangle": {
    message: ({ main, at }) => `${main} faces inward, but others of its part of the surface outward${at}`,
    remedy: ({ value }) =>
      `Turn it round; a repair does so and lists each: --repair, or repairSurface.${
        value(0) === "1"
          ? " Where spaces on both of its sides are to be meshed, fill regions: --enclosed regions, or enclosed."
          : ""
      }`,
  },
  "coincident-nodes": {
    message: ({ all, at }) =>
      `${all(["point", "surface-node", "line", "patch"], "Two nodes")} lie at one place without being joined${at}`,
    remedy: ({ drawn }) =>
      drawn ? "Use one point in both lines, or move them apart." : "Weld the corners, or move them apart.",
  },
  "coarse-surface": {
    message: ({ the, at, value }) =>
      `${the("triangle")}${at} has an edge ${value(1)} times as long as wanted there, ${value(0) === "1" ? "alone" : `one of ${value(0)} triangles`} with edges more than twice as long: beside them elements are as large`,
    remedy:
      "Refine the surface (refineSurface(), --refine-surface on the command line), or ask for larger elements.",
  },
  stalled: {
    message: ({ value, at }) =>
      `The front stalled with ${plural(value(0), "face")} that no tetrahedron completes${at}; the mesh is partial`,
    remedy:
      "Use sizes that change more gently there; in a given surface, a size nearer to that of its own edges.",
  },
  "verification-failed": {
    message: ({ value, at }) => `The finished mesh failed its own check in ${plural(value(0), "place")}${at}`,
    remedy: "This is a mistake in Tetrafront: please report it with the model.",
  },
};

/** Whether an estimate is the engine's largest, which stands for all above it (`counted` there). */
function isBeyondCounting(estimate: string): boolean {
  return Number(estimate) >= 1e15;
}

/** "about 30000000 tetrahedra". */
function estimated(count: string, noun: string): string {
  return `${isBeyondCounting(count) ? "more than" : "about"} ${plural(count, noun)}`;
}

function along(all: Subject["all"]): string {
  const lines = all(["line"], "");
  return lines === "" ? "" : ` at ${lines}`;
}

function total(count: string, noun: string): string {
  return count === "?" || count === "1" ? "" : ` (${plural(count, noun)} in all)`;
}

/** `isLeast`: the search was ended before all were found. */
function totalOfPairs(count: string, isLeast: boolean): string {
  if (count === "?" || count === "1") return "";
  return ` (${isLeast ? "at least " : ""}${count} pairs of triangles in all)`;
}

const anEngineDiagnostic = objectOf({
  code: aNumber,
  severity: aNumber,
  entities: arrayOf(Uint32Array, 2),
  place: arrayOf(Float64Array, 3),
  values: arrayOf(Float64Array),
});

/** Composes the sentences for one diagnostic of the engine. Throws a `MesherError` where it is none. */
export function describeDiagnostic(raw: EngineDiagnostic, name: EntityNamer): Diagnostic {
  checkArgument("diagnostic", raw, anEngineDiagnostic);
  checkArgument("name", name, aFunction);
  const entities = namedEntities(raw.entities, name);
  const code = engineCodeName(raw.code) ?? "verification-failed";
  const subject = subjectOf(raw, entities);
  const { message, remedy } = SENTENCES[code];
  const [x, y, z] = raw.place;
  const diagnostic = {
    code,
    severity: SEVERITIES[raw.severity] ?? "error",
    message: capitalised(withCounting(message(subject), entities)),
    remedy: typeof remedy === "string" ? remedy : remedy(subject),
    entities,
    ...(x !== undefined && y !== undefined && z !== undefined ? { place: [x, y, z] as const } : {}),
    data: dataOf(code, raw.values),
  };
  // That the names are those of the type is what their table is checked for.
  return diagnostic as Diagnostic;
}

/** The engine's numbers by their names. */
function dataOf(code: EngineCode, values: Float64Array): object {
  const data: Record<string, unknown> = {};
  ENGINE_DATA[code]?.forEach((name, i) => {
    const value = values[i];
    if (value === undefined) return;
    if (name === "option") data[name] = ENGINE_OPTIONS[value];
    else data[name] = name.startsWith("is") ? value === 1 : value;
  });
  return data;
}

/** Where something is named by its position, the first such name tells how positions are counted. */
function withCounting(message: string, entities: readonly EntityRef[]): string {
  const places = entities
    .filter(({ id }) => id === undefined)
    .flatMap(({ label }) => {
      let at = message.indexOf(label);
      // "triangle 1" is not named by "triangle 12".
      while (at >= 0 && /\d/.test(message.charAt(at + label.length))) at = message.indexOf(label, at + 1);
      return at < 0 ? [] : [at + label.length];
    });
  if (places.length === 0) return message;
  const end = Math.min(...places);
  return `${message.slice(0, end)} (counted from 0)${message.slice(end)}`;
}

function namedEntities(pairs: Uint32Array, name: EntityNamer): EntityRef[] {
  const named: EntityRef[] = [];
  for (let i = 0; i + 1 < pairs.length; i += 2) {
    const kind = ENTITY_KINDS[pairs[i] ?? 0];
    if (kind !== undefined) named.push(name(kind, pairs[i + 1] ?? 0));
  }
  return named;
}

function subjectOf(raw: EngineDiagnostic, entities: readonly EntityRef[]): Subject {
  const drawn = entities.some(({ kind }) => kind === "line" || kind === "patch" || kind === "point");
  // Of a drawing its lines and patches are told; which triangles these have is left to the entities.
  const isTold = (kind: EntityKind) => !drawn || kind !== "triangle";
  const labels = (kinds: readonly EntityKind[]) =>
    entities.filter(({ kind }) => kinds.includes(kind) && isTold(kind)).map(({ label }) => label);
  return {
    the: (kind) => labels([kind])[0] ?? `a ${kind.replace("-", " ")}`,
    count: (kinds) => new Set(labels(kinds)).size,
    all: (kinds, otherwise) => joined([...new Set(labels(kinds))]) ?? otherwise,
    at: raw.place.length === 3 ? ` at (${[...raw.place].map(shortNumber).join(", ")})` : "",
    value: (index) => shortNumber(raw.values[index]),
    main: entities[0]?.label ?? "the model",
    kind: entities[0]?.kind,
    drawn,
  };
}

/** More names than these are counted. */
const MOST_NAMES = 8;

function joined(labels: readonly string[]): string | undefined {
  if (labels.length < 2) return labels[0];
  const named = labels.length > MOST_NAMES ? MOST_NAMES - 1 : labels.length - 1;
  const last = named + 1 < labels.length ? `${labels.length - named} more` : (labels[named] ?? "");
  return `${labels.slice(0, named).join(", ")} and ${last}`;
}

/** Counts in full, else six significant digits: enough to find the place, short enough to read. */
function shortNumber(value: number | undefined): string {
  if (value === undefined) return "?";
  return Number.isSafeInteger(value) ? String(value) : String(Number(value.toPrecision(6)));
}
