/** Evaluates curves and surfaces of a model by the formulas of its types, as an oracle of what readers return. */
import type {
  Curve,
  FaceSurface,
  Frame,
  PlaneFrame,
  TrimmedEdge,
  TrimmedFace,
  TrimmedModel,
} from "../../wasm/dist/cad/trimmed-model.js";

/** Returns a sum of vectors with factors. */
const combined = (origin: readonly number[], ...terms: readonly (readonly [number, readonly number[]])[]) =>
  origin.map((value, i) => terms.reduce((sum, [factor, axis]) => sum + factor * (axis[i] ?? 0), value));

const scalar = (a: readonly number[], b: readonly number[]) =>
  a.reduce((sum, x, i) => sum + x * (b[i] ?? 0), 0);

export const distance = (a: readonly number[], b: readonly number[]) =>
  Math.hypot(...a.map((value, i) => value - (b[i] ?? 0)));

/** De Boor's algorithm; `rows`: one of any length per pole. Beyond its ends, a spline stays where it ends. */
function splineAt(
  degree: number,
  knots: Float64Array,
  rows: readonly (readonly number[])[],
  t: number,
): number[] {
  const knot = (k: number) => knots[k] ?? 0;
  const at = Math.min(Math.max(t, knot(degree)), knot(rows.length));
  let span = degree;
  while (span + 1 < rows.length && at >= knot(span + 1)) span++;
  let points = rows.slice(span - degree, span + 1);
  for (let level = 1; level <= degree; level++) {
    points = points.slice(1).map((row, k) => {
      const begin = knot(span - degree + k + level);
      const factor = (at - begin) / (knot(span + 1 + k) - begin);
      return row.map((value, c) => (1 - factor) * (points[k]?.[c] ?? 0) + factor * value);
    });
  }
  return [...(points[0] ?? [])];
}

/** Returns poles with their weights: (w x, w y, …, w). */
function weighted(poles: Float64Array, weights: Float64Array, size: number): number[][] {
  return Array.from({ length: poles.length / size }, (_, p) => {
    const weight = weights[p] ?? 1;
    return [...Array.from(poles.slice(p * size, (p + 1) * size), (x) => x * weight), weight];
  });
}

const unweighted = (row: readonly number[]) => row.slice(0, -1).map((value) => value / (row.at(-1) ?? 1));

export function curveAt(curve: Curve<Frame | PlaneFrame>, t: number): number[] {
  if (curve.kind === "spline") {
    const { degree, knots, poles, weights } = curve.spline;
    const size = poles.length / (knots.length - degree - 1);
    return unweighted(splineAt(degree, knots, weighted(poles, weights, size), t));
  }
  const { origin, x, y } = curve.frame;
  if (curve.kind === "line") return combined(origin, [t, x]);
  const minor = curve.kind === "circle" ? curve.radius : curve.minorRadius;
  return combined(origin, [curve.radius * Math.cos(t), x], [minor * Math.sin(t), y]);
}

const weightedPoles = new WeakMap<Float64Array, number[][]>();

export function surfaceAt(surface: FaceSurface, u: number, v: number): number[] {
  if (surface.kind === "spline") {
    const { uDegree, vDegree, uKnots, vKnots, poles, weights } = surface.spline;
    const columns = vKnots.length - vDegree - 1;
    const known = weightedPoles.get(poles);
    const all = known ?? weighted(poles, weights, 3);
    if (known === undefined) weightedPoles.set(poles, all);
    const rows = Array.from({ length: all.length / columns }, (_, i) =>
      splineAt(vDegree, vKnots, all.slice(i * columns, (i + 1) * columns), v),
    );
    return unweighted(splineAt(uDegree, uKnots, rows, u));
  }
  const { origin, x, y, z } = surface.frame;
  const round = (radius: number, height: number) =>
    combined(origin, [radius * Math.cos(u), x], [radius * Math.sin(u), y], [height, z]);
  switch (surface.kind) {
    case "plane":
      return combined(origin, [u, x], [v, y]);
    case "cylinder":
      return round(surface.radius, v);
    case "cone":
      return round(surface.radius + v * Math.sin(surface.halfAngle), v * Math.cos(surface.halfAngle));
    case "sphere":
      return round(surface.radius * Math.cos(v), surface.radius * Math.sin(v));
    case "torus":
      return round(surface.radius + surface.minorRadius * Math.cos(v), surface.minorRadius * Math.sin(v));
    case "extrusion":
      return combined(curveAt(surface.profile, u), [v, z]);
    case "revolution": {
      const from = combined(curveAt(surface.profile, v), [-1, origin]);
      const [a, b, c] = [scalar(from, x), scalar(from, y), scalar(from, z)];
      const [cosine, sine] = [Math.cos(u), Math.sin(u)];
      return combined(origin, [a * cosine - b * sine, x], [a * sine + b * cosine, y], [c, z]);
    }
  }
}

const at = <Item>(items: readonly Item[], index: number): Item => {
  const item = items[index];
  if (item === undefined) throw new Error(`${index} is not an index of ${items.length}`);
  return item;
};

export const edgeOf = (model: TrimmedModel, edge: number): TrimmedEdge => at(model.edges, edge);
export const surfaceOf = (model: TrimmedModel, face: TrimmedFace): FaceSurface =>
  at(model.surfaces, face.surface);

/** Returns the position of an edge in space: on its curve, or at its only vertex. */
export function edgeAt(model: TrimmedModel, edge: TrimmedEdge, t: number): number[] {
  if (edge.curve !== undefined) return curveAt(at(model.curves, edge.curve), t);
  return vertexAt(model, edge.start);
}

export const vertexAt = ({ vertices }: TrimmedModel, vertex: number): number[] =>
  Array.from(vertices.slice(3 * vertex, 3 * vertex + 3));

const STEPS = 32;
/** Abscissae and weights of Gauss and Legendre on −1 to 1. */
const GAUSS = [
  [-0.906179845938664, 0.2369268850561891],
  [-0.5384693101056831, 0.4786286704993665],
  [0, 0.5688888888888889],
  [0.5384693101056831, 0.4786286704993665],
  [0.906179845938664, 0.2369268850561891],
] as const;
const PANELS = 2;
const SHIFT = 1e-5;

/** P · (dS/du × dS/dv) / 3, whose integral over a face is its part of the volume. */
function density(surface: FaceSurface, u: number, v: number): number {
  const slope = (du: number, dv: number) =>
    combined(surfaceAt(surface, u + du, v + dv), [-1, surfaceAt(surface, u - du, v - dv)]).map(
      (d) => d / (2 * SHIFT),
    );
  const [[a = 0, b = 0, c = 0], [d = 0, e = 0, f = 0]] = [slope(SHIFT, 0), slope(0, SHIFT)];
  return scalar(surfaceAt(surface, u, v), [b * f - c * e, c * d - a * f, a * e - b * d]) / 3;
}

/** Volume that the faces of a solid enclose, by Green's theorem along their loops in the plane. Relative error about 1e-3. */
export function volumeOf(model: TrimmedModel, solid: number): number {
  let volume = 0;
  for (const face of model.faces) {
    const sign = (face.solid === solid ? 1 : 0) - (face.otherSolid === solid ? 1 : 0);
    if (sign === 0) continue;
    const surface = surfaceOf(model, face);
    let [sum, from] = [0, undefined as number | undefined];
    for (const { edge, reversed, inPlane } of face.loops.flat()) {
      const { first, last } = edgeOf(model, edge);
      const parameter = (k: number) => first + ((last - first) * (reversed ? STEPS - k : k)) / STEPS;
      for (let k = 0; k < STEPS; k++) {
        const [begin, middle, end] = [k, k + 0.5, k + 1].map((s) => curveAt(inPlane, parameter(s)));
        const [u = 0, v = 0] = middle ?? [];
        from ??= u;
        const width = (u - from) / PANELS;
        let inner = 0;
        for (let p = 0; p < PANELS && Math.abs(u - from) > 0; p++)
          for (const [place, weight] of GAUSS)
            inner += (weight * width * density(surface, from + width * (p + (place + 1) / 2), v)) / 2;
        sum += inner * ((end?.[1] ?? 0) - (begin?.[1] ?? 0));
      }
    }
    volume += sign * (face.reversed ? -sum : sum);
  }
  return volume;
}
