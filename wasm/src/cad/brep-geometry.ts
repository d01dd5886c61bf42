/**
 * Reads the curves and surfaces of a BREP file. Some become known splines only when the range of their parameter is
 * known: periodic splines, parabolas and hyperbolas.
 */
import { hyperbolicCosineAndSine, steady } from "../base/same-everywhere.js";
import { cross, type Vector } from "../base/vectors.js";
import type { BrepWords } from "./brep-words.js";
import type { Placing } from "./brep-locations.js";
import {
  bezierKnots,
  type Derivatives,
  flatKnots,
  type Knots,
  picked,
  poleCount,
  quinticSpline,
} from "./splines.js";
import type { Curve, FaceSurface, Frame, PlaneFrame, PlaneVector, SpaceCurve } from "./trimmed-model.js";

interface StoredSpline {
  readonly kind: "stored";
  readonly knots: Knots;
  readonly poles: Float64Array;
  readonly weights: Float64Array;
}

interface Conic<In> {
  readonly kind: "parabola" | "hyperbola";
  readonly frame: In;
  /** Focal length of a parabola; half-axis of a hyperbola along x. */
  readonly radius: number;
  readonly minorRadius: number;
}

/** What cannot be described. `kind` names it in notes. */
interface Other {
  readonly kind: "other";
  readonly name: string;
}

export type StoredCurve<In> = Exclude<Curve<In>, { kind: "spline" }> | StoredSpline | Conic<In> | Other;

interface StoredSurfaceSpline {
  readonly kind: "stored";
  readonly u: Knots;
  readonly v: Knots;
  readonly poles: Float64Array;
  readonly weights: Float64Array;
}

interface Swept {
  readonly kind: "extrusion" | "revolution";
  readonly frame: Frame;
  readonly profile: StoredCurve<Frame>;
}

export type StoredSurface =
  | Exclude<FaceSurface, { kind: "spline" | "extrusion" | "revolution" }>
  | StoredSurfaceSpline
  | Swept
  | Other;

/** How frames of the plane and of space are read and used. */
interface Space<In> {
  readonly size: 2 | 3;
  line(words: BrepWords): In;
  frame(words: BrepWords): In;
  /** Position of a + x r + y s. */
  position(frame: In, r: number, s: number): number[];
}

const sum = (a: readonly number[], x: readonly number[], y: readonly number[], r: number, s: number) =>
  a.map((value, i) => value + r * (x[i] ?? 0) + s * (y[i] ?? 0));

export const PLANE: Space<PlaneFrame> = {
  size: 2,
  line: (words) => {
    const [origin, x] = [words.planeVector(), words.planeVector()];
    return { origin, x, y: [-x[1], x[0]] };
  },
  frame: (words) => ({ origin: words.planeVector(), x: words.planeVector(), y: words.planeVector() }),
  position: ({ origin, x, y }, r, s) => sum(origin, x, y, r, s),
};

export const SPACE: Space<Frame> = {
  size: 3,
  line: (words) => along(words.vector(), words.vector()),
  frame: (words) => {
    const [origin, z, x, y] = [words.vector(), words.vector(), words.vector(), words.vector()];
    return { origin, x, y, z };
  },
  position: ({ origin, x, y }, r, s) => sum(origin, x, y, r, s),
};

/** Returns a right-handed frame whose x-axis is a unit vector. */
function along(origin: Vector, x: Vector): Frame {
  const smallest = x.map(Math.abs).indexOf(Math.min(...x.map(Math.abs)));
  const normal = cross(x, [smallest === 0 ? 1 : 0, smallest === 1 ? 1 : 0, smallest === 2 ? 1 : 0]);
  const length = Math.hypot(...normal);
  const y: Vector = [normal[0] / length, normal[1] / length, normal[2] / length];
  return { origin, x, y, z: cross(x, y) };
}

export function readCurve<In>(words: BrepWords, space: Space<In>): StoredCurve<In> {
  const kind = words.count();
  switch (kind) {
    case 1:
      return { kind: "line", frame: space.line(words) };
    case 2:
      return { kind: "circle", frame: space.frame(words), radius: words.number() };
    case 3:
      return {
        kind: "ellipse",
        frame: space.frame(words),
        radius: words.number(),
        minorRadius: words.number(),
      };
    case 4:
      return { kind: "parabola", frame: space.frame(words), radius: words.number(), minorRadius: 0 };
    case 5:
      return {
        kind: "hyperbola",
        frame: space.frame(words),
        radius: words.number(),
        minorRadius: words.number(),
      };
    case 6:
      return bezierCurve(words, space.size);
    case 7:
      return splineCurve(words, space.size);
    case 8:
      // A part of a curve has the parameter of the whole curve.
      words.numbers(2);
      return readCurve(words, space);
    case 9:
      words.numbers(space.size === 2 ? 1 : 4);
      readCurve(words, space);
      return { kind: "other", name: "an offset curve" };
    default:
      throw words.wrong(`expected a kind of curve from 1 to 9, found ${kind}`);
  }
}

function bezierCurve(words: BrepWords, size: number): StoredSpline {
  const [isRational, degree] = [words.flag(), words.count(MAX_DEGREE)];
  return { kind: "stored", knots: bezierKnots(degree), ...polesOf(words, degree + 1, size, isRational) };
}

/** OpenCascade's largest degree. */
const MAX_DEGREE = 25;

function splineCurve(words: BrepWords, size: number): StoredSpline {
  const [isRational, isPeriodic, degree] = [words.flag(), words.flag(), words.count(MAX_DEGREE)];
  const [poles, count] = [words.count(), words.count()];
  const read = polesOf(words, poles, size, isRational);
  const knots = knotsOf(words, { degree, isPeriodic, count, poles });
  return { kind: "stored", knots, ...read };
}

interface Counts {
  readonly degree: number;
  readonly isPeriodic: boolean;
  /** Number of different knots. */
  readonly count: number;
  readonly poles: number;
}

function knotsOf(words: BrepWords, { degree, isPeriodic, count, poles }: Counts): Knots {
  const pairs = words.numbers(2 * count);
  const values = pairs.filter((_, i) => i % 2 === 0);
  const knots = {
    degree,
    isPeriodic,
    values,
    multiplicities: Array.from(pairs.filter((_, i) => i % 2 === 1)),
  };
  const isAscending = values.every((value, k) => k === 0 || value > (values[k - 1] ?? 0));
  if (count < 2 || !isAscending || poleCount(knots) !== poles)
    throw words.wrong(`the knots of a spline do not fit its ${poles} poles`);
  return knots;
}

function polesOf(words: BrepWords, count: number, size: number, isRational: boolean) {
  const row = size + (isRational ? 1 : 0);
  const all = words.numbers(count * row);
  const poles = all.filter((_, i) => i % row < size);
  const weights = isRational ? all.filter((_, i) => i % row === size) : new Float64Array();
  if (weights.some((weight) => !(weight > 0))) throw words.wrong("a weight of a spline is not positive");
  return { poles, weights };
}

export function readSurface(words: BrepWords): StoredSurface {
  const kind = words.count();
  switch (kind) {
    case 1:
      return { kind: "plane", frame: SPACE.frame(words) };
    case 2:
      return { kind: "cylinder", frame: SPACE.frame(words), radius: words.number() };
    case 3:
      return { kind: "cone", frame: SPACE.frame(words), radius: words.number(), halfAngle: words.number() };
    case 4:
      return { kind: "sphere", frame: SPACE.frame(words), radius: words.number() };
    case 5:
      return {
        kind: "torus",
        frame: SPACE.frame(words),
        radius: words.number(),
        minorRadius: words.number(),
      };
    case 6: {
      const frame = turned(along([0, 0, 0], words.vector()));
      return { kind: "extrusion", frame, profile: readCurve(words, SPACE) };
    }
    case 7: {
      const frame = turned(along(words.vector(), words.vector()));
      return { kind: "revolution", frame, profile: readCurve(words, SPACE) };
    }
    case 8:
      return bezierSurface(words);
    case 9:
      return splineSurface(words);
    case 10:
      words.numbers(4);
      return readSurface(words);
    case 11:
      words.number();
      readSurface(words);
      return { kind: "other", name: "an offset surface" };
    default:
      throw words.wrong(`expected a kind of surface from 1 to 11, found ${kind}`);
  }
}

/** Returns a frame whose z-axis is the x-axis of the given one, of the same orientation. */
const turned = ({ origin, x, y, z }: Frame): Frame => ({ origin, x: y, y: z, z: x });

function bezierSurface(words: BrepWords): StoredSurfaceSpline {
  const isRational = [words.flag(), words.flag()].includes(true);
  const [uDegree, vDegree] = [words.count(MAX_DEGREE), words.count(MAX_DEGREE)];
  const read = polesOf(words, (uDegree + 1) * (vDegree + 1), 3, isRational);
  return { kind: "stored", u: bezierKnots(uDegree), v: bezierKnots(vDegree), ...read };
}

function splineSurface(words: BrepWords): StoredSurfaceSpline {
  const isRational = [words.flag(), words.flag()].includes(true);
  const isPeriodic = [words.flag(), words.flag()] as const;
  const degree = [words.count(MAX_DEGREE), words.count(MAX_DEGREE)] as const;
  const poles = [words.count(), words.count()] as const;
  const count = [words.count(), words.count()] as const;
  const read = polesOf(words, poles[0] * poles[1], 3, isRational);
  const direction = (d: 0 | 1) =>
    knotsOf(words, { degree: degree[d], isPeriodic: isPeriodic[d], count: count[d], poles: poles[d] });
  return { kind: "stored", u: direction(0), v: direction(1), ...read };
}

/** Largest distance of a hyperbola from its spline, relative to its half-axes at the ends of the range. */
const HYPERBOLA_ERROR = 1e-12;

/** Returns a curve over a range of its parameter, or the name of what cannot be described. */
export function curveOver<In>(
  stored: StoredCurve<In>,
  [first, last]: PlaneVector,
  space: Space<In>,
): Curve<In> | Other {
  switch (stored.kind) {
    case "stored": {
      const { knots, poles } = flatKnots(stored.knots, first, last);
      const { degree } = stored.knots;
      const weights = picked(stored.weights, poles, 1);
      return {
        kind: "spline",
        spline: { degree, knots, poles: picked(stored.poles, poles, space.size), weights },
      };
    }
    case "parabola": {
      // A polynomial of degree 2: its quintic pieces are exact.
      const focal = 4 * stored.radius;
      const none = space.position(stored.frame, 0, 0);
      const vector = (r: number, s: number) =>
        space.position(stored.frame, r, s).map((a, i) => a - (none[i] ?? 0));
      const at: Derivatives = (t) => [
        space.position(stored.frame, (t * t) / focal, t),
        vector((2 * t) / focal, 1),
        vector(2 / focal, 0),
      ];
      return { kind: "spline", spline: quinticSpline(at, first, last, 1) };
    }
    case "hyperbola": {
      const { frame, radius, minorRadius } = stored;
      const none = space.position(frame, 0, 0);
      const at: Derivatives = (t) => {
        const [cosine, sine] = hyperbolicCosineAndSine(t);
        const position = space.position(frame, radius * cosine, minorRadius * sine);
        const vector = (r: number, s: number) =>
          space.position(frame, r, s).map((a, i) => a - (none[i] ?? 0));
        return [
          position,
          vector(radius * sine, minorRadius * cosine),
          vector(radius * cosine, minorRadius * sine),
        ];
      };
      // The error of quintic Hermite interpolation over a step h is h^6 / 46080 times the sixth derivative.
      const step = steady((46080 * HYPERBOLA_ERROR) ** (1 / 6));
      const pieces = Math.max(1, Math.ceil((last - first) / step));
      return pieces > MAX_PIECES
        ? { kind: "other", name: "a very long hyperbola" }
        : { kind: "spline", spline: quinticSpline(at, first, last, pieces) };
    }
    default:
      return stored;
  }
}

const MAX_PIECES = 1000;

/** Returns a surface over ranges of u and v, moved to its place; or the name of what cannot be described. */
export function surfaceOver(
  stored: StoredSurface,
  u: PlaneVector,
  v: PlaneVector,
  placing: Placing,
): FaceSurface | Other {
  switch (stored.kind) {
    case "stored": {
      const [inU, inV] = [flatKnots(stored.u, ...u), flatKnots(stored.v, ...v)];
      const columns = poleCount(stored.v);
      const indices = inU.poles.flatMap((i) => inV.poles.map((j) => i * columns + j));
      const poles = placing.points(picked(stored.poles, indices, 3));
      const weights = picked(stored.weights, indices, 1);
      const [uDegree, vDegree] = [stored.u.degree, stored.v.degree];
      return {
        kind: "spline",
        spline: { uDegree, vDegree, uKnots: inU.knots, vKnots: inV.knots, poles, weights },
      };
    }
    case "extrusion":
    case "revolution": {
      const profile = curveOver(stored.profile, stored.kind === "extrusion" ? u : v, SPACE);
      if (profile.kind === "other") return profile;
      return {
        kind: stored.kind,
        frame: placing.frame(stored.frame),
        profile: placedCurve(profile, placing),
      };
    }
    case "other":
      return stored;
    default:
      return { ...stored, frame: placing.frame(stored.frame) };
  }
}

/** Returns a curve that has been moved to its place. */
export function placedCurve(curve: SpaceCurve, placing: Placing): SpaceCurve {
  if (curve.kind !== "spline") return { ...curve, frame: placing.frame(curve.frame) };
  return { kind: "spline", spline: { ...curve.spline, poles: placing.points(curve.spline.poles) } };
}
