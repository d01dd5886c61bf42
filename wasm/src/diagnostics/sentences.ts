/**
 * What the engine found, said in sentences: the entities by the names the user gave them, the place,
 * the numbers, and what to do about it.
 */
import { ENGINE_OPTIONS, engineCodeName, type EngineCode } from "./codes.js";
import { ENGINE_DATA, type DiagnosticData } from "./data.js";
import type { DiagnosticArrays } from "../engine/loader.js";
import { BREATH, type Steps } from "../formats/steps.js";
import { sentence } from "./package-diagnostic.js";
import { plural } from "../base/plural.js";
import type { EntityNamer } from "../project/arrays.js";
import type { Diagnostic, DiagnosticOf, EntityKind, EntityRef, Severity } from "../api/types.js";

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
interface Subject<Code extends EngineCode> {
  readonly data: DiagnosticData[Code];
  /** The first entity of that kind by name, else e.g. "a line". */
  readonly the: (kind: EntityKind) => string;
  /** All entities of these kinds, "patch 1 and patch 2"; else `otherwise`. */
  readonly all: (kinds: readonly EntityKind[], otherwise: string) => string;
  /** How many different entities of these kinds there are. */
  readonly count: (kinds: readonly EntityKind[]) => number;
  /** " at (1, 2, 3)", or nothing. */
  readonly at: string;
  /** The entity the diagnostic names first, else "the model". */
  readonly main: string;
  /** Its kind, if there is one. */
  readonly kind: EntityKind | undefined;
  /** Whether lines or patches are involved, which a given surface does not have. */
  readonly drawn: boolean;
}

interface Sentence<Code extends EngineCode> {
  readonly message: (subject: Subject<Code>) => string;
  readonly remedy: string | ((subject: Subject<Code>) => string);
}

const SHELL_KINDS: readonly EntityKind[] = ["patch", "triangle", "surface-node"];

/** One entry per engine code: the compiler refuses a table with a gap. */
const SENTENCES: { readonly [Code in EngineCode]: Sentence<Code> } = {
  "not-finite": {
    message: ({ main, data: { coordinate } }) => {
      if (coordinate === 0) return "All points lie at the origin";
      return Number.isFinite(coordinate)
        ? `${main} has the coordinate ${short(coordinate)}, too large or too small to compute with`
        : `${main} has a coordinate that is not a finite number`;
    },
    remedy:
      "Give finite coordinates, not beyond 1e30, and 0 for those below 1e-75; scale a model that is all below 1e-30.",
  },
  "index-out-of-range": {
    message: ({ main, data }) => `${main} refers to number ${data.index}, which does not exist`,
    remedy: "Refer to something that exists, or remove the reference.",
  },
  "wrong-point-count": {
    message: ({ the, data }) =>
      `${the("line")} has ${plural(data.points, "point")}, which does not fit its type`,
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
    message: ({ the, data }) =>
      `${the("patch")} has ${plural(data.lines, "line")} in its outer loop, its type takes ${data.wanted}`,
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
    message: ({ the, all, data, at }) =>
      `${the("patch")} is planar, but its plane misses ${all(["point"], the("line"))} by ${short(data.distance)}${at}`,
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
    message: ({ the, data, at }) =>
      `${the("line")} bounds a hole of ${the("patch")}, but leaves the patch by ${short(data.distance)}${at}`,
    remedy: "Draw the line through points on the patch, the more the stronger it is curved.",
  },
  "bad-option": {
    message: ({ data }) => `The ${data.option} is ${short(data.given)}`,
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
    message: ({ data }) =>
      `An element size, ${short(data.size)}, is larger than the whole model, ${short(data.extent)}`,
    remedy:
      "Give a smaller size: lines and patches are followed only roughly, and a given surface's own edges tell the sizes in it.",
  },
  "nested-bodies": {
    message: ({ data: { regions, cavities } }) =>
      `The model has ${plural(regions, "region")}${cavities === 0 ? "" : ` and ${plural(cavities, "cavity")}`}`,
    remedy: "",
  },
  "empty-background-grid": {
    message: () => "The project has no background grid, so no element size is known",
    remedy:
      "Give a uniform element size (--size on the command line), or make a background grid that covers the model.",
  },
  "bad-size": {
    message: ({ main, data }) => `${main} has the element size ${short(data.size)}`,
    remedy: "Give a size above 0, not below 1e-12 of the extent of the background grid, and up to 1e30.",
  },
  "bad-stretching": {
    message: ({ main, data }) => `${main} has the stretching ${short(data.stretching)}`,
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
    message: ({ main, kind, at, data: { expected, most } }) => {
      switch (kind) {
        case "line":
          return `${main} asks for more than ${plural(most, "side")}`;
        case "patch":
          return `${main} asks for more than ${plural(most, "triangle")}`;
        case "triangle":
          return `Refined, the surface would have ${estimated(expected, "triangle")}, the most of them in ${main}; the limit is ${most}`;
        default:
          return `The sizes ask for ${estimated(expected, "tetrahedron")}, the limit is ${most}${at === "" ? "" : `; the last one was made${at}`}`;
      }
    },
    remedy: ({ kind, data: { expected, most } }) => {
      // Where lines or patches alone are too many, the estimate is of those, not of the tetrahedra.
      const factor = kind === undefined ? Math.cbrt(expected / most) : NaN;
      if (!(factor > 1)) return "Ask for larger elements.";
      if (isBeyondCounting(expected)) return "Ask for far larger elements.";
      return `Ask for elements at least ${(Math.ceil(10 * factor) / 10).toFixed(1)} times as large.`;
    },
  },
  "bad-source": {
    message: ({ main, data }) =>
      `${main} has the size ${short(data.size)}, the distance ${short(data.distance)} and the growth ${short(data.growth)}`,
    remedy: "Give a size from 1e-30 to 1e30, a distance of 0 or more, and a growth from 0 to 10.",
  },
  "open-edge": {
    message: ({ all, at, data }) =>
      `The surface is not closed: one side is missing at ${all(["line", "patch", "triangle"], "an edge")}${at}${total(data.count, "open edge")}`,
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
    message: ({ all, count, at, data }) => {
      const meet =
        count(SHELL_KINDS) === 1
          ? `${all(SHELL_KINDS, "")} crosses itself`
          : `${all(SHELL_KINDS, "two triangles")} meet`;
      return `The surface cuts itself: ${meet}${at}${totalOfPairs(data.count, data.isLeast === true)}`;
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
    message: ({ all, count, data: { triangles }, main }) => {
      if (triangles !== undefined) {
        return `The part of the surface with ${main} is inside out: the mesh has all of its ${plural(triangles, "triangle")} turned outward`;
      }
      const [were, have] = count(["patch"]) > 1 ? ["were", "have"] : ["was", "has"];
      return `${all(["patch"], "A patch")} ${were} drawn inside out and ${have} been turned round`;
    },
    remedy: "",
  },
  "turned-triangle": {
    message: ({ main, at }) => `${main} faces inward, but others of its part of the surface outward${at}`,
    remedy: ({ data }) =>
      `Turn it round; a repair does so and lists each: --repair, or repairSurface.${
        data.isBetweenSpaces
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
    message: ({ the, at, data: { triangles, longest } }) =>
      `${the("triangle")}${at} has an edge ${short(longest)} times as long as wanted there, ${triangles === 1 ? "alone" : `one of ${triangles} triangles`} with edges more than twice as long: beside them elements are as large`,
    remedy:
      "Refine the surface (refineSurface(), --refine-surface on the command line), or ask for larger elements.",
  },
  stalled: {
    message: ({ data, all, at }) => {
      const beside = all(["patch", "triangle", "surface-node"], "");
      return `The front stalled with ${plural(data.faces, "face")} that no tetrahedron completes${beside === "" ? "" : `, beside ${beside}`}${at}; the mesh is partial`;
    },
    remedy:
      "Use sizes that change more gently there; in a given surface, a size nearer to that of its own edges.",
  },
  "verification-failed": {
    message: ({ data, at }) =>
      `The finished mesh failed its own check in ${plural(data.count, "place")}${at}`,
    remedy: "This is a mistake in Tetrafront: please report it with the model.",
  },
};

/** Whether an estimate is the engine's largest, which stands for all above it (`counted` there). */
function isBeyondCounting(estimate: number): boolean {
  return estimate >= 1e15;
}

/** "about 30000000 tetrahedra". */
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

/** `isLeast`: the search was ended before all were found. */
function totalOfPairs(count: number, isLeast: boolean): string {
  if (count === 1) return "";
  return ` (${isLeast ? "at least " : ""}${count} pairs of triangles in all)`;
}

/** Per diagnostic in `heads`: code, severity, number of entities, 1 with a place, number of values. */
const HEAD_STRIDE = 5;

/** The engine's diagnostics one by one. */
export function* unpacked({
  heads,
  entities,
  positions,
  values,
}: DiagnosticArrays): Generator<EngineDiagnostic> {
  let [entity, place, value] = [0, 0, 0];
  for (let head = 0; head < heads.length; head += HEAD_STRIDE) {
    const [code = 0, severity = 0, entityCount = 0, placeCount = 0, valueCount = 0] = heads.subarray(
      head,
      head + HEAD_STRIDE,
    );
    yield {
      code,
      severity,
      entities: entities.subarray(entity, (entity += 2 * entityCount)),
      place: positions.subarray(place, (place += 3 * placeCount)),
      values: values.subarray(value, (value += valueCount)),
    };
  }
}

/** All that the engine has to say, in sentences. */
export function describeAll(arrays: DiagnosticArrays, name: EntityNamer): Diagnostic[] {
  return Array.from(unpacked(arrays), (raw) => describeDiagnostic(raw, name));
}

/** Sentences per step, of some ten microseconds each. */
const SENTENCES_PER_STEP = 256;

/** As `describeAll`, in steps: of a ruined surface there may be a million. */
export function* describeInSteps(arrays: DiagnosticArrays, name: EntityNamer): Steps<Diagnostic[]> {
  const described: Diagnostic[] = [];
  for (const raw of unpacked(arrays)) {
    described.push(describeDiagnostic(raw, name));
    if (described.length % SENTENCES_PER_STEP === 0) yield BREATH;
  }
  return described;
}

/** Composes the sentences for one diagnostic of the engine. */
export function describeDiagnostic(raw: EngineDiagnostic, name: EntityNamer): Diagnostic {
  const code = engineCodeName(raw.code);
  if (code === undefined) throw new Error(`the engine has a diagnostic ${raw.code} that nobody knows`);
  // Of the union that the codes make up, which cannot be told from one type for all codes.
  return describedAs(code, raw, name) as Diagnostic;
}

function describedAs<Code extends EngineCode>(
  code: Code,
  raw: EngineDiagnostic,
  name: EntityNamer,
): DiagnosticOf<Code> {
  const entities = namedEntities(raw.entities, name);
  const data = dataOf(code, raw.values);
  const subject = subjectOf<Code>(raw, entities, data);
  const { message, remedy } = SENTENCES[code];
  const [x, y, z] = raw.place;
  return {
    code,
    severity: SEVERITIES[raw.severity] ?? "error",
    message: sentence(withCounting(message(subject), entities)),
    remedy: typeof remedy === "string" ? remedy : remedy(subject),
    entities,
    ...(x !== undefined && y !== undefined && z !== undefined ? { position: [x, y, z] as const } : {}),
    data,
  };
}

/** The engine's numbers by their names. Throws where it gave too few. */
function dataOf<Code extends EngineCode>(code: Code, values: Float64Array): DiagnosticData[Code] {
  const data: Record<string, unknown> = {};
  ENGINE_DATA[code]?.forEach((entry, i) => {
    const name = entry.replace(/\?$/, "");
    const value = values[i];
    if (value === undefined) {
      if (name === entry) throw new Error(`the engine gave no ${name} with ${code}`);
    } else if (name === "option") {
      data[name] = ENGINE_OPTIONS[value];
    } else {
      data[name] = name.startsWith("is") ? value === 1 : value;
    }
  });
  // That the names are those of the type is what their table is checked for.
  return data as DiagnosticData[Code];
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

function subjectOf<Code extends EngineCode>(
  raw: EngineDiagnostic,
  entities: readonly EntityRef[],
  data: DiagnosticData[Code],
): Subject<Code> {
  const drawn = entities.some(({ kind }) => kind === "line" || kind === "patch" || kind === "point");
  // Of a drawing its lines and patches are told; which triangles these have is left to the entities.
  const isTold = (kind: EntityKind) => !drawn || kind !== "triangle";
  const labels = (kinds: readonly EntityKind[]) =>
    entities.filter(({ kind }) => kinds.includes(kind) && isTold(kind)).map(({ label }) => label);
  return {
    data,
    the: (kind) => labels([kind])[0] ?? `a ${kind.replace("-", " ")}`,
    count: (kinds) => new Set(labels(kinds)).size,
    all: (kinds, otherwise) => joined([...new Set(labels(kinds))]) ?? otherwise,
    at: raw.place.length === 3 ? ` at (${[...raw.place].map(short).join(", ")})` : "",
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
function short(value: number): string {
  return Number.isSafeInteger(value) ? String(value) : String(Number(value.toPrecision(6)));
}
