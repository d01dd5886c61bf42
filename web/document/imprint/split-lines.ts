import type { PatchType, ProjectLine, ProjectPatch, ProjectPoint } from "tetrafront";
import { samplesAlong } from "../line-samples";
import type { Flat } from "../planar-loops";
import { PointIndex } from "../point-index";
import { fromFrame, toFrame, zero, type Frame } from "../vectors";
import type { Drawn } from "./drawn";
import { crossingOf, distanceFrom, type Side } from "./plane-polygons";

/** Types of patches whose lines may be divided: the others need a certain number of them. */
const divisible: ReadonlySet<PatchType> = new Set(["planar", "tube"]);

/**
 * How near the samples of a curve pass a place on the curve, relative to the distance between two samples: the sagitta of a
 * quarter of a circle in eight parts, a little enlarged.
 */
const sagitta = 0.03;

interface FlatLine {
  readonly line: ProjectLine;
  readonly samples: readonly Flat[];
}

/**
 * Divides the straight lines among the given ones, which lie in the plane of a frame, where they cross each other and where
 * another one ends on them; pieces with the same ends become one. Returns null if this would divide a curved line or a line
 * of a patch that needs a certain number of lines. O(n²) for n lines.
 */
export function splitLines(
  drawn: Drawn,
  ids: ReadonlySet<number>,
  frame: Frame,
  tolerance: number,
): Drawn | null {
  const positions = new Map(drawn.points.map(({ id, position }) => [id, position]));
  const flat = new Map<number, Flat>();
  const lines = drawn.lines.filter(({ id }) => ids.has(id));
  for (const point of new Set(lines.flatMap((line) => line.points))) {
    const [x, y] = toFrame(frame, positions.get(point) ?? zero);
    flat.set(point, [x, y]);
  }
  const flatLines = lines.map((line): FlatLine => {
    const course = samplesAlong(
      line.type,
      line.points.map((point) => positions.get(point) ?? zero),
    );
    const samples = course.map((position): Flat => {
      const [x, y] = toFrame(frame, position);
      return [x, y];
    });
    return { line, samples };
  });
  const curved = flatLines.filter(({ line }) => line.type !== "straight");
  const straight = flatLines.filter(({ line }) => line.type === "straight");
  if (curved.some((curve) => flatLines.some((other) => other !== curve && touch(curve, other, tolerance)))) {
    return null;
  }
  const ends = new Map<number, Flat>();
  for (const { points } of lines) {
    for (const end of [points.at(0), points.at(-1)]) {
      const place = end === undefined ? undefined : flat.get(end);
      if (end !== undefined && place) ends.set(end, place);
    }
  }
  const crossings = crossingPoints(straight, [...ends.values()], tolerance);
  const points: ProjectPoint[] = [];
  let nextPoint = drawn.points.reduce((highest, { id }) => Math.max(highest, id), 0) + 1;
  for (const [x, y] of crossings) {
    const id = nextPoint++;
    const [px, py, pz] = fromFrame(frame, [x, y, 0]);
    points.push({ id, position: [px, py, pz] });
    ends.set(id, [x, y]);
  }
  const chains = new Map(straight.map(({ line }) => [line.id, chainAlong(line, ends, tolerance)]));
  const divided = new Set([...chains].filter(([, chain]) => chain.length > 2).map(([id]) => id));
  const isFixed = ({ type, loops }: ProjectPatch): boolean =>
    !divisible.has(type) && loops.some((loop) => loop.some((step) => divided.has(Math.abs(step))));
  if (drawn.patches.some(isFixed)) return null;
  return divided.size === 0 ? drawn : withPieces({ ...drawn, points: [...drawn.points, ...points] }, chains);
}

/** Returns where straight lines cross each other away from all ends, each place once. */
function crossingPoints(
  lines: readonly FlatLine[],
  ends: readonly Flat[],
  tolerance: number,
): readonly Flat[] {
  const known = new PointIndex<true>(tolerance);
  for (const [x, y] of ends) known.add([x, y, 0], true);
  const found: Flat[] = [];
  lines.forEach((one, i) => {
    for (const other of lines.slice(i + 1)) {
      const place = crossingOf(sideOf(one), sideOf(other));
      if (!place || known.find([...place, 0])) continue;
      known.add([...place, 0], true);
      found.push(place);
    }
  });
  return found;
}

/** Returns the points along a straight line: its ends, and between them all that lie on it. */
function chainAlong(
  { points: [from = 0, to = 0] }: ProjectLine,
  all: ReadonlyMap<number, Flat>,
  tolerance: number,
): readonly number[] {
  const [start = [0, 0], end = [0, 0]] = [all.get(from), all.get(to)];
  const [ux, uy] = [end[0] - start[0], end[1] - start[1]];
  const squared = ux * ux + uy * uy;
  const inner = [...all].flatMap(([point, [x, y]]) => {
    if (point === from || point === to || squared === 0) return [];
    const share = ((x - start[0]) * ux + (y - start[1]) * uy) / squared;
    const off = Math.hypot(x - start[0] - share * ux, y - start[1] - share * uy);
    const margin = tolerance / Math.sqrt(squared);
    return off <= tolerance && share > margin && share < 1 - margin ? [{ point, share }] : [];
  });
  return [from, ...inner.sort((a, b) => a.share - b.share).map(({ point }) => point), to];
}

/** Replaces straight lines by the pieces between the points along them. A line keeps its id for the first piece of its own. */
function withPieces(drawn: Drawn, chains: ReadonlyMap<number, readonly number[]>): Drawn {
  const known = new Map<string, { readonly id: number; readonly from: number }>();
  const pieces = new Map<number, readonly number[]>();
  let next = drawn.lines.reduce((highest, { id }) => Math.max(highest, id), 0) + 1;
  const lines = drawn.lines.flatMap((line): ProjectLine[] => {
    const chain = chains.get(line.id);
    if (!chain) return [line];
    const made: ProjectLine[] = [];
    const steps = chain.slice(0, -1).map((from, i) => {
      const to = chain[i + 1] ?? from;
      const key = [Math.min(from, to), Math.max(from, to)].join(" ");
      const same = known.get(key);
      if (same) return same.from === from ? same.id : -same.id;
      const isWhole = chain.length === 2;
      const id = made.length === 0 ? line.id : next++;
      made.push(
        isWhole ? line : { ...(made.length === 0 ? line : { type: line.type }), id, points: [from, to] },
      );
      known.set(key, { id, from });
      return id;
    });
    pieces.set(line.id, steps);
    return made;
  });
  const along = (step: number): readonly number[] => {
    const steps = pieces.get(Math.abs(step));
    if (!steps) return [step];
    return step > 0 ? steps : steps.toReversed().map((piece) => -piece);
  };
  const patches = drawn.patches.map((patch) =>
    patch.loops.some((loop) => loop.some((step) => along(step).length !== 1 || along(step)[0] !== step))
      ? { ...patch, loops: patch.loops.map((loop) => loop.flatMap(along)) }
      : patch,
  );
  return { points: drawn.points, lines, patches };
}

/** Returns whether a curve touches another line elsewhere than at an end that both have. */
function touch(curve: FlatLine, other: FlatLine, tolerance: number): boolean {
  const endsOf = ({ line }: FlatLine) => [line.points.at(0), line.points.at(-1)];
  const shared = endsOf(curve).flatMap((end, i) =>
    endsOf(other).includes(end) ? [curve.samples.at(i === 0 ? 0 : -1) ?? ([0, 0] as const)] : [],
  );
  const isShared = ([x, y]: Flat, reach: number): boolean =>
    shared.some((end) => Math.hypot(x - end[0], y - end[1]) <= reach);
  for (const side of sidesOf(curve.samples)) {
    const [a, b] = side;
    const reach = Math.max(tolerance, sagitta * Math.hypot(b[0] - a[0], b[1] - a[1]));
    for (const its of sidesOf(other.samples)) {
      const places = [
        crossingOf(side, its),
        ...its.filter((end) => distanceFrom(end, side) <= reach),
        ...side.filter((end) => distanceFrom(end, its) <= reach),
      ];
      if (places.some((place) => place && !isShared(place, reach))) return true;
    }
  }
  return false;
}

const sidesOf = (samples: readonly Flat[]): readonly Side[] =>
  samples.slice(0, -1).map((from, i) => [from, samples[i + 1] ?? from]);

const sideOf = ({ samples: [from = [0, 0], to = [0, 0]] }: FlatLine): Side => [from, to];
