/** A TrimmedModel as the array of numbers that the engine reads: `cpp/src/model/model_numbers.h` describes it. */
import type {
  Frame,
  PlaneFrame,
  SpaceCurve,
  PlaneCurve,
  FaceSurface,
  TrimmedModel,
} from "./trimmed-model.js";

const CURVES = { line: 0, circle: 1, ellipse: 2, spline: 3 } as const;
const SURFACES = {
  plane: 0,
  cylinder: 1,
  cone: 2,
  sphere: 3,
  torus: 4,
  spline: 5,
  extrusion: 6,
  revolution: 7,
} as const;
const NONE = -1;

/** Returns the numbers of a model. O(numbers). */
export function numbersOf({ vertices, curves, surfaces, edges, faces }: TrimmedModel): Float64Array {
  const numbers: number[] = [vertices.length / 3];
  pushAll(numbers, vertices);
  numbers.push(curves.length);
  for (const curve of curves) pushCurve(numbers, curve);
  numbers.push(surfaces.length);
  for (const surface of surfaces) pushSurface(numbers, surface);
  numbers.push(edges.length);
  for (const { curve = NONE, first, last, start, end, tolerance } of edges)
    numbers.push(curve, first, last, start, end, tolerance);
  numbers.push(faces.length);
  for (const { surface, reversed, solid, otherSolid = NONE, loops } of faces) {
    numbers.push(surface, Number(reversed), solid, otherSolid, loops.length);
    for (const loop of loops) {
      numbers.push(loop.length);
      for (const { edge, reversed: isReversed, inPlane } of loop) {
        numbers.push(edge, Number(isReversed));
        pushCurve(numbers, inPlane);
      }
    }
  }
  return Float64Array.from(numbers);
}

/** Arrays may be too long to be arguments of one call. */
function pushAll(numbers: number[], all: Float64Array): void {
  for (const one of all) numbers.push(one);
}

function pushList(numbers: number[], list: Float64Array): void {
  numbers.push(list.length);
  pushAll(numbers, list);
}

function pushFrame(numbers: number[], frame: Frame | PlaneFrame): void {
  numbers.push(...frame.origin, ...frame.x, ...frame.y, ...("z" in frame ? frame.z : []));
}

function pushCurve(numbers: number[], curve: SpaceCurve | PlaneCurve): void {
  numbers.push(CURVES[curve.kind]);
  if (curve.kind === "spline") {
    const { degree, knots, poles, weights } = curve.spline;
    numbers.push(degree);
    for (const list of [knots, poles, weights]) pushList(numbers, list);
    return;
  }
  pushFrame(numbers, curve.frame);
  numbers.push("radius" in curve ? curve.radius : 0, "minorRadius" in curve ? curve.minorRadius : 0);
}

function pushSurface(numbers: number[], surface: FaceSurface): void {
  numbers.push(SURFACES[surface.kind]);
  if (surface.kind === "spline") {
    const { uDegree, vDegree, uKnots, vKnots, poles, weights } = surface.spline;
    numbers.push(uDegree, vDegree);
    for (const list of [uKnots, vKnots, poles, weights]) pushList(numbers, list);
    return;
  }
  pushFrame(numbers, surface.frame);
  numbers.push(
    "radius" in surface ? surface.radius : 0,
    "minorRadius" in surface ? surface.minorRadius : 0,
    "halfAngle" in surface ? surface.halfAngle : 0,
  );
  if ("profile" in surface) pushCurve(numbers, surface.profile);
}
