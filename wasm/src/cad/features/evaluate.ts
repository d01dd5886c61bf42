/**
 * Evaluates a list of features by the kernel. Each feature changes the solid of those before it; one that fails is
 * reported and left out.
 */
import type { TopoDS_Shape } from "replicad-opencascadejs";

import { changed, type Pieces } from "./changes.js";
import { combined } from "./combining.js";
import type { Feature, FeatureOf, Piece, FeatureFailure } from "./feature.js";
import { faceNames, namedEdges, type NamedSolid, renamed } from "./named-solid.js";
import { pieceOf } from "./pieces.js";
import { FeatureError, type FeatureKernel, Session } from "./session.js";
import { lengthOf, minus } from "../../base/vectors.js";

/** An edge to be shown and chosen. */
export interface EdgeLine {
  readonly name: string;
  /** The names of the faces beside it: the same twice for a seam, where a closed face begins and ends. */
  readonly faces: readonly [string, string];
  /** x y z per position along the edge. */
  readonly points: Float64Array;
}

export interface Evaluation {
  /** The name of each face, in the order in which `partsOfBrep` lists them. Empty without a solid. */
  readonly faces: readonly string[];
  readonly edges: readonly EdgeLine[];
  readonly failures: readonly FeatureFailure[];
  /** Whether the kernel must not be used again; then there is no solid. */
  readonly isKernelSpent: boolean;
}

/** Evaluates features. The text of the BREP file is empty if there is no solid. */
export function evaluate(
  kernel: FeatureKernel,
  features: readonly Feature[],
): Evaluation & { readonly brep: string } {
  const write = (shape: TopoDS_Shape) => kernel.BRepToolsWrapper.Write(shape);
  const { result = "", ...evaluation } = withShape(kernel, features, write);
  return { ...evaluation, brep: result };
}

/**
 * The same, with a function that is called with the solid, which is freed afterwards: to triangulate it before it is
 * written, say. The function is not called if there is no solid; its exceptions are not caught.
 */
export function withShape<Result>(
  kernel: FeatureKernel,
  features: readonly Feature[],
  use: (shape: TopoDS_Shape) => Result,
): Evaluation & { readonly result: Result | undefined } {
  const session = new Session(kernel);
  const failures: FeatureFailure[] = [];
  let isSpent = false;
  try {
    const solid = solidOf(session, features, failures);
    if (solid === undefined)
      return { faces: [], edges: [], failures, isKernelSpent: false, result: undefined };
    return {
      faces: faceNames(session, solid),
      edges: edgesOf(session, solid),
      failures,
      isKernelSpent: false,
      result: use(solid.shape),
    };
  } catch (failure) {
    if (!(failure instanceof KernelSpent)) throw failure;
    isSpent = true;
    return { faces: [], edges: [], failures, isKernelSpent: true, result: undefined };
  } finally {
    if (!isSpent) session.free();
  }
}

/** Thrown after a failure of the kernel's program itself, which leaves its memory in disorder. */
class KernelSpent extends Error {}

function solidOf(
  session: Session,
  features: readonly Feature[],
  failures: FeatureFailure[],
): NamedSolid | undefined {
  const pieces: Pieces = new Map();
  const ids = new Set<number>();
  let solid: NamedSolid | undefined;
  for (const feature of features) {
    try {
      if (ids.has(feature.id))
        throw new FeatureError("Another feature has the same id.", "Give it another id.");
      ids.add(feature.id);
      if (feature.isOff !== true) solid = after(session, feature, solid, pieces);
    } catch (failure) {
      pieces.delete(feature.id);
      if (!(failure instanceof FeatureError)) session.forgetReused();
      failures.push(reportOf(session.kernel, feature, failure));
      if (failure instanceof KernelSpent || isCrash(failure)) throw new KernelSpent();
    }
  }
  return solid;
}

/** Returns the solid after a feature. */
function after(
  session: Session,
  feature: Feature,
  solid: NamedSolid | undefined,
  pieces: Pieces,
): NamedSolid {
  if (!isFinite(feature)) throw new FeatureError("A number is not finite.", "Change the number.");
  if (isPiece(feature)) {
    const piece = pieceOf(session, feature, (list) => toolOf(session, list));
    pieces.set(feature.id, { piece, operation: feature.operation });
    return combined(session, feature.operation, solid, [piece]);
  }
  if (solid === undefined)
    throw new FeatureError("There is no solid before it.", "Begin with a piece, such as a box.");
  return changed(session, feature, { solid, pieces });
}

const isPiece = (feature: Feature): feature is Piece => "operation" in feature;

/** Returns whether all numbers of a feature are finite. */
function isFinite(value: unknown): boolean {
  if (typeof value === "number") return Number.isFinite(value);
  return typeof value !== "object" || value === null || Object.values(value).every(isFinite);
}

/** Returns the solid of a list within a feature. Throws if one of its features fails. */
function toolOf(session: Session, { id, tool }: FeatureOf<"boolean">): NamedSolid {
  const failures: FeatureFailure[] = [];
  const solid = solidOf(session, tool, failures);
  const [failure] = failures;
  if (failure !== undefined)
    throw new FeatureError(`In feature ${failure.feature} of the tool: ${failure.message}`, failure.remedy);
  if (solid === undefined) throw new FeatureError("The tool has no solid.", "Add features to the tool.");
  return renamed(solid, (name) => `${id}/tool ${name}`);
}

const REMEDIES: Readonly<Record<Feature["type"], string>> = {
  box: "Change its size or its place.",
  cylinder: "Change its size or its place.",
  cone: "Change its size or its place.",
  sphere: "Change its size or its place.",
  torus: "Change its size or its place.",
  prism: "Change its size or its place.",
  wedge: "Change its size or its place.",
  extrude: "Check that the loops are closed and do not intersect.",
  revolve: "Check that the loops are closed, do not intersect and lie on one side of the axis.",
  loft: "Check that the loops are apart, in their order, and do not intersect themselves.",
  sweep: "Choose a smoother path that leaves the plane of the loop, or a smaller loop.",
  sew: "Check that the patches are closed: each line must have two of them.",
  import: "Export the part again; the file is damaged or contains no solid.",
  boolean: "Move the tool a little, or change its size.",
  hole: "Change its diameter, its depth or its place.",
  fillet: "Choose a smaller radius or fewer edges.",
  chamfer: "Choose a smaller distance or fewer edges.",
  shell: "Choose a smaller thickness or other faces.",
  move: "Change the motion.",
  mirror: "Move the plane.",
  "linear-array": "Change the step or the count.",
  "circular-array": "Change the angle or the count.",
};

function reportOf(kernel: FeatureKernel, { id, type }: Feature, failure: unknown): FeatureFailure {
  const own = failure instanceof FeatureError ? failure.remedy : undefined;
  const general = Object.hasOwn(REMEDIES, type) ? REMEDIES[type] : "Choose another kind of feature.";
  const message =
    failure instanceof FeatureError
      ? failure.message
      : `OpenCascade ended with an error in the feature (${causeOf(kernel, failure)}).`;
  return { feature: id, message, remedy: own ?? general };
}

function causeOf(kernel: FeatureKernel, failure: unknown): string {
  if (failure instanceof Error) return failure.message;
  try {
    const [type] = kernel.getExceptionMessage(failure);
    kernel.decrementExceptionRefcount(failure);
    return type;
  } catch {
    return "an exception";
  }
}

/** C++ exceptions leave the kernel as it was; these are failures of its program, as those without memory. */
const isCrash = (failure: unknown): boolean =>
  failure instanceof WebAssembly.RuntimeError || failure instanceof RangeError;

/** Largest angle between two pieces of an edge that is shown, in radians. */
const SHOWN_ANGLE = 0.1;
/** Largest distance of an edge from how it is shown, as a part of the solid's size. */
const SHOWN_DISTANCE = 1e-3;

function edgesOf(session: Session, solid: NamedSolid): EdgeLine[] {
  const [low, high] = session.bounds(solid.shape);
  const distance = SHOWN_DISTANCE * lengthOf(minus(high, low));
  return namedEdges(session, solid).map(({ edge, name, faces }) => ({
    name,
    faces,
    points: session.positionsOn(edge, SHOWN_ANGLE, distance),
  }));
}
