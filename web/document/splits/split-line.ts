import type { Project, ProjectLine, ProjectPatch, ProjectPoint } from "tetrafront/project";
import { lineSplitStrings, stepNames } from "../../strings";
import type { Offer } from "../create";
import { nextId } from "../create";
import { entityName, findRecord, type Entity } from "../entities";
import { keepCoordinates, type TypedPoint } from "../expression-edits";
import { coincidenceLength } from "../insert-shape";
import { linePositions } from "../line-samples";
import { patchMisfit } from "../patch-rules";
import { withoutUnused } from "../transforms/join-points";
import type { Position } from "../position";
import { distance } from "../vectors";
import { expressionsOnLine } from "./following";
import { lineCurve, nearestParameter, type LineCurve } from "./line-curve";

/** The lists of a project that a split changes. */
type Lists = Pick<Project, "points" | "lines" | "patches" | "groups" | "expressions">;

/** Where to split a line. */
export interface Cut {
  readonly line: number;
  readonly position: Position;
  /** Id of the point there; omitted for a new one. */
  readonly point?: number | undefined;
}

export type Split =
  | {
      readonly success: true;
      readonly project: Project;
      readonly point: number;
      /** The two parts, in the direction of the line. The first one has the id of the line. */
      readonly parts: readonly [number, number];
    }
  | {
      readonly success: false;
      readonly reason: string;
      /** Whether a patch needs its number of lines. */
      readonly isMisfit: boolean;
    };

const refuse = (reason: string, isMisfit = false) => ({ success: false, reason, isMisfit }) as const;

/**
 * The course of a spline depends on the lengths of its chords, and it begins without curvature. So that the parts keep the
 * course, each span is divided until its chords are as long as the curve up to this share, by at most so many parts, and
 * further points lie close to a new end, at these shares of the first part.
 */
const chordDefect = 2e-4;
const maxParts = 12;
const endShares = [1 / 32, 1 / 8, 3 / 8] as const;

/**
 * Splits a line at the place of it nearest to a position. Loops get both parts. Straight lines, arcs, circles and parabolas
 * keep their course exactly, splines nearly. Points that nothing else uses then are removed. Refuses if the place is an end of
 * the line, or if a patch needs its number of lines.
 */
export function splitLine(project: Project, { line: id, position, point }: Cut): Split {
  const line = findRecord(project, "line", id);
  const positions = line ? linePositions(project, line) : [];
  const curve = line && positions.length === line.points.length ? lineCurve(line.type, positions) : null;
  if (!line || !curve) return refuse(lineSplitStrings.noLine);
  const t = nearestParameter(curve, position);
  const tolerance = coincidenceLength(project);
  const place = curve.at(t);
  if ([0, 1].some((end) => distance(curve.at(end), place) <= tolerance))
    return refuse(lineSplitStrings.atEnd);
  const builder = new LineSplit(project, line, positions, curve);
  const parts = builder.divide(t, point, place);
  const patches = project.patches.map((patch) => withParts(patch, id, builder.secondId));
  const lines = project.lines.flatMap((one) => (one === line ? parts : [one]));
  const drawn = {
    ...project,
    points: [...withoutUnused(project.points, [line], lines), ...builder.points],
    lines,
    patches,
  };
  for (const [index, patch] of patches.entries()) {
    if (patch === project.patches[index]) continue;
    const misfit = patchMisfit(drawn, patch.type, patch.loops);
    const name = entityName(project, { kind: "patch", id: patch.id }) ?? "";
    if (misfit !== null) return refuse(lineSplitStrings.misfit(name, misfit), true);
  }
  const typed = builder.typedPoints;
  const groups = project.groups && withMember(project.groups, id, builder.secondId);
  const split = { ...drawn, ...(groups && { groups }) };
  return {
    success: true,
    project: typed.length > 0 ? withCoordinates(split, typed) : split,
    point: builder.cut,
    parts: [id, builder.secondId],
  };
}

/** A project after lines were split. */
export interface Divided {
  readonly project: Project;
  /** The line of which each new line was a part. */
  readonly wholes: ReadonlyMap<number, number>;
  /** Whether lines stay whole because patches need their number of lines. */
  readonly hasMisfits: boolean;
}

/** Splits lines at several places; those that cannot be split stay as they are. */
export function splitLines(project: Project, cuts: readonly Cut[]): Divided {
  const parameterOf = ({ line: id, position }: Cut): number => {
    const line = findRecord(project, "line", id);
    const curve = line && lineCurve(line.type, linePositions(project, line));
    return curve ? nearestParameter(curve, position) : 0;
  };
  // The part at the beginning of a line keeps its id, so the last place comes first.
  const ordered = cuts
    .map((cut) => ({ cut, t: parameterOf(cut) }))
    .toSorted((a, b) => a.cut.line - b.cut.line || b.t - a.t);
  const wholes = new Map<number, number>();
  let hasMisfits = false;
  const divided = ordered.reduce((current, { cut }) => {
    const same = cut.point ?? pointAt(current, cut.position);
    const split = splitLine(current, { ...cut, point: same });
    if (!split.success) {
      hasMisfits ||= split.isMisfit;
      return current;
    }
    for (const part of split.parts) wholes.set(part, cut.line);
    return split.project;
  }, project);
  return { project: divided, wholes, hasMisfits };
}

/** Returns the id of the point at a position; undefined if there is none. */
export function pointAt(project: Project, position: Position): number | undefined {
  const tolerance = coincidenceLength(project);
  return project.points.find((point) => distance(point.position, position) <= tolerance)?.id;
}

/** Offers to split the only selected line: at the only selected point, which lies on it, at a position, or in its middle. */
export function offerLineSplit(project: Project, selection: readonly Entity[], at: Position | null): Offer {
  const [id, ...others] = selection.flatMap((one) => (one.kind === "line" ? [one.id] : []));
  const [point, ...further] = selection.flatMap((one) => (one.kind === "point" ? [one.id] : []));
  const isFitting = others.length === 0 && further.length === 0;
  const line = id === undefined ? undefined : findRecord(project, "line", id);
  const curve = line && isFitting ? lineCurve(line.type, linePositions(project, line)) : null;
  if (!line || !curve) return { possible: false, reason: lineSplitStrings.noLine };
  const chosen = point === undefined ? undefined : findRecord(project, "point", point);
  const position = chosen?.position ?? at ?? curve.at(middleParameter(curve));
  const away = distance(curve.at(nearestParameter(curve, position)), position);
  if (chosen && away > 10 * coincidenceLength(project))
    return { possible: false, reason: lineSplitStrings.pointAway };
  const split = splitLine(project, { line: line.id, position, point: chosen?.id });
  if (!split.success) return { possible: false, reason: split.reason };
  return {
    possible: true,
    creation: {
      entities: [{ kind: "point", id: split.point }],
      edit: { label: stepNames.splitLine(line.id), replace: changedLists(project, split.project) },
    },
  };
}

const listNames = [
  "points",
  "lines",
  "patches",
  "groups",
  "expressions",
] as const satisfies readonly (keyof Lists)[];

/** Returns the lists of a project that it does not share with the one before. */
export const changedLists = (before: Project, after: Project): Partial<Lists> =>
  Object.fromEntries(
    listNames.filter((name) => before[name] !== after[name]).map((name) => [name, after[name]]),
  );

/** Returns the parameter halfway along a curve, by length. */
function middleParameter({ at, knots }: LineCurve): number {
  const parameters = knots
    .slice(1)
    .flatMap((knot, i) =>
      Array.from({ length: 32 }, (_, k) => (knots[i] ?? 0) + ((knot - (knots[i] ?? 0)) * k) / 32),
    );
  const all = [...parameters, 1];
  const lengths = all.slice(1).map((t, i) => distance(at(all[i] ?? 0), at(t)));
  let left = lengths.reduce((sum, one) => sum + one, 0) / 2;
  for (const [i, step] of lengths.entries()) {
    const [from, to] = [all[i] ?? 0, all[i + 1] ?? 1];
    if (left <= step) return from + ((to - from) * left) / (step || 1);
    left -= step;
  }
  return 0.5;
}

/** A patch with both parts in place of a line. */
function withParts(patch: ProjectPatch, first: number, second: number): ProjectPatch {
  if (!patch.loops.some((loop) => loop.some((step) => Math.abs(step) === first))) return patch;
  const divided = (step: number): readonly number[] => {
    if (Math.abs(step) !== first) return [step];
    return step > 0 ? [first, second] : [-second, -first];
  };
  return { ...patch, loops: patch.loops.map((loop) => loop.flatMap(divided)) };
}

function withMember(groups: NonNullable<Project["groups"]>, first: number, second: number) {
  return groups.map((group) =>
    group.members.some(({ kind, id }) => kind === "line" && id === first)
      ? { ...group, members: [...group.members, { kind: "line" as const, id: second }] }
      : group,
  );
}

function withCoordinates(project: Project, points: readonly TypedPoint[]): Project {
  const draft = { expressions: [...(project.expressions ?? [])] };
  keepCoordinates(draft, points);
  return { ...project, ...draft };
}

/** Makes the points and the two parts of one line. */
class LineSplit {
  readonly points: ProjectPoint[] = [];
  readonly secondId: number;
  cut = 0;
  readonly #project: Project;
  readonly #line: ProjectLine;
  readonly #positions: readonly Position[];
  readonly #curve: LineCurve;
  #next: number;

  constructor(project: Project, line: ProjectLine, positions: readonly Position[], curve: LineCurve) {
    this.#project = project;
    this.#line = line;
    this.#positions = positions;
    this.#curve = curve;
    this.#next = nextId(project, "point");
    this.secondId = nextId(project, "line");
  }

  divide(t: number, point: number | undefined, place: Position): readonly ProjectLine[] {
    const { points, type } = this.#line;
    const tolerance = coincidenceLength(this.#project);
    const inner = points.findIndex(
      (_, i) => i > 0 && i < points.length - 1 && distance(this.#positions[i] ?? place, place) <= tolerance,
    );
    this.cut = point ?? points[inner] ?? this.#add(place);
    const [from, to] = [points[0] ?? 0, points.at(-1) ?? 0];
    const { startTangent, endTangent, ...kept } = this.#line;
    const part = (id: number, own: readonly number[], kind = type): ProjectLine => ({
      ...(id === this.#line.id ? { ...kept, ...(startTangent && { startTangent }) } : {}),
      ...(id === this.secondId && endTangent && { endTangent }),
      id,
      type: kind,
      points: [...own],
    });
    switch (type) {
      case "straight":
        return [part(this.#line.id, [from, this.cut]), part(this.secondId, [this.cut, to])];
      case "parabolic":
        return [
          part(this.#line.id, [from, this.#addAt(t / 2), this.cut]),
          part(this.secondId, [this.cut, this.#addAt((1 + t) / 2), to]),
        ];
      case "arc":
      case "circle":
        return [
          part(this.#line.id, [from, this.#between(0, t), this.cut], "arc"),
          part(this.secondId, [this.cut, this.#between(t, 1), to], "arc"),
        ];
      case "spline":
        return [
          part(this.#line.id, [from, ...this.#splinePoints(0, t), this.cut]),
          part(this.secondId, [this.cut, ...this.#splinePoints(t, 1), to]),
        ];
      case "hermite": {
        // Both parts continue each other at the cut.
        const own = this.#curve.knots.map((knot, i) => ({ knot, id: points[i] ?? 0 })).slice(1, -1);
        const idsOn = (isBefore: boolean): readonly number[] =>
          own.filter(({ knot, id }) => id !== this.cut && knot < t === isBefore).map(({ id }) => id);
        return [
          part(this.#line.id, [from, ...idsOn(true), this.cut]),
          part(this.secondId, [this.cut, ...idsOn(false), to]),
        ];
      }
    }
  }

  /** New points with the expressions that follow from those of the points of the line. */
  get typedPoints(): readonly TypedPoint[] {
    const places = this.points.map(({ position }) => position);
    const texts = expressionsOnLine(this.#project, this.#line, this.#positions, places);
    return texts.map((expressions, i) => ({ id: this.points[i]?.id ?? 0, expressions }));
  }

  #add(position: Position): number {
    const [x, y, z] = position;
    this.points.push({ id: this.#next, position: [x, y, z] });
    return this.#next++;
  }

  #addAt(t: number): number {
    return this.#add(this.#curve.at(t));
  }

  /** A point of the arc between two parameters: one of the line's own if possible. */
  #between(from: number, to: number): number {
    const { points } = this.#line;
    const margin = 0.02;
    const own = points.slice(1, this.#line.type === "circle" ? 3 : 2).find((id, i) => {
      const t = nearestParameter(this.#curve, this.#positions[i + 1] ?? [0, 0, 0]);
      return id !== this.cut && t > from + margin * (to - from) && t < to - margin * (to - from);
    });
    return own ?? this.#addAt((from + to) / 2);
  }

  /** The points of a spline between two parameters, and those that keep its course. */
  #splinePoints(from: number, to: number): readonly number[] {
    const { points } = this.#line;
    const margin = 1e-9;
    const own = this.#curve.knots.flatMap((t, i) =>
      t > from + margin && t < to - margin && i > 0 && i < points.length - 1
        ? [{ t, id: points[i] ?? 0 }]
        : [],
    );
    const stops = [from, ...own.map(({ t }) => t), to];
    const even = stops.slice(1).flatMap((next, i) => this.#partsOf(stops[i] ?? from, next));
    const inner = [...stops, ...even].toSorted((a, b) => a - b);
    const isClosed = points[0] === points.at(-1);
    const near = (end: number, next: number | undefined): readonly number[] =>
      next === undefined ? [] : endShares.map((share) => end + share * (next - end));
    const atStart = from > 0 || isClosed ? near(from, inner[1]) : [];
    const atEnd = to < 1 || isClosed ? near(to, inner.at(-2)) : [];
    const extra = [...even, ...atStart, ...atEnd].map((t) => ({ t, id: null }));
    return [...own, ...extra].toSorted((a, b) => a.t - b.t).map(({ t, id }) => id ?? this.#addAt(t));
  }

  /** Parameters that divide a span into parts of equal length. */
  #partsOf(from: number, to: number): readonly number[] {
    const at = (k: number, count: number): Position => this.#curve.at(from + ((to - from) * k) / count);
    const samples = Array.from({ length: 17 }, (_, k) => at(k, 16));
    const arc = samples.slice(1).reduce((sum, p, k) => sum + distance(samples[k] ?? p, p), 0);
    const defect = arc / distance(at(0, 1), at(1, 1)) - 1;
    // The difference between curve and chords decreases with the square of their number.
    const count = Math.min(maxParts, Math.ceil(Math.sqrt(Math.max(0, defect) / chordDefect)));
    return Array.from({ length: Math.max(0, count - 1) }, (_, k) => from + ((to - from) * (k + 1)) / count);
  }
}
