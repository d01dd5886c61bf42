/** Solids that faces of any kind enclose. */
import type { BRepBuilderAPI_Sewing, TopoDS_Shape } from "replicad-opencascadejs";

import { dot, lengthOf, minus, plus, scaled, type Vector } from "../../base/vectors.js";
import type { FaceLook, FeatureOf, GridFace, LoopCurve, SewnFace, TurnedFace } from "./feature.js";
import { deviationOf, rowsOf, surfaceThrough } from "./grid-surface.js";
import { flatFace, frameOf, wireOf } from "./loops.js";
import { named, type NamedSolid, soundShape } from "./named-solid.js";
import { FeatureError, type Session, ShapeIndex } from "./session.js";

/**
 * Distances of curves that are one edge, as a part of the size of all faces: of exact ones, and where a face goes through positions or
 * coordinates are rounded.
 */
const EXACT = 1e-9;
const NEAR = 1e-5;
/** A surface through positions may be this far from its patch, as a part of the size of all faces. */
const MAX_DEVIATION = 1e-4;
/** Sides of a surface through positions below this part of the size of the patch are a point. */
const POINT = 1e-9;
const FULL_TURN = 360;

/** Makes a solid of faces that enclose it. */
export function sewn(session: Session, { id, faces, looks = [] }: FeatureOf<"sew">): NamedSolid {
  const labels = faces.map((_, f) => labelOf(looks[f], f));
  const made = faces.map((face, f) => faceOf(session, face, labels[f] ?? ""));
  const [low, high] = session.bounds(session.together(made.map(({ face }) => face)));
  const size = lengthOf(minus(high, low));
  const far = labels.filter((_, f) => (made[f]?.deviation ?? 0) > MAX_DEVIATION * size);
  if (far.length > 0)
    throw new FeatureError(
      `No surface follows ${far.join(", ")} closely enough.`,
      "Divide the patch where its lines bend.",
    );
  const parts = made.map(({ face }) => face);
  const hasGrids = faces.some((face) => "grid" in face);
  const exact = hasGrids ? undefined : joined(session, parts, EXACT * size);
  const sewing = exact?.NbFreeEdges() === 0 ? exact : joined(session, parts, NEAR * size);
  const after = made.map(({ face }) =>
    sewing.IsModified(face) ? session.hold(sewing.Modified(face)) : face,
  );
  requireClosed(session, sewing, after, labels);
  const solid = soundShape(session, solidsWithin(session, session.hold(sewing.SewedShape())));
  return named(session, solid, `${id}/face`, (give) => {
    after.forEach((face, f) => give(session.parts(face, "face"), `${id}/face ${f + 1}`));
  });
}

const labelOf = (look: FaceLook | undefined, index: number): string => look?.name ?? `face ${index + 1}`;

interface MadeFace {
  readonly face: TopoDS_Shape;
  /** Estimated distance from the patch that it follows; 0 if it is exact. */
  readonly deviation: number;
}

function faceOf(session: Session, face: SewnFace, label: string): MadeFace {
  if ("outer" in face) return { face: flatFace(session, face).face, deviation: 0 };
  return "grid" in face
    ? smoothFace(session, face, label)
    : { face: turnedFace(session, face), deviation: 0 };
}

function turnedFace(session: Session, { curve, position, axis, angle }: TurnedFace): TopoDS_Shape {
  const { BRepPrimAPI_MakeRevol } = session.kernel;
  const from = Math.abs(angle) === FULL_TURN ? atSeam(session, curve, position, axis) : curve;
  const [edge] = wireOf(session, [from], false).edges;
  if (edge === undefined) throw new FeatureError("A turned face has no curve.");
  const line = session.axis(position, frameOf({ position, axis }).z);
  const maker = session.hold(
    Math.abs(angle) === FULL_TURN
      ? new BRepPrimAPI_MakeRevol(edge, line, false)
      : new BRepPrimAPI_MakeRevol(edge, line, (angle * Math.PI) / 180, false),
  );
  const [face] = maker.IsDone() ? session.parts(session.hold(maker.Shape()), "face") : [];
  if (face === undefined) throw new FeatureError("OpenCascade cannot turn the curve of a face.");
  return face;
}

/** Returns a curve in a plane with the axis at the angle where the kernel begins circles, so that rims have one vertex. */
function atSeam(session: Session, curve: LoopCurve, position: Vector, axis: Vector): LoopCurve {
  if (curve.kind !== "line") return curve;
  const { z } = frameOf({ position, axis });
  const direction = session.hold(session.axes(position, axis).XDirection());
  const x: Vector = [direction.X(), direction.Y(), direction.Z()];
  const moved = (point: Vector): Vector => {
    const [offset, height] = [minus(point, position), dot(minus(point, position), z)];
    const radius = lengthOf(minus(offset, scaled(z, height)));
    return plus(position, plus(scaled(x, radius), scaled(z, height)));
  };
  const [start, end] = curve.points;
  return { kind: "line", points: [moved(start), moved(end)] };
}

function smoothFace(session: Session, face: GridFace, label: string): MadeFace {
  const rows = rowsOf(face);
  if (rows === undefined)
    throw new FeatureError(`The positions of ${label} are damaged.`, "Sew the patches again.");
  const size = Math.max(
    ...rows.flat().map((position) => lengthOf(minus(position, rows[0]?.[0] ?? position))),
  );
  const maker = session.hold(
    new session.kernel.BRepBuilderAPI_MakeFace(surfaceThrough(session, rows), POINT * size),
  );
  if (!maker.IsDone()) throw new FeatureError(`OpenCascade finds no face through ${label}.`);
  return { face: session.hold(maker.Face()), deviation: deviationOf(rows) };
}

function joined(session: Session, faces: readonly TopoDS_Shape[], tolerance: number): BRepBuilderAPI_Sewing {
  const sewing = session.hold(new session.kernel.BRepBuilderAPI_Sewing(tolerance, true, true, true, false));
  for (const face of faces) sewing.Add(face);
  sewing.Perform(session.progress());
  return sewing;
}

/** Throws if an edge has not two faces, with the faces beside the opening if it has one only. */
function requireClosed(
  session: Session,
  sewing: BRepBuilderAPI_Sewing,
  faces: readonly TopoDS_Shape[],
  labels: readonly string[],
): void {
  if (sewing.NbMultipleEdges() > 0)
    throw new FeatureError(
      "More than two patches meet at a line.",
      "Sew the patches around each volume by themselves: keep the drawn patches, and select those of one volume.",
    );
  const count = sewing.NbFreeEdges();
  if (count === 0) return;
  const free = new ShapeIndex(
    session,
    Array.from({ length: count }, (_, e) => session.hold(sewing.FreeEdge(e + 1))),
  );
  const beside = labels.filter((_, f) => {
    const face = faces[f];
    return face && session.parts(face, "edge").some((edge) => free.find(edge) !== undefined);
  });
  throw new FeatureError(`The patches do not enclose a volume: it is open at ${beside.join(", ")}.`);
}

/** A closed shell, and the solid that it alone would bound, both facing outward. */
interface Closed {
  readonly shell: TopoDS_Shape;
  readonly solid: TopoDS_Shape;
}

/** Returns the solids that shells bound: a shell within a solid is a cavity, and one within a cavity a solid again. */
function solidsWithin(session: Session, shape: TopoDS_Shape): TopoDS_Shape {
  const shells = session.parts(shape, "shell").map((shell) => outward(session, shell));
  if (shells.length === 0) throw new FeatureError("The patches do not enclose a volume.");
  const around = new Map(
    shells.map((inner) => [
      inner,
      shells.filter((outer) => outer !== inner && contains(session, outer, inner)),
    ]),
  );
  const depthOf = (one: Closed): number => around.get(one)?.length ?? 0;
  const solids = shells
    .filter((one) => depthOf(one) % 2 === 0)
    .map((outer) => {
      const cavities = shells.filter(
        (inner) => depthOf(inner) === depthOf(outer) + 1 && around.get(inner)?.includes(outer) === true,
      );
      return cavities.length === 0 ? outer.solid : hollow(session, outer, cavities);
    });
  return session.together(solids);
}

function outward(session: Session, shell: TopoDS_Shape): Closed {
  const solid = solidOf(session, shell, []);
  if (session.volume(solid) >= 0) return { shell, solid };
  const turned = session.hold(shell.Reversed());
  return { shell: turned, solid: solidOf(session, turned, []) };
}

const hollow = (session: Session, { shell }: Closed, cavities: readonly Closed[]): TopoDS_Shape =>
  solidOf(
    session,
    shell,
    cavities.map((cavity) => session.hold(cavity.shell.Reversed())),
  );

function solidOf(session: Session, shell: TopoDS_Shape, cavities: readonly TopoDS_Shape[]): TopoDS_Shape {
  const { BRepBuilderAPI_MakeSolid, TopoDS } = session.kernel;
  const maker = session.hold(new BRepBuilderAPI_MakeSolid(session.hold(TopoDS.Shell(shell))));
  for (const cavity of cavities) maker.Add(session.hold(TopoDS.Shell(cavity)));
  return session.hold(maker.Solid());
}

/** Returns whether a shell, which crosses no other one, lies within another one. */
function contains(session: Session, outer: Closed, inner: Closed): boolean {
  const [vertex] = session.parts(inner.shell, "vertex");
  if (vertex === undefined) return false;
  const nearest = session.hold(new session.kernel.BRepExtrema_DistShapeShape());
  nearest.LoadS1(vertex);
  nearest.LoadS2(outer.solid);
  return nearest.Perform(session.progress()) && nearest.InnerSolution();
}
