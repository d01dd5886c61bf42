/** The pieces of features: each kind as a solid whose faces have names. */
import type {
  BRepPrimAPI_MakePrism,
  BRepPrimAPI_MakeRevol,
  NCollection_List_TopoDS_Shape,
  TopoDS_Edge,
  TopoDS_Shape,
} from "replicad-opencascadejs";

import { cosineAndSine } from "../../base/same-everywhere.js";
import { dot, lengthOf, scaled, type Vector } from "../../base/vectors.js";
import { combined } from "./combining.js";
import type { FeatureOf, Piece, PieceKinds, Placement, Profile } from "./feature.js";
import { flatFace, frameOf, polygon, type Wire, wireOf } from "./loops.js";
import {
  facesAlong,
  type GiveName,
  named,
  type NamedSolid,
  requireDescribable,
  soundShape,
} from "./named-solid.js";
import { FeatureError, type Session } from "./session.js";
import { sewn } from "./sewing.js";

/** Makes the solid of a feature with a list of its own. */
export type SolidOfList = (feature: FeatureOf<"boolean">) => NamedSolid;

type Makers = {
  readonly [Type in keyof PieceKinds]: (
    session: Session,
    feature: FeatureOf<Type>,
    solidOfList: SolidOfList,
  ) => NamedSolid;
};

const RADIANS = Math.PI / 180;

/** Throws if one of the lengths is not positive. */
export function requirePositive(lengths: Readonly<Record<string, number>>): void {
  for (const [name, length] of Object.entries(lengths))
    if (!(length > 0 && Number.isFinite(length)))
      throw new FeatureError(`The ${name} must be a positive number.`, `Change the ${name}.`);
}

const MAKERS: Makers = {
  box: (session, { id, size, ...placement }) => {
    const [length, width, height] = size;
    requirePositive({ length, width, height });
    const outline = corners(placement, [
      [-length / 2, -width / 2],
      [length / 2, -width / 2],
      [length / 2, width / 2],
      [-length / 2, width / 2],
    ]);
    const labels = ["front", "right", "back", "left"];
    return extruded(session, id, { outer: polygon(outline) }, upward(placement, height), labels);
  },
  cylinder: (session, { id, radius, height, position, axis }) => {
    requirePositive({ radius, height });
    const outer = [{ kind: "circle", center: position, axis, radius }] as const;
    return extruded(session, id, { outer }, upward({ axis, position }, height));
  },
  cone: (session, { id, radius, topRadius, height, ...placement }) => {
    requirePositive({ height, "larger radius": Math.max(radius, topRadius) });
    if (!(Math.min(radius, topRadius) >= 0)) throw new FeatureError("A radius is negative.");
    const outline: TurnedOutline = [
      [0, 0, "bottom"],
      [radius, 0, "side"],
      [topRadius, height, "top"],
      [0, height, ""],
    ];
    return turned(session, id, placement, outline);
  },
  sphere: (session, { id, radius, position, axis, x }) => {
    requirePositive({ radius });
    const maker = new session.kernel.BRepPrimAPI_MakeSphere(
      session.axes(position, axis, x && frameOf({ position, axis, x }).x),
      radius,
    );
    return named(session, session.hold(session.hold(maker).Shape()), `${id}/side`, () => undefined);
  },
  torus: (session, { id, majorRadius, minorRadius, angle = 360, ...placement }) => {
    requirePositive({ "major radius": majorRadius, "minor radius": minorRadius, angle });
    if (minorRadius >= majorRadius)
      throw new FeatureError("The minor radius is not below the major radius.", "Change a radius.");
    const { at } = frameOf(placement);
    const [center, beside] = [at([majorRadius, 0, 0]), at([majorRadius, -1, 0])];
    const axis: Vector = [beside[0] - center[0], beside[1] - center[1], beside[2] - center[2]];
    const outer = [{ kind: "circle", center, axis, radius: minorRadius }] as const;
    return revolved(session, id, { outer }, { ...placement, angle });
  },
  prism: (session, { id, sides, radius, height, ...placement }) => {
    requirePositive({ radius, height });
    if (!(Number.isInteger(sides) && sides >= 3 && sides <= 1000))
      throw new FeatureError("The number of sides must be a whole number from 3 to 1000.");
    const outline = corners(
      placement,
      Array.from({ length: sides }, (_, k) => {
        const [cosine, sine] = cosineAndSine((2 * Math.PI * k) / sides);
        return [radius * cosine, radius * sine];
      }),
    );
    return extruded(session, id, { outer: polygon(outline) }, upward(placement, height));
  },
  wedge: (session, { id, size, topLength, ...placement }) => {
    const [length, width, height] = size;
    requirePositive({ length, width, height });
    if (!(topLength >= 0)) throw new FeatureError("The length of the top is negative.");
    const { at } = frameOf(placement);
    const [left, front] = [-length / 2, -width / 2];
    const top: Vector[] = topLength > 0 ? [at([left + topLength, front, height])] : [];
    const outer = polygon([at([left, front, 0]), at([-left, front, 0]), ...top, at([left, front, height])]);
    const labels = ["bottom", "right", ...(topLength > 0 ? ["top"] : []), "left"];
    const along = scaled(directionOf(placement, [0, 1, 0]), width);
    return extruded(session, id, { outer }, along, labels, ["front", "back"]);
  },
  extrude: (session, { id, profile, vector }) => {
    requirePositive({ length: lengthOf(vector) });
    return extruded(session, id, profile, vector);
  },
  revolve: (session, { id, profile, position, axis, angle }) =>
    revolved(session, id, profile, { position, axis, angle }),
  loft: (session, { id, sections, isRuled = false }) => {
    if (sections.length < 2) throw new FeatureError("A loft needs two sections.");
    return tube(session, id, sections, (wires) => {
      const maker = session.hold(new session.kernel.BRepOffsetAPI_ThruSections(true, isRuled, 1e-6));
      for (const { wire } of wires) maker.AddWire(wire);
      maker.Build(session.progress());
      return maker;
    });
  },
  sweep: (session, { id, profile, path }) => {
    const { BRepOffsetAPI_MakePipeShell, BRepBuilderAPI_TransitionMode } = session.kernel;
    const spine = wireOf(session, path, false).wire;
    return tube(session, id, [profile], ([wire]) => {
      const maker = session.hold(new BRepOffsetAPI_MakePipeShell(spine));
      maker.SetTransitionMode(BRepBuilderAPI_TransitionMode.BRepBuilderAPI_RightCorner);
      if (wire !== undefined) maker.Add(wire.wire, false, false);
      maker.Build(session.progress());
      if (!maker.IsDone() || !maker.MakeSolid())
        throw new FeatureError("OpenCascade cannot sweep the loop along the path.");
      return maker;
    });
  },
  sew: sewn,
  import: (session, { id, brep }) => {
    const shape = soundShape(session, session.hold(session.kernel.BRepToolsWrapper.Read(brep)));
    requireDescribable(session, shape);
    return named(session, shape, "", (give) => {
      session.parts(shape, "face").forEach((face, f) => give([face], `${id}/face ${f + 1}`));
    });
  },
  boolean: (_session, feature, solidOfList) => solidOfList(feature),
};

/** Makes the piece of a feature. Throws a FeatureError if it is impossible. */
export function pieceOf(session: Session, feature: Piece, solidOfList: SolidOfList): NamedSolid {
  if (!Object.hasOwn(MAKERS, feature.type)) throw new FeatureError("This kind of feature is unknown.");
  const make = MAKERS[feature.type] as (
    session: Session,
    feature: Piece,
    solidOfList: SolidOfList,
  ) => NamedSolid;
  return make(session, feature, solidOfList);
}

const corners = (placement: Placement, local: readonly (readonly number[])[]): Vector[] => {
  const { at } = frameOf(placement);
  return local.map(([x = 0, y = 0]) => at([x, y, 0]));
};

/** Returns a direction given in local coordinates. */
function directionOf(placement: Placement, local: Vector): Vector {
  return frameOf({ ...placement, position: [0, 0, 0] }).at(local);
}

const upward = (placement: Placement, height: number): Vector => scaled(frameOf(placement).z, height);

/** Returns names of the faces along the curves of a loop: `side`, or `side 1` and so on if there are several. */
const sideLabels = ({ edges }: Wire, prefix = ""): string[] =>
  edges.map((_, e) => `${prefix}side${edges.length === 1 ? "" : ` ${e + 1}`}`);

type Ends = readonly [start: string, end: string];

function extruded(
  session: Session,
  id: number,
  profile: Profile,
  vector: Vector,
  labels?: readonly string[],
  ends: Ends = ["bottom", "top"],
): NamedSolid {
  const { BRepPrimAPI_MakePrism } = session.kernel;
  return swept(session, id, profile, ends, labels, (face) => {
    return new BRepPrimAPI_MakePrism(face, session.vector(vector), false, true);
  });
}

interface Turn {
  readonly position: Vector;
  readonly axis: Vector;
  readonly angle: number;
}

function revolved(
  session: Session,
  id: number,
  profile: Profile,
  { position, axis, angle }: Turn,
  labels?: readonly string[],
): NamedSolid {
  const { BRepPrimAPI_MakeRevol } = session.kernel;
  if (!(Math.abs(angle) > 0 && Math.abs(angle) <= 360))
    throw new FeatureError("The angle must be from 0 to 360 degrees.", "Change the angle.");
  const line = session.axis(position, frameOf({ position, axis }).z);
  return swept(session, id, profile, ["start", "end"], labels, (face) =>
    Math.abs(angle) === 360
      ? new BRepPrimAPI_MakeRevol(face, line, false)
      : new BRepPrimAPI_MakeRevol(face, line, angle * RADIANS, false),
  );
}

function swept(
  session: Session,
  id: number,
  profile: Profile,
  [start, end]: Ends,
  labels: readonly string[] | undefined,
  makerOf: (face: TopoDS_Shape) => BRepPrimAPI_MakePrism | BRepPrimAPI_MakeRevol,
): NamedSolid {
  const { face, outer, holes } = flatFace(session, profile);
  const maker = session.hold(makerOf(face));
  if (!maker.IsDone()) throw new FeatureError("OpenCascade cannot sweep the profile.");
  const shape = soundShape(session, session.hold(maker.Shape()));
  return named(session, shape, `${id}/side`, (give, unnamed) => {
    const sides = [
      labelled(outer, labels ?? sideLabels(outer)),
      ...holes.map((hole, h) => labelled(hole, sideLabels(hole, `hole ${h + 1} `))),
    ].flat();
    giveSides(session, id, maker, sides, give);
    give([session.hold(maker.FirstShape())], `${id}/${start}`);
    give([session.hold(maker.LastShape())], `${id}/${end}`);
    giveSidesAlong(session, id, sides, give, unnamed);
  });
}

interface Sweeper {
  Generated(shape: TopoDS_Shape): NCollection_List_TopoDS_Shape;
}

/** An edge of a profile, with the name of the face that it becomes. */
type Labelled = readonly [edge: TopoDS_Edge, label: string];

const labelled = ({ edges }: Wire, labels: readonly string[]): Labelled[] =>
  edges.map((edge, e) => [edge, labels[e] ?? "side"]);

function giveSides(
  session: Session,
  id: number,
  maker: Sweeper,
  sides: readonly Labelled[],
  give: GiveName,
): void {
  for (const [edge, label] of sides) give(session.shapes(maker.Generated(edge)), `${id}/${label}`);
}

/** Names the faces that the kernel does not report: of full turns, those that are plane. */
function giveSidesAlong(
  session: Session,
  id: number,
  sides: readonly Labelled[],
  give: GiveName,
  unnamed: () => TopoDS_Shape[],
): void {
  for (const [edge, label] of sides) give(facesAlong(session, edge, unnamed()), `${id}/${label}`);
}

interface TubeMaker extends Sweeper {
  IsDone(): boolean;
  Shape(): TopoDS_Shape;
  FirstShape(): TopoDS_Shape;
  LastShape(): TopoDS_Shape;
}

/** Makes a solid from the outer loops of sections, and cuts out one from each of their holes. */
function tube(
  session: Session,
  id: number,
  sections: readonly Profile[],
  make: (wires: readonly Wire[]) => TubeMaker,
): NamedSolid {
  const holes = sections.map((section) => section.holes ?? []);
  const count = holes[0]?.length ?? 0;
  if (holes.some(({ length }) => length !== count))
    throw new FeatureError("The sections have different numbers of holes.");
  const solidOf = (wires: readonly Wire[], prefix: string): NamedSolid => {
    const maker = make(wires);
    if (!maker.IsDone()) throw new FeatureError("OpenCascade cannot connect the loops.");
    const shape = soundShape(session, session.hold(maker.Shape()));
    return named(session, shape, `${id}/${prefix}side`, (give, unnamed) => {
      const sides = wires.slice(0, 1).flatMap((first) => labelled(first, sideLabels(first, prefix)));
      giveSides(session, id, maker, sides, give);
      give([session.hold(maker.FirstShape())], `${id}/start`);
      give([session.hold(maker.LastShape())], `${id}/end`);
      giveSidesAlong(session, id, sides, give, unnamed);
    });
  };
  const wires = sections.map((section) => flatFace(session, section));
  const outer = solidOf(
    wires.map((flat) => flat.outer),
    "",
  );
  const inner = Array.from({ length: count }, (_, h) =>
    solidOf(
      wires.flatMap((flat) => flat.holes.slice(h, h + 1)),
      `hole ${h + 1} `,
    ),
  );
  return inner.length === 0 ? outer : combined(session, "cut", outer, inner);
}

/** Corners of an outline at a distance from the axis and a height, each with the name of the face to the next corner. */
export type TurnedOutline = readonly (readonly [radius: number, height: number, label: string])[];

/** Makes the solid that an outline beside the axis becomes when it is turned around. Corners may be the same. */
export function turned(
  session: Session,
  id: number,
  placement: Placement,
  outline: TurnedOutline,
): NamedSolid {
  const { at } = frameOf(placement);
  const distinct = outline.filter(([radius, height], c) => {
    const next = outline[(c + 1) % outline.length];
    return radius !== next?.[0] || height !== next[1];
  });
  const outer = polygon(distinct.map(([radius, height]) => at([radius, 0, height])));
  const labels = distinct.map(([, , label]) => label);
  return revolved(session, id, { outer }, { ...placement, angle: 360 }, labels);
}

/** Returns how far a shape extends from a position along a direction of length 1. */
export function extentOf(session: Session, shape: TopoDS_Shape, position: Vector, along: Vector): number {
  const [low, high] = session.bounds(shape);
  const farthest = along.map((part, d) => ((part > 0 ? high[d] : low[d]) ?? 0) - (position[d] ?? 0));
  return dot(farthest as unknown as Vector, along);
}
