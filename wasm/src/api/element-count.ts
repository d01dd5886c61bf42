/**
 * Finds the factor on all sizes with which a mesh has a wanted number of elements: meshes, measures and corrects. The logarithm of
 * the number is nearly a straight line over the logarithm of the factor: its slope is about -3 inside a volume, -2 along
 * surfaces and thin walls, and 0 where the shape alone decides. Depends on the numbers only, so that the result is the same on every computer.
 */

import { steady } from "../base/same-everywhere.js";

/** A part of the model, around its middle, in which the sizes have a smaller factor. */
export interface FinerPart {
  readonly factor: number;
  /** Share of the model, from 0 to 1. */
  readonly share: number;
}

/** A mesh that was made with a factor on all sizes. */
export interface CountedMesh<Made> {
  readonly factor: number;
  readonly finer?: FinerPart | undefined;
  /** Number of elements; undefined if no mesh could be made. */
  readonly count: number | undefined;
  readonly made: Made;
}

/** Why a search has ended. */
export type SearchEnd =
  | "reached"
  /** Larger sizes make hardly fewer elements. */
  | "least"
  /** Smaller sizes make hardly more elements, or more than memory holds. */
  | "most"
  /** The number jumps past the wanted one, however little the factor changes. */
  | "nearest"
  /** No mesh could be made, or the search was ended. */
  | "failed";

export interface CountResult<Made> {
  /** The mesh with the number nearest to the wanted one. */
  readonly best: CountedMesh<Made>;
  readonly end: SearchEnd;
  readonly runs: number;
  /** The nearest numbers on both sides of the wanted one, in ascending order; for the end `nearest`. */
  readonly reachable?: readonly number[] | undefined;
}

export interface CountSearch<Made> {
  readonly wanted: number;
  /** Factor of the first mesh. */
  readonly first: number;
  /** Makes a mesh. `share`: the part of the remaining work that it is expected to be, 0 to 1. */
  readonly mesh: (factor: number, share: number, finer?: FinerPart) => Promise<CountedMesh<Made>>;
  /** Whether meshes can have a finer part, for numbers between which one factor leaves a gap. Default false. */
  readonly hasFinerParts?: boolean | undefined;
  /** Whether to end with what was made so far. */
  readonly isEnded?: () => boolean;
}

/** Largest relative difference from the wanted number that counts as reached. */
export const COUNT_TOLERANCE = 0.05;
/** Difference at which the search stops at once. */
const CLOSE = 0.03;
/** Numbers of runs after which a difference up to the tolerance suffices, and after which the search ends. */
const GOOD_RUNS = 4;
const MAX_RUNS = 8;
/** Below this number, meshes are made quickly, and their number jumps from factor to factor: more runs. */
const FEW_ELEMENTS = 5000;
const MAX_RUNS_OF_FEW = 20;
/** Above this number, a run with fewer elements comes first if the next guess is far. */
const MANY_ELEMENTS = 50_000;
const FAR = Math.log(10);
const FIRST_STEP = Math.log(6);
/** Limits of the factor. */
const MIN_FACTOR = 1e-3;
const MAX_FACTOR = 200;
/** Assumed slopes where no two meshes are known, towards fewer and towards more elements, and the limits of known ones. */
const SLOPE_COARSER = 2;
const SLOPE_FINER = 2.7;
const MIN_SLOPE = 0.4;
const MAX_SLOPE = 3.5;
/** Largest step of the logarithm of the factor without a mesh on the other side. */
const MAX_STEP = Math.log(6);
/** Change of the logarithm of the number, for a step of at least this size, below which the shape alone decides. */
const FLAT_CHANGE = 0.02;
const FLAT_STEP = Math.log(1.5);
/** Part of an interval at its ends in which no mesh is made. */
const MARGIN = 0.12;
/** Places in an interval where a mesh is made if the straight line leads to a known one: the number may jump up and down. */
const OTHER_PLACES = [0.5, 0.3, 0.7, 0.15, 0.85];
/** Distance to a known mesh / width of the interval, below which the place counts as known. */
const KNOWN = 0.05;
/** Width of an interval below which the number jumps, without and with finer parts. */
const NARROW = 0.004;
const NARROW_FOR_PARTS = 0.015;
/** Largest number of meshes with a finer part, and of others if such parts have not sufficed. */
const MAX_PARTS = 8;
const MAX_FURTHER_RUNS = 6;
/** Factors around the nearest mesh that are tried if the number jumps. */
const SCAN_STEP = 0.012;

interface Point {
  readonly x: number;
  readonly y: number;
}

/** The meshes made so far, and the next factor. Of the meshes themselves, only the nearest one is kept. */
class Search<Made> {
  readonly #wanted: number;
  readonly #points: Point[] = [];
  /** Logarithms of factors with which no mesh could be made. */
  readonly #failed: number[] = [];
  #scans = 0;
  #best: CountedMesh<Made> | undefined;

  #narrow: number;

  constructor(wanted: number, hasFinerParts: boolean) {
    this.#wanted = Math.log(wanted);
    this.#narrow = hasFinerParts ? NARROW_FOR_PARTS : NARROW;
  }

  /** Looks between the two nearest factors too, because finer parts have no effect. */
  withoutParts(): void {
    this.#narrow = NARROW;
  }

  get best(): CountedMesh<Made> | undefined {
    return this.#best;
  }

  #distance({ y }: Point): number {
    return Math.abs(y - this.#wanted);
  }

  get #nearestFirst(): Point[] {
    return [...this.#points].sort((a, b) => this.#distance(a) - this.#distance(b));
  }

  add(mesh: CountedMesh<Made>): void {
    const x = Math.log(mesh.factor);
    if (mesh.count === undefined || mesh.count < 1) {
      this.#failed.push(x);
      return;
    }
    const point = { x, y: Math.log(mesh.count) };
    const [nearest] = this.#nearestFirst;
    if (nearest === undefined || this.#distance(point) < this.#distance(nearest)) this.#best = mesh;
    this.#points.push(point);
  }

  /** The nearest point with too many elements. */
  get above(): Point | undefined {
    return this.#nearestFirst.find(({ y }) => y > this.#wanted);
  }

  /** The nearest point with too few elements. */
  get below(): Point | undefined {
    return this.#nearestFirst.find(({ y }) => y <= this.#wanted);
  }

  /** Returns the next logarithm of a factor, or why there is none. */
  next(): number | SearchEnd {
    const { above, below } = this;
    if (above && below) return this.#between(above, below);
    if (above) return this.#outside(above, 1);
    if (below) return this.#outside(below, -1);
    return "failed";
  }

  #between(above: Point, below: Point): number | SearchEnd {
    const width = below.x - above.x;
    // Numbers of elements need not fall with the factor.
    if (Math.abs(width) < this.#narrow) return this.#scan();
    const straight = (above.y - this.#wanted) / (above.y - below.y);
    const places = [Math.min(1 - MARGIN, Math.max(MARGIN, straight)), ...OTHER_PLACES];
    const next = places
      .map((place) => above.x + place * width)
      .find((x) => !this.#isKnown(x, Math.abs(width) * KNOWN));
    return next ?? this.#scan();
  }

  /** Tries factors on both sides of the nearest one. */
  #scan(): number | SearchEnd {
    const [best] = this.#narrow > NARROW ? [] : this.#nearestFirst;
    while (best && this.#scans < MAX_RUNS_OF_FEW) {
      const step = Math.ceil((this.#scans + 1) / 2) * (this.#scans % 2 === 0 ? 1 : -1);
      this.#scans += 1;
      const x = best.x + step * SCAN_STEP;
      if (!this.#isKnown(x)) return x;
    }
    return "nearest";
  }

  #isKnown(x: number, distance = NARROW / 4): boolean {
    const isNear = (other: number) => Math.abs(other - x) < distance;
    return this.#points.some((point) => isNear(point.x)) || this.#failed.some(isNear);
  }

  /** `side`: 1 for larger factors, -1 for smaller ones. */
  #outside(from: Point, side: 1 | -1): number | SearchEnd {
    const last = this.#points.reduce((a, b) => (side * b.x > side * a.x ? b : a));
    const barrier = this.#failed.filter((x) => side * (x - last.x) > 0);
    if (barrier.length > 0) {
      const nearest = barrier.reduce((a, b) => (side * b < side * a ? b : a));
      const x = (last.x + nearest) / 2;
      return barrier.length > 1 ? (side > 0 ? "least" : "most") : x;
    }
    const before = this.#points
      .filter((point) => side * (last.x - point.x) >= FLAT_STEP)
      .reduce<Point | undefined>((a, b) => (a && side * a.x > side * b.x ? a : b), undefined);
    const isFlat = before !== undefined && Math.abs(last.y - before.y) < FLAT_CHANGE;
    const limit = Math.log(side > 0 ? MAX_FACTOR : MIN_FACTOR);
    if (isFlat || side * (limit - last.x) <= 0) return side > 0 ? "least" : "most";
    return this.#extrapolated(from, last, side, limit);
  }

  #extrapolated(from: Point, last: Point, side: 1 | -1, limit: number): number {
    const others = this.#points.filter((point) => point !== last && Math.abs(point.x - last.x) > NARROW);
    const other = others.reduce<Point | undefined>(
      (a, b) => (a && Math.abs(a.x - last.x) < Math.abs(b.x - last.x) ? a : b),
      undefined,
    );
    const measured = other && -(last.y - other.y) / (last.x - other.x);
    const assumed = side > 0 ? SLOPE_COARSER : SLOPE_FINER;
    const slope = Math.min(MAX_SLOPE, Math.max(MIN_SLOPE, measured ?? assumed));
    let missing = side * (from.y - this.#wanted);
    // The slope is not known so far from there, and a run with all elements is long.
    if (side < 0 && missing > FAR && this.#wanted > Math.log(MANY_ELEMENTS)) missing -= FIRST_STEP;
    const step = Math.min(MAX_STEP, Math.max(missing / slope, SCAN_STEP));
    const x = (measured === undefined ? from.x : last.x) + side * step;
    const beyond = side * (x - last.x) > 0 ? x : last.x + side * SCAN_STEP;
    return side > 0 ? Math.min(beyond, limit) : Math.max(beyond, limit);
  }
}

/** Returns the mesh with the number nearest to the wanted one, the first of equal ones. */
function nearest<Made>(
  wanted: number,
  ...meshes: readonly (CountedMesh<Made> | undefined)[]
): CountedMesh<Made> | undefined {
  return meshes.reduce((a, b) =>
    b?.count !== undefined && (a?.count === undefined || errorOf(b.count, wanted) < errorOf(a.count, wanted))
      ? b
      : a,
  );
}

/** Returns the factor at a logarithm. */
const factorAt = (x: number): number => steady(Math.exp(x));

const errorOf = (count: number, wanted: number): number => Math.abs(count / wanted - 1);

/** Meshes until the number of elements is near the wanted one, or cannot be. Rejects as `mesh` does. */
export async function meshedToCount<Made>(searched: CountSearch<Made>): Promise<CountResult<Made>> {
  const { wanted, isEnded = () => false } = searched;
  let { hasFinerParts = false } = searched;
  const search = new Search<Made>(wanted, hasFinerParts);
  let most = wanted < FEW_ELEMENTS ? MAX_RUNS_OF_FEW : MAX_RUNS;
  let withPart: CountedMesh<Made> | undefined;
  const limited = Math.min(MAX_FACTOR, Math.max(MIN_FACTOR, searched.first));
  let last = await searched.mesh(limited, FIRST_SHARE);
  let runs = 1;
  search.add(last);
  if (last.count === undefined && limited !== 1 && !isEnded()) {
    last = await searched.mesh(1, FIRST_SHARE);
    search.add(last);
    runs = 2;
  }
  for (;;) {
    const best = nearest(wanted, search.best, withPart);
    if (best?.count === undefined || isEnded()) return { best: best ?? last, end: "failed", runs };
    const error = errorOf(best.count, wanted);
    if (error <= CLOSE || (error <= COUNT_TOLERANCE && runs >= GOOD_RUNS))
      return { best, end: "reached", runs };
    const next = runs < most ? search.next() : "nearest";
    if (typeof next === "string") {
      if (error <= COUNT_TOLERANCE) return { best, end: "reached", runs };
      const { above, below } = search;
      const isBetween = next === "nearest" && hasFinerParts && above !== undefined && below !== undefined;
      const sides = [below, above, withPart && { y: Math.log(withPart.count ?? 1) }];
      const counts = sides.flatMap((side) => (side ? [Math.round(Math.exp(side.y))] : []));
      const reachable = [...new Set(counts)].sort((a, b) => a - b);
      if (!isBetween) return { best, end: next, runs, reachable };
      const found = await withFinerPart(searched, { best, end: next, runs }, above, below);
      if (found.end !== "nearest") return found;
      ({ best: withPart, runs } = found);
      hasFinerParts = false;
      search.withoutParts();
      most = runs + MAX_FURTHER_RUNS;
      continue;
    }
    last = await searched.mesh(factorAt(next), shareOf(best.count, wanted));
    runs += 1;
    search.add(last);
    if (isEnded()) return { best: last, end: "failed", runs };
  }
}

/**
 * Where one factor makes too few elements and a slightly smaller one too many, uses the smaller one in a part of the model
 * only. `found`: without such a part.
 */
async function withFinerPart<Made>(
  { wanted, mesh, isEnded = () => false }: CountSearch<Made>,
  found: CountResult<Made>,
  above: Point,
  below: Point,
): Promise<CountResult<Made>> {
  let { best, runs } = found;
  let [few, many] = [
    { share: 0, count: Math.round(Math.exp(below.y)) },
    { share: 1, count: Math.round(Math.exp(above.y)) },
  ];
  for (let part = 0; part < MAX_PARTS; part++) {
    const straight = (wanted - few.count) / (many.count - few.count);
    // Halves the interval every third time: the number may jump within it.
    const place = part % 3 === 2 ? 0.5 : Math.min(1 - MARGIN, Math.max(MARGIN, straight));
    const share = few.share + place * (many.share - few.share);
    const made = await mesh(factorAt(below.x), LAST_SHARE, { factor: factorAt(above.x), share });
    runs += 1;
    if (isEnded()) return { best: made, end: "failed", runs };
    const { count } = made;
    // Sizes below those of the finer part leave it without effect.
    const isUseless = part > 0 && (count === few.count || count === many.count);
    if (count === undefined || isUseless) break;
    if (errorOf(count, wanted) < errorOf(best.count ?? 0, wanted)) best = made;
    if (errorOf(count, wanted) <= COUNT_TOLERANCE) return { best, end: "reached", runs };
    if (count < wanted) few = { share, count };
    else many = { share, count };
  }
  return { best, end: "nearest", runs };
}

/** Parts of the remaining work: the first mesh is far from the wanted one; one that follows a near one is likely to be the last. */
const FIRST_SHARE = 0.3;
const NEXT_SHARE = 0.5;
const LAST_SHARE = 0.8;
const NEAR_COUNT = 0.3;

const shareOf = (count: number, wanted: number): number =>
  errorOf(count, wanted) < NEAR_COUNT ? LAST_SHARE : NEXT_SHARE;
