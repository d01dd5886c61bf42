/** Loops of curves as the kernel's wires and faces. */
import type {
  TopoDS_Edge,
  TopoDS_Face,
  TopoDS_Shape,
  TopoDS_Vertex,
  TopoDS_Wire,
} from "replicad-opencascadejs";

import { cosineAndSine } from "../../base/same-everywhere.js";
import { cross, dot, lengthOf, minus, plus, scaled, type Vector } from "../../base/vectors.js";
import type { Loop, LoopCurve, Placement, Profile } from "./feature.js";
import { curveThrough } from "./grid-surface.js";
import { FeatureError, type Session } from "./session.js";

/** A wire, and its edges in the order of the curves. */
export interface Wire {
  readonly wire: TopoDS_Wire;
  readonly edges: readonly TopoDS_Edge[];
}

export interface FlatFace {
  readonly face: TopoDS_Face;
  readonly outer: Wire;
  readonly holes: readonly Wire[];
}

/** Ends of curves this close, as a part of the size of the loop, are one. */
const JOINED = 1e-6;
/** Distance from the plane of a profile that counts as none, as a part of its size. */
const FLAT = 1e-7;

const unit = (vector: Vector): Vector => {
  const length = lengthOf(vector);
  if (!(length > 0) || !Number.isFinite(length))
    throw new FeatureError("A direction has no length.", "Give a direction other than 0, 0, 0.");
  return scaled(vector, 1 / length);
};

/** Returns a function from local coordinates to positions. */
export function frameOf({ position, axis, x }: Placement): {
  readonly at: (local: Vector) => Vector;
  readonly x: Vector;
  readonly z: Vector;
} {
  const z = unit(axis);
  const asked = x === undefined ? undefined : minus(x, scaled(z, dot(x, z)));
  const first: Vector = Math.abs(z[0]) < 0.9 ? [1, 0, 0] : [0, 1, 0];
  const chosen = asked !== undefined && lengthOf(asked) > 0 ? asked : minus(first, scaled(z, dot(first, z)));
  const u = unit(chosen);
  const v = cross(z, u);
  const at = (p: Vector) => plus(position, plus(plus(scaled(u, p[0]), scaled(v, p[1])), scaled(z, p[2])));
  return { at, x: u, z };
}

/** Returns the closed loop of straight lines through positions. */
export const polygon = (corners: readonly Vector[]): Loop =>
  corners.map((corner, c) => ({
    kind: "line",
    points: [corner, corners[(c + 1) % corners.length] ?? corner],
  }));

/** A curve with circles by their radius only. */
type KernelCurve = Exclude<LoopCurve, { readonly kind: "three-point-circle" }>;

/** Returns a curve with a circle through three points as one with a radius. Throws if they lie on a straight line. */
function kernelCurve(curve: LoopCurve): KernelCurve {
  if (curve.kind !== "three-point-circle") return curve;
  const [start, over, end] = curve.points;
  const [a, b] = [minus(over, start), minus(end, start)];
  const axis = cross(a, b);
  const square = dot(axis, axis);
  const longest = Math.max(dot(a, a), dot(b, b));
  if (!(square > FLAT * FLAT * longest * longest))
    throw new FeatureError("The three points of a circle lie on a straight line.", "Move one of the points.");
  const weighted = minus(scaled(b, dot(a, a)), scaled(a, dot(b, b)));
  const arm = scaled(cross(weighted, axis), 1 / (2 * square));
  return { kind: "circle", center: plus(start, arm), axis, radius: lengthOf(arm) };
}

/** Returns positions on a curve that determine its plane. */
function samplesOf(given: LoopCurve): readonly Vector[] {
  const curve = kernelCurve(given);
  if (curve.kind !== "circle") return curve.points;
  const { center, axis, radius } = curve;
  const { at } = frameOf({ position: center, axis });
  return Array.from({ length: 8 }, (_, k) => {
    const [cosine, sine] = cosineAndSine((k * Math.PI) / 4);
    return at([radius * cosine, radius * sine, 0]);
  });
}

const samplesOn = (loop: Loop): Vector[] => loop.flatMap((curve) => samplesOf(curve));

function sizeOf(positions: readonly Vector[]): number {
  const [first = [0, 0, 0] as Vector] = positions;
  return Math.max(...positions.map((position) => lengthOf(minus(position, first))));
}

/** Returns a vector about which a loop runs counter-clockwise: twice its area as length (Newell's formula). */
function areaVector(loop: Loop): Vector {
  const positions = samplesOn(loop);
  const [origin = [0, 0, 0] as Vector] = positions;
  return positions.reduce<Vector>(
    (sum, position, k) => {
      const next = positions[(k + 1) % positions.length] ?? position;
      return plus(sum, cross(minus(position, origin), minus(next, origin)));
    },
    [0, 0, 0],
  );
}

/** Returns whether a curve has no ends. */
const isClosed = (curve: KernelCurve): boolean =>
  curve.kind === "circle" || (curve.kind === "spline" && curve.isClosed === true);

/** Makes a wire of curves, whose ends are common vertices. Throws if they do not follow one another. */
export function wireOf(session: Session, given: Loop, closed: boolean): Wire {
  const loop = given.map(kernelCurve);
  const edges =
    loop.length === 1 && loop.every(isClosed)
      ? loop.map((curve) => closedEdge(session, curve))
      : chain(session, loop, closed);
  const maker = session.hold(new session.kernel.BRepBuilderAPI_MakeWire());
  const used = edges.map((edge) => {
    maker.Add(edge);
    if (!maker.IsDone()) throw new FeatureError("The curves of a loop do not follow one another.");
    // The wire may contain a copy, whose ends are those of its neighbours.
    return session.hold(maker.Edge());
  });
  return { wire: session.hold(maker.Wire()), edges: used };
}

function closedEdge(session: Session, curve: KernelCurve): TopoDS_Edge {
  const { BRepBuilderAPI_MakeEdge, gp_Circ } = session.kernel;
  if (curve.kind !== "circle")
    return session.hold(session.hold(new BRepBuilderAPI_MakeEdge(curveOf(session, curve))).Edge());
  if (!(curve.radius > 0)) throw new FeatureError("The radius of a circle is not positive.");
  const circle = session.hold(new gp_Circ(session.axes(curve.center, curve.axis), curve.radius));
  return session.hold(session.hold(new BRepBuilderAPI_MakeEdge(circle)).Edge());
}

function chain(session: Session, loop: readonly KernelCurve[], closed: boolean): TopoDS_Edge[] {
  const ends = loop.map((curve): readonly [Vector, Vector] => {
    if (curve.kind === "circle" || isClosed(curve) || curve.points.length < 2)
      throw new FeatureError("A closed curve is in a loop with others.");
    return [curve.points[0], curve.points.at(-1) as Vector];
  });
  const size = sizeOf(samplesOn(loop));
  const joints = ends.map(([start], c) => {
    const before = ends[c - 1] ?? (closed ? ends.at(-1) : undefined);
    if (before !== undefined && !(lengthOf(minus(before[1], start)) <= JOINED * size))
      throw new FeatureError(`Curve ${c + 1} of a loop does not begin where the one before it ends.`);
    return start;
  });
  const makeVertex = (position: Vector) =>
    session.hold(
      session.hold(new session.kernel.BRepBuilderAPI_MakeVertex(session.point(position))).Vertex(),
    );
  const vertices = joints.map(makeVertex);
  const last = ends.at(-1)?.[1];
  if (!closed && last !== undefined) {
    joints.push(last);
    vertices.push(makeVertex(last));
  }
  return loop.map((curve, c) => {
    const next = (c + 1) % joints.length;
    if (curve.kind === "circle") throw new FeatureError("A closed curve is in a loop with others.");
    const points = curve.points.slice();
    points[0] = joints[c] as Vector;
    points[points.length - 1] = joints[next] as Vector;
    return edgeBetween(session, { ...curve, points } as KernelCurve, vertices[c], vertices[next]);
  });
}

function edgeBetween(
  session: Session,
  curve: KernelCurve,
  start: TopoDS_Vertex | undefined,
  end: TopoDS_Vertex | undefined,
): TopoDS_Edge {
  const { BRepBuilderAPI_MakeEdge } = session.kernel;
  if (start === undefined || end === undefined) throw new FeatureError("A loop has no curves.");
  const maker = session.hold(
    curve.kind === "line"
      ? new BRepBuilderAPI_MakeEdge(start, end)
      : new BRepBuilderAPI_MakeEdge(curveOf(session, curve), start, end),
  );
  if (!maker.IsDone()) throw new FeatureError("A curve of a loop has no length.");
  return session.hold(maker.Edge());
}

function curveOf(session: Session, curve: KernelCurve) {
  const { GC_MakeArcOfCircle, GeomAPI_Interpolate, NCollection_Array1_gp_Pnt, NCollection_HArray1_gp_Pnt } =
    session.kernel;
  if (curve.kind === "arc") {
    const [start, middle, end] = curve.points;
    const arc = session.hold(
      new GC_MakeArcOfCircle(session.point(start), session.point(middle), session.point(end)),
    );
    if (!arc.IsDone()) throw new FeatureError("The three points of an arc lie on a straight line.");
    return session.hold(arc.Value());
  }
  if (curve.kind !== "spline") throw new FeatureError("A closed curve is in a loop with others.");
  if (curve.isEven === true && curve.isClosed !== true) return curveThrough(session, curve.points);
  const array = session.hold(new NCollection_Array1_gp_Pnt(1, curve.points.length));
  curve.points.forEach((point, p) => array.SetValue(p + 1, session.point(point)));
  const points = session.hold(new NCollection_HArray1_gp_Pnt(array));
  const spline = session.hold(new GeomAPI_Interpolate(points, curve.isClosed === true, 1e-9));
  spline.Perform();
  if (!spline.IsDone()) throw new FeatureError("OpenCascade finds no spline through the points.");
  return session.hold(spline.Curve());
}

/** Makes the face within the loops of a profile. Throws if they are not in one plane. */
export function flatFace(session: Session, { outer, holes = [] }: Profile): FlatFace {
  const { BRepBuilderAPI_MakeFace, gp_Pln, TopoDS } = session.kernel;
  const normal = areaVector(outer);
  const positions = [outer, ...holes].flatMap(samplesOn);
  const [origin] = positions;
  const size = sizeOf(positions);
  if (origin === undefined || !(lengthOf(normal) > FLAT * size * size))
    throw new FeatureError("The loop encloses no area.");
  const z = unit(normal);
  if (positions.some((position) => !(Math.abs(dot(minus(position, origin), z)) <= FLAT * size)))
    throw new FeatureError("The loops are not in one plane.");
  const plane = session.hold(new gp_Pln(session.point(origin), session.direction(z)));
  const boundary = wireOf(session, outer, true);
  const maker = session.hold(new BRepBuilderAPI_MakeFace(plane, boundary.wire, true));
  const inner = holes.map((hole) => {
    const made = wireOf(session, hole, true);
    const isReversed = dot(areaVector(hole), z) > 0;
    const turned: TopoDS_Shape = isReversed ? session.hold(made.wire.Reversed()) : made.wire;
    maker.Add(session.hold(TopoDS.Wire(turned)));
    return made;
  });
  if (!maker.IsDone()) throw new FeatureError("OpenCascade finds no face within the loops.");
  return { face: session.hold(maker.Face()), outer: boundary, holes: inner };
}
