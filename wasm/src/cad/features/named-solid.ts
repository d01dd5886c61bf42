/**
 * Names of faces by origin. A name is the id of the feature that made the face, and which face of it: `3/top`. The
 * kernel's algorithms report which faces become which, so that names follow them. Faces with the same name, as the pieces of a
 * split face, are told apart by a number: `3/top#2`. Edges have the names of the two faces beside them: `3/side|3/top`.
 */
import type { NCollection_List_TopoDS_Shape, TopoDS_Edge, TopoDS_Shape } from "replicad-opencascadejs";

import { lengthOf, minus, type Vector } from "../../base/vectors.js";
import { FeatureError, type Session, ShapeIndex } from "./session.js";

/** One or more solids whose faces have names. */
export interface NamedSolid {
  readonly shape: TopoDS_Shape;
  /** The faces in the kernel's order. */
  readonly faces: ShapeIndex;
  /** The name of each face, without numbers. */
  readonly origins: readonly string[];
}

/** The part of the kernel's algorithms that reports what became of a shape. */
interface History {
  Modified(shape: TopoDS_Shape): NCollection_List_TopoDS_Shape;
  IsDeleted(shape: TopoDS_Shape): boolean;
}

/** Gives a name to those of the shapes that are faces of the solid and have none. */
export type GiveName = (shapes: readonly TopoDS_Shape[], name: string) => void;

/** Returns a shape with the names that a function gives to its faces; other faces have the name `rest`. */
export function named(
  session: Session,
  shape: TopoDS_Shape,
  rest: string,
  giveNames: (give: GiveName, unnamed: () => TopoDS_Shape[]) => void,
): NamedSolid {
  const faces = new ShapeIndex(session, session.parts(shape, "face"));
  const origins: (string | undefined)[] = faces.shapes.map(() => undefined);
  const give: GiveName = (shapes, name) => {
    for (const one of shapes) {
      const index = faces.find(one);
      if (index !== undefined) origins[index] ??= name;
    }
  };
  giveNames(give, () => faces.shapes.filter((_, f) => origins[f] === undefined));
  return { shape, faces, origins: origins.map((name) => name ?? rest) };
}

/** Names the faces that were faces of other solids before an algorithm changed them. */
export function giveOldNames(
  session: Session,
  history: History,
  before: readonly NamedSolid[],
  give: GiveName,
): void {
  for (const { faces, origins } of before)
    faces.shapes.forEach((face, f) => {
      const after = history.IsDeleted(face) ? [] : session.shapes(history.Modified(face));
      give(after.length > 0 || history.IsDeleted(face) ? after : [face], origins[f] ?? "");
    });
}

/** Distance from a face within which an edge lies on it. */
const ON_FACE = 1e-6;

/** Returns the faces on which the middle of an edge lies: where the kernel reports no history. */
export function facesAlong(
  session: Session,
  edge: TopoDS_Edge,
  faces: readonly TopoDS_Shape[],
): TopoDS_Shape[] {
  if (faces.length === 0) return [];
  const { BRepAdaptor_Curve, BRepBuilderAPI_MakeVertex, BRepExtrema_DistShapeShape } = session.kernel;
  const curve = session.hold(new BRepAdaptor_Curve(edge));
  const middle = session.hold(curve.Value((curve.FirstParameter() + curve.LastParameter()) / 2));
  const vertex = session.hold(session.hold(new BRepBuilderAPI_MakeVertex(middle)).Vertex());
  return faces.filter((face) => {
    const nearest = session.hold(new BRepExtrema_DistShapeShape());
    nearest.LoadS1(vertex);
    nearest.LoadS2(face);
    return nearest.Perform(session.progress()) && nearest.Value() < ON_FACE;
  });
}

/** Returns the same solid with other names. */
export function renamed(solid: NamedSolid, rename: (name: string) => string): NamedSolid {
  return { ...solid, origins: solid.origins.map(rename) };
}

/**
 * Returns the solids in a shape that an algorithm made, as one shape. Throws if there are none, or if they are not
 * closed, not valid or without volume. Solids inside out are turned.
 */
export function soundShape(session: Session, shape: TopoDS_Shape): TopoDS_Shape {
  const { BRep_Tool } = session.kernel;
  if (shape.IsNull()) throw new FeatureError("Nothing is left of the solid.");
  const solids = session.parts(shape, "solid");
  if (solids.length === 0) throw new FeatureError("Nothing is left of the solid.");
  const outward = solids.map((solid) => {
    const volume = session.volume(solid);
    if (!(Math.abs(volume) > 0)) throw new FeatureError("The solid has no volume.");
    const shells = session.parts(solid, "shell");
    if (shells.length === 0 || !shells.every((shell) => BRep_Tool.IsClosed(shell)))
      throw new FeatureError("The surface of the solid is not closed.");
    return volume > 0 ? solid : session.hold(solid.Reversed());
  });
  const whole = session.together(outward);
  if (!session.isValid(whole)) throw new FeatureError("The surface of the solid would intersect itself.");
  return whole;
}

/** Throws if the surface of a face is of a kind that a TrimmedModel does not describe. */
export function requireDescribable(session: Session, shape: TopoDS_Shape): void {
  const { BRepAdaptor_Surface, GeomAbs_SurfaceType } = session.kernel;
  const { GeomAbs_OffsetSurface, GeomAbs_OtherSurface } = GeomAbs_SurfaceType;
  for (const face of session.parts(shape, "face")) {
    const surface = session.hold(new BRepAdaptor_Surface(session.face(face), false));
    const kind = surface.GetType();
    if (kind === GeomAbs_OffsetSurface || kind === GeomAbs_OtherSurface)
      throw new FeatureError("A face would be an offset surface, which cannot be meshed.");
  }
}

/** Returns the names of the faces, with numbers where several have the same. */
export function faceNames(session: Session, { shape, faces, origins }: NamedSolid): string[] {
  const numbers = numbered(session, shape, faces.shapes, origins, (face, properties) => {
    session.kernel.BRepGProp.SurfaceProperties(face, properties, false, false);
  });
  return origins.map((name, f) => (numbers[f] === 1 ? name : `${name}#${numbers[f]}`));
}

/** An edge between two faces, or along the seam of one. */
export interface NamedEdge {
  readonly edge: TopoDS_Edge;
  readonly name: string;
  /** The names of the faces beside it: the same twice for a seam, where a closed face begins and ends. */
  readonly faces: readonly [string, string];
}

/** Returns the name of the edge between two faces, in any order; several between the same faces are numbered from 1. */
export function edgeName(one: string, other: string, number = 1): string {
  const quoted = [one, other].sort().map((name) => (name.includes("|") ? `(${name})` : name));
  return quoted.join("|") + (number === 1 ? "" : `@${number}`);
}

/** Returns the edges of a solid in the kernel's order; those without length, as the poles of a sphere, are left out. */
export function namedEdges(session: Session, solid: NamedSolid): NamedEdge[] {
  const names = faceNames(session, solid);
  const index = new ShapeIndex(session);
  const beside: string[][] = [];
  solid.faces.shapes.forEach((face, f) => {
    for (const use of session.uses(face, "edge")) {
      if (session.kernel.BRep_Tool.Degenerated(session.edge(use))) continue;
      (beside[index.add(use)] ??= []).push(names[f] ?? "");
    }
  });
  const pairs = beside.map(([one = "", other = one]) => [one, other].sort() as [string, string]);
  const keys = pairs.map(([one, other]) => edgeName(one, other));
  const numbers = numbered(session, solid.shape, index.shapes, keys, (edge, properties) => {
    session.kernel.BRepGProp.LinearProperties(edge, properties, false, false);
  });
  return pairs.map((faces, e) => ({
    edge: session.edge(index.shapes[e] as TopoDS_Shape),
    name: edgeName(...faces, numbers[e]),
    faces,
  }));
}

type Measure = (shape: TopoDS_Shape, properties: InstanceType<Session["kernel"]["GProp_GProps"]>) => void;

/** Coordinates that differ by less than this part of the solid's size count as equal where shapes are put in order. */
const SAME = 1e-6;

/** Numbers the shapes with the same name from 1, in the order of the x, then y, then z of their centroids. */
function numbered(
  session: Session,
  whole: TopoDS_Shape,
  shapes: readonly TopoDS_Shape[],
  names: readonly string[],
  measure: Measure,
): number[] {
  const groups = new Map<string, number[]>();
  names.forEach((name, index) => groups.set(name, [...(groups.get(name) ?? []), index]));
  const numbers = shapes.map(() => 1);
  if (groups.size === shapes.length) return numbers;
  const [low, high] = session.bounds(whole);
  const step = SAME * lengthOf(minus(high, low));
  const placeOf = (index: number): Vector => {
    const properties = session.hold(new session.kernel.GProp_GProps());
    measure(shapes[index] as TopoDS_Shape, properties);
    const { X, Y, Z } = coordinatesOf(session.hold(properties.CentreOfMass()));
    return [Math.round(X / step), Math.round(Y / step), Math.round(Z / step)];
  };
  for (const group of groups.values()) {
    if (group.length === 1) continue;
    const placed = group.map((index) => ({ index, at: placeOf(index) }));
    placed.sort((a, b) => a.at[0] - b.at[0] || a.at[1] - b.at[1] || a.at[2] - b.at[2] || a.index - b.index);
    placed.forEach(({ index }, k) => (numbers[index] = k + 1));
  }
  return numbers;
}

const coordinatesOf = (point: { X(): number; Y(): number; Z(): number }) => ({
  X: point.X(),
  Y: point.Y(),
  Z: point.Z(),
});
