/** Features that change the solid: holes, fillets, chamfers, shells, motions, mirrors and arrays. */
import type { gp_Trsf, TopoDS_Shape } from "replicad-opencascadejs";

import { cosineAndSine } from "../../base/same-everywhere.js";
import { scaled } from "../../base/vectors.js";
import { combined, transformed } from "./combining.js";
import type { Change, ChangeKinds, FeatureOf, Operation } from "./feature.js";
import { frameOf } from "./loops.js";
import {
  faceNames,
  giveOldNames,
  named,
  type NamedEdge,
  namedEdges,
  type NamedSolid,
  renamed,
  requireDescribable,
  soundShape,
} from "./named-solid.js";
import { extentOf, requirePositive, turned, type TurnedOutline } from "./pieces.js";
import { FeatureError, type Session } from "./session.js";

/** The pieces of the features so far, by id, for arrays of them. */
export type Pieces = Map<number, { readonly piece: NamedSolid; readonly operation: Operation }>;

/** What a feature finds. */
export interface Before {
  readonly solid: NamedSolid;
  readonly pieces: Pieces;
}

type Makers = {
  readonly [Type in keyof ChangeKinds]: (
    session: Session,
    feature: FeatureOf<Type>,
    before: Before,
  ) => NamedSolid;
};

const RADIANS = Math.PI / 180;
/** Largest number of copies: more take minutes. */
const MAX_COPIES = 1000;
/** Depth of a solid along a hole / diameter of the hole, up to which it is rounding of the box around the solid. */
const OUTSIDE = 1e-6;
/** Distance within which the kernel makes the offset faces of a shell meet, as a part of the thickness. */
const SHELL_TOLERANCE = 1e-5;

const MAKERS: Makers = {
  hole: (session, feature, { solid, pieces }) => {
    const piece = turned(session, feature.id, feature, holeOutline(session, feature, solid));
    pieces.set(feature.id, { piece, operation: "cut" });
    return combined(session, "cut", solid, [piece]);
  },
  fillet: (session, { id, edges, radius }, { solid }) => {
    requirePositive({ radius });
    const maker = session.hold(new session.kernel.BRepFilletAPI_MakeFillet(solid.shape));
    const all = namedEdges(session, solid);
    for (const { edge } of edgesOfNames(all, edges)) maker.Add(radius, edge);
    return rounded(session, maker, solid, all, `${id}/fillet`);
  },
  chamfer: (session, { id, edges, distance }, { solid }) => {
    requirePositive({ distance });
    const maker = session.hold(new session.kernel.BRepFilletAPI_MakeChamfer(solid.shape));
    const all = namedEdges(session, solid);
    for (const { edge } of edgesOfNames(all, edges)) maker.Add(distance, edge);
    return rounded(session, maker, solid, all, `${id}/chamfer`);
  },
  shell: (session, { id, openFaces, thickness }, { solid }) => {
    requirePositive({ thickness });
    if (session.parts(solid.shape, "solid").length !== 1)
      throw new FeatureError("Only one solid can become a shell.", "Join the solids before.");
    return openFaces.length === 0
      ? hollow(session, id, solid, thickness)
      : opened(session, id, solid, thickness, openFaces);
  },
  move: (session, { translation, rotation }, before) => {
    const motion = session.hold(new session.kernel.gp_Trsf());
    if (translation !== undefined) motion.SetTranslation(session.vector(translation));
    if (rotation !== undefined) motion.Multiply(turn(session, rotation, rotation.angle));
    return allTransformed(session, before, motion);
  },
  mirror: (session, { id, position, normal, keepOriginal = false }, before) => {
    const motion = session.hold(new session.kernel.gp_Trsf());
    motion.SetMirror(session.axes(position, frameOf({ position, axis: normal }).z));
    if (!keepOriginal) return allTransformed(session, before, motion);
    const image = transformed(session, before.solid, motion);
    return combined(session, "join", before.solid, [renamed(image, (name) => `${id}/mirror ${name}`)]);
  },
  "linear-array": (session, feature, before) =>
    repeated(session, feature, before, (k) => {
      const motion = session.hold(new session.kernel.gp_Trsf());
      motion.SetTranslation(session.vector(scaled(feature.step, k)));
      return motion;
    }),
  "circular-array": (session, feature, before) =>
    repeated(session, feature, before, (k) => turn(session, feature, feature.angle * k)),
};

/** Returns the solid after a change. Throws a FeatureError if it is impossible. */
export function changed(session: Session, feature: Change, before: Before): NamedSolid {
  if (!Object.hasOwn(MAKERS, feature.type)) throw new FeatureError("This kind of feature is unknown.");
  const make = MAKERS[feature.type] as (session: Session, feature: Change, before: Before) => NamedSolid;
  return make(session, feature, before);
}

function holeOutline(
  session: Session,
  { diameter, depth, counterbore, countersink, position, axis }: FeatureOf<"hole">,
  { shape }: NamedSolid,
): TurnedOutline {
  requirePositive({ diameter, depth: depth ?? 1 });
  const radius = diameter / 2;
  const along = frameOf({ position, axis }).z;
  const through = extentOf(session, shape, position, along);
  if (depth === undefined && !(through > OUTSIDE * diameter))
    throw new FeatureError("The hole points away from the solid.", "Reverse the axis.");
  const bottom = depth ?? through + diameter;
  const wider: (readonly [number, number, string])[] = [];
  let entry = radius;
  let from = 0;
  if (counterbore !== undefined) {
    requirePositive({ "depth of the counterbore": counterbore.depth });
    entry = counterbore.diameter / 2;
    from = counterbore.depth;
    wider.push([entry, 0, "counterbore"], [entry, from, "counterbore floor"]);
  }
  if (countersink !== undefined) {
    requirePositive({ "angle of the countersink": countersink.angle });
    const wide = countersink.diameter / 2;
    if (countersink.angle >= 180) throw new FeatureError("The angle of the countersink is not below 180.");
    if (wide <= radius) throw new FeatureError("The countersink is not wider than the hole.");
    if (counterbore === undefined) entry = wide;
    wider.push([wide, from, "countersink"]);
    const [cosine, sine] = cosineAndSine((countersink.angle * RADIANS) / 2);
    from += ((wide - radius) * cosine) / sine;
  }
  if (entry < radius || (counterbore !== undefined && entry <= radius))
    throw new FeatureError("The counterbore is not wider than the hole.");
  if (countersink !== undefined && counterbore !== undefined && countersink.diameter > counterbore.diameter)
    throw new FeatureError("The countersink is wider than the counterbore.");
  if (from >= bottom) throw new FeatureError("The hole is not deeper than its counterbore or countersink.");
  return [[0, 0, "entry"], ...wider, [radius, from, "side"], [radius, bottom, "bottom"], [0, bottom, ""]];
}

/** Returns the edges with these names. */
function edgesOfNames(all: readonly NamedEdge[], names: readonly string[]): NamedEdge[] {
  if (names.length === 0) throw new FeatureError("No edge is chosen.", "Choose an edge.");
  return names.map((name) => {
    const found = all.find((edge) => edge.name === name);
    if (found === undefined)
      throw new FeatureError(`The solid has no edge ${name}.`, "Choose the edge again, or another one.");
    return found;
  });
}

type Rounding = InstanceType<Session["kernel"]["BRepFilletAPI_MakeFillet" | "BRepFilletAPI_MakeChamfer"]>;

function rounded(
  session: Session,
  maker: Rounding,
  solid: NamedSolid,
  edges: readonly NamedEdge[],
  prefix: string,
): NamedSolid {
  maker.Build(session.progress());
  if (!maker.IsDone()) throw new FeatureError("OpenCascade finds no such faces along the edges.");
  const shape = soundShape(session, session.hold(maker.Shape()));
  const names = faceNames(session, solid);
  return named(session, shape, `${prefix} corner`, (give) => {
    giveOldNames(session, maker, [solid], give);
    for (const { edge, name } of edges) give(session.shapes(maker.Generated(edge)), `${prefix} ${name}`);
    for (const [vertex, around] of facesAtVertices(session, solid, names))
      give(session.shapes(maker.Generated(vertex)), `${prefix} ${around}`);
  });
}

/** Returns each vertex with the names of the faces around it. */
function facesAtVertices(
  session: Session,
  { shape, faces }: NamedSolid,
  names: readonly string[],
): (readonly [TopoDS_Shape, string])[] {
  const vertices = session.parts(shape, "vertex");
  const around = vertices.map((): string[] => []);
  faces.shapes.forEach((face, f) => {
    for (const corner of session.parts(face, "vertex"))
      vertices.forEach((vertex, v) => {
        if (vertex.IsSame(corner)) around[v]?.push(names[f] ?? "");
      });
  });
  return vertices.map((vertex, v) => [vertex, around[v]?.sort().join("|") ?? ""]);
}

/** Returns the walls of a solid without some of its faces. */
function opened(
  session: Session,
  id: number,
  solid: NamedSolid,
  thickness: number,
  openFaces: readonly string[],
): NamedSolid {
  const { BRepOffset_Mode, BRepOffsetAPI_MakeThickSolid, GeomAbs_JoinType } = session.kernel;
  const names = faceNames(session, solid);
  const open = openFaces.map((name) => {
    const face = solid.faces.shapes[names.indexOf(name)];
    if (face === undefined)
      throw new FeatureError(`The solid has no face ${name}.`, "Choose the face again, or another one.");
    return face;
  });
  const maker = session.hold(new BRepOffsetAPI_MakeThickSolid());
  maker.MakeThickSolidByJoin(
    solid.shape,
    session.list(open),
    -thickness,
    SHELL_TOLERANCE * thickness,
    BRepOffset_Mode.BRepOffset_Skin,
    false,
    false,
    GeomAbs_JoinType.GeomAbs_Intersection,
    false,
    session.progress(),
  );
  if (!maker.IsDone()) throw new FeatureError("OpenCascade finds no wall of this thickness.");
  const shape = soundShape(session, session.hold(maker.Shape()));
  requireDescribable(session, shape);
  if (!(session.volume(shape) < session.volume(solid.shape)))
    throw new FeatureError("The wall is too thick: nothing inside would be empty.");
  return named(session, shape, `${id}/wall`, (give) => {
    giveOldNames(session, maker, [solid], give);
    solid.faces.shapes.forEach((face, f) => {
      give(session.shapes(maker.Generated(face)), `${id}/inner ${solid.origins[f]}`);
    });
  });
}

/** Returns a solid with a closed cavity. */
function hollow(session: Session, id: number, solid: NamedSolid, thickness: number): NamedSolid {
  const { BRepOffset_Mode, BRepOffsetAPI_MakeOffsetShape, GeomAbs_JoinType } = session.kernel;
  const maker = session.hold(new BRepOffsetAPI_MakeOffsetShape());
  maker.PerformByJoin(
    solid.shape,
    -thickness,
    SHELL_TOLERANCE * thickness,
    BRepOffset_Mode.BRepOffset_Skin,
    false,
    false,
    GeomAbs_JoinType.GeomAbs_Intersection,
    false,
    session.progress(),
  );
  if (!maker.IsDone()) throw new FeatureError("OpenCascade finds no wall of this thickness.");
  const shape = soundShape(session, session.hold(maker.Shape()));
  requireDescribable(session, shape);
  const cavity = named(session, shape, `${id}/inner`, (give) => {
    solid.faces.shapes.forEach((face, f) => {
      give(session.shapes(maker.Generated(face)), `${id}/inner ${solid.origins[f]}`);
    });
  });
  return combined(session, "cut", solid, [cavity]);
}

/** Transforms a solid, and the pieces that arrays may repeat. */
function allTransformed(session: Session, { solid, pieces }: Before, motion: gp_Trsf): NamedSolid {
  const whole = transformed(session, solid, motion);
  for (const [id, { piece, operation }] of [...pieces])
    pieces.set(id, { piece: transformed(session, piece, motion), operation });
  return whole;
}

interface Axis {
  readonly position: FeatureOf<"circular-array">["position"];
  readonly axis: FeatureOf<"circular-array">["axis"];
}

function turn(session: Session, { position, axis }: Axis, degrees: number): gp_Trsf {
  const motion = session.hold(new session.kernel.gp_Trsf());
  motion.SetRotation(session.axis(position, frameOf({ position, axis }).z), degrees * RADIANS);
  return motion;
}

/** Repeats the whole solid, or the pieces of features with their operations. */
function repeated(
  session: Session,
  { id, count, features }: FeatureOf<"linear-array" | "circular-array">,
  { solid, pieces }: Before,
  motionOf: (k: number) => gp_Trsf,
): NamedSolid {
  if (!(Number.isInteger(count) && count >= 1 && count <= MAX_COPIES))
    throw new FeatureError(`The count must be a whole number from 1 to ${MAX_COPIES}.`, "Change the count.");
  if (count === 1) return solid;
  const motions = Array.from({ length: count - 1 }, (_, k) => motionOf(k + 1));
  const copiesOf = (piece: NamedSolid) =>
    motions.map((motion, k) =>
      renamed(transformed(session, piece, motion), (name) => `${id}/${k + 2} ${name}`),
    );
  if (features === undefined) return combined(session, "join", solid, copiesOf(solid));
  return features.reduce((whole, feature) => {
    const found = pieces.get(feature);
    if (found === undefined)
      throw new FeatureError(
        `Feature ${feature} has no piece that can be repeated.`,
        "Choose other features.",
      );
    const operation = found.operation === "new" ? "join" : found.operation;
    return combined(session, operation, whole, copiesOf(found.piece));
  }, solid);
}
