import type { LoopCurve, Profile } from "tetrafront/internal";
import type { Project, ProjectLine } from "tetrafront/project";
import { operationStrings } from "../../strings";
import { circleThrough } from "../arcs";
import { findRecord, type Entity } from "../entities";
import { expressionFinder } from "../expression-edits";
import { orderLoops } from "../loops";
import { liesInPlane } from "../patch-rules";
import { isPlain, quantityPosition, valuesOf, type QuantityPosition } from "../quantity-positions";
import { distance } from "../vectors";
import type { Typed } from "./feature-numbers";

const { refusals } = operationStrings;

/** Closed plane loops of a selection as the profile of a feature, or why there is none. */
export type FoundProfile =
  | { readonly success: true; readonly profile: Typed<Profile> }
  | { readonly success: false; readonly reason: string };

type LineSteps = readonly number[];

/** Returns the profile within a selected planar patch, or within selected lines. */
export function drawnProfile(project: Project, selection: readonly Entity[]): FoundProfile {
  const loops = loopsOf(project, selection);
  if (!loops || loops.length === 0) return { success: false, reason: refusals.oneProfile };
  return profileWithin(project, loops);
}

/** Returns the profile within loops of lines, the outer one first. */
export function profileWithin(project: Project, loops: readonly LineSteps[]): FoundProfile {
  if (!liesInPlane(project, loops)) return { success: false, reason: refusals.notPlane };
  const curves = drawnCurves(project, loops);
  if (!curves) return { success: false, reason: refusals.curvesOfFeatures };
  const [outer = [], ...holes] = curves;
  return { success: true, profile: { outer, ...(holes.length > 0 && { holes }) } };
}

/** Returns chains of lines as curves of the kernel; null if there is a kind of line that it has not. */
export function drawnCurves(
  project: Project,
  chains: readonly LineSteps[],
): readonly (readonly Typed<LoopCurve>[])[] | null {
  const textOf = expressionFinder(project);
  const positionOf = (id: number): QuantityPosition =>
    quantityPosition(
      findRecord(project, "point", id)?.position ?? [0, 0, 0],
      [0, 1, 2].map((axis) => textOf({ kind: "point", id, field: `position.${axis}` })),
    );
  const curves = chains.map((chain) =>
    chain.map((step) => curveOf(findRecord(project, "line", Math.abs(step)), step < 0, positionOf)),
  );
  if (curves.flat().includes(null)) return null;
  return curves.map((chain) => chain.filter((curve) => curve !== null));
}

function loopsOf(project: Project, selection: readonly Entity[]) {
  const patches = selection.filter(({ kind }) => kind === "patch");
  const lines = selection.flatMap(({ kind, id }) => (kind === "line" ? [id] : []));
  const [patch] = patches;
  if (patches.length > 1 || (patch && lines.length > 0)) return undefined;
  if (patch) return findRecord(project, "patch", patch.id)?.loops;
  const found = orderLoops(project, lines);
  return found.success ? found.loops : undefined;
}

/** Returns a line as a curve of the kernel; null for a kind that it has not. */
function curveOf(
  line: ProjectLine | undefined,
  isReversed: boolean,
  positionOf: (point: number) => QuantityPosition,
): Typed<LoopCurve> | null {
  if (!line || line.startTangent || line.endTangent) return null;
  const points = (isReversed ? line.points.toReversed() : line.points).map(positionOf);
  const [a, b, c] = points;
  if (!a || !b) return null;
  if (line.type === "straight") return { kind: "line", points: [a, b] };
  if (!c) return null;
  if (line.type === "arc") return { kind: "arc", points: [a, b, c] };
  if (line.type === "spline") {
    const isClosed = line.points[0] === line.points.at(-1);
    return { kind: "spline", points: isClosed ? points.slice(1) : points, isClosed };
  }
  if (line.type !== "circle") return null;
  // A radius has no expression of its own: the points keep theirs.
  if (![a, b, c].every(isPlain)) return { kind: "three-point-circle", points: [a, b, c] };
  const circle = circleThrough(valuesOf(a), valuesOf(b), valuesOf(c));
  if (!circle) return null;
  const { centre, normal, start } = circle;
  return { kind: "circle", center: centre, axis: normal, radius: distance(start, centre) };
}
