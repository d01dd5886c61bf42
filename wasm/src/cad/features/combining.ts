/** Booleans of solids whose faces have names. */
import type { gp_Trsf, TopoDS_Shape } from "replicad-opencascadejs";

import type { Operation } from "./feature.js";
import { giveOldNames, named, type NamedSolid, soundShape } from "./named-solid.js";
import { FeatureError, type Session } from "./session.js";

const MAKERS = {
  join: "BRepAlgoAPI_Fuse",
  cut: "BRepAlgoAPI_Cut",
  intersect: "BRepAlgoAPI_Common",
} as const;

/** Normals of faces that differ by less, in radians, are those of one surface. */
const SAME_DIRECTION = 1e-9;

/** Volume cut away / volume of the solid, below which it is rounding. */
const NOTHING_CUT = 1e-9;

/** Combines pieces with a solid. Faces of one surface that a union makes neighbours become one, with the first one's name. */
export function combined(
  session: Session,
  operation: Operation,
  solid: NamedSolid | undefined,
  pieces: readonly NamedSolid[],
): NamedSolid {
  const [first, ...others] = pieces;
  if (first === undefined) throw new FeatureError("There is nothing to combine.");
  if (solid === undefined) {
    if (operation === "cut" || operation === "intersect")
      throw new FeatureError("There is no solid before it.", "Choose the operation New.");
    return others.length === 0 ? first : combined(session, operation, first, others);
  }
  if (operation === "new") return beside(session, [solid, ...pieces]);
  if (operation === "intersect" && others.length > 0)
    return combined(session, operation, combined(session, operation, solid, [first]), others);
  const united = operation === "join" ? booleanOf(session, operation, solid, pieces, true) : undefined;
  const result = united ?? booleanOf(session, operation, solid, pieces, false);
  if (operation === "cut") requireCut(session, solid, pieces, result);
  return result;
}

/**
 * Throws if nothing was cut away: no face of a piece became one of the solid, and the volume is the same. The faces may still be
 * divided where a piece touches them.
 */
function requireCut(
  session: Session,
  before: NamedSolid,
  pieces: readonly NamedSolid[],
  after: NamedSolid,
): void {
  const ofPieces = new Set(pieces.flatMap(({ origins }) => origins));
  if (after.origins.some((origin) => ofPieces.has(origin))) return;
  const volume = session.volume(before.shape);
  if (volume - session.volume(after.shape) > NOTHING_CUT * volume) return;
  throw new FeatureError("The piece lies outside the solid, so nothing is cut.");
}

function booleanOf(
  session: Session,
  operation: keyof typeof MAKERS,
  solid: NamedSolid,
  pieces: readonly NamedSolid[],
  isSimplified: true,
): NamedSolid | undefined;
function booleanOf(
  session: Session,
  operation: keyof typeof MAKERS,
  solid: NamedSolid,
  pieces: readonly NamedSolid[],
  isSimplified: false,
): NamedSolid;
/** Returns undefined if the solid is not sound after neighbours of one surface became one face. */
function booleanOf(
  session: Session,
  operation: keyof typeof MAKERS,
  solid: NamedSolid,
  pieces: readonly NamedSolid[],
  isSimplified: boolean,
): NamedSolid | undefined {
  const maker = session.reused(operation, () => new session.kernel[MAKERS[operation]]());
  const solidsOf = ({ shape }: NamedSolid) => session.parts(shape, "solid");
  maker.SetArguments(session.list(solidsOf(solid)));
  maker.SetTools(session.list(pieces.flatMap(solidsOf)));
  maker.SetNonDestructive(true);
  maker.Build(session.progress());
  if (maker.HasErrors()) throw new FeatureError("OpenCascade cannot combine the solids.");
  if (isSimplified) maker.SimplifyResult(true, true, SAME_DIRECTION);
  const result = session.hold(maker.Shape());
  try {
    return named(session, soundShape(session, result), "", (give) =>
      giveOldNames(session, maker, [solid, ...pieces], give),
    );
  } catch (failure) {
    if (isSimplified && failure instanceof FeatureError) return undefined;
    throw failure;
  }
}

/** Returns several solids as one shape, as they are. */
function beside(session: Session, solids: readonly NamedSolid[]): NamedSolid {
  const parts: TopoDS_Shape[] = solids.flatMap(({ shape }) => session.parts(shape, "solid"));
  return named(session, session.together(parts), "", (give) => {
    for (const { faces, origins } of solids)
      faces.shapes.forEach((face, f) => give([face], origins[f] ?? ""));
  });
}

/** Returns a solid moved, turned or mirrored. */
export function transformed(session: Session, solid: NamedSolid, motion: gp_Trsf): NamedSolid {
  if (motion.IsNegative()) return mirrored(session, solid, motion);
  const location = session.hold(new session.kernel.TopLoc_Location(motion));
  const moved = (shape: TopoDS_Shape) => session.hold(shape.Moved(location, false));
  return named(session, moved(solid.shape), "", (give) => {
    solid.faces.shapes.forEach((face, f) => give([moved(face)], solid.origins[f] ?? ""));
  });
}

function mirrored(session: Session, solid: NamedSolid, motion: gp_Trsf): NamedSolid {
  const { BRepBuilderAPI_Transform } = session.kernel;
  const maker = session.hold(new BRepBuilderAPI_Transform(solid.shape, motion, false, false));
  const shape = soundShape(session, session.hold(maker.Shape()));
  return named(session, shape, "", (give) => giveOldNames(session, maker, [solid], give));
}
