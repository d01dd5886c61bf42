import type { LoopCurve, Profile } from "tetrafront/internal";
import type { Project, ProjectLine } from "tetrafront/project";
import { operationStrings } from "../../strings";
import { circleThrough } from "../arcs";
import { findRecord, type Entity } from "../entities";
import { expressionFinder } from "../expression-edits";
import { orderLoops } from "../loops";
import { liesInPlane } from "../patch-rules";
import { quantityPosition, valuesOf, type QuantityPosition } from "../quantity-positions";
import { distance } from "../vectors";
import type { Typed } from "./feature-numbers";

const { refusals } = operationStrings;

/** Closed plane loops of a selection as the profile of a feature, or why there is none. */
export type FoundProfile =
  | { readonly success: true; readonly profile: Typed<Profile> }
  | { readonly success: false; readonly reason: string };

/** Returns the profile within a selected planar patch, or within selected lines. */
export function drawnProfile(project: Project, selection: readonly Entity[]): FoundProfile {
  const loops = loopsOf(project, selection);
  const [outer, ...holes] = loops ?? [];
  if (!outer || !loops) return { success: false, reason: refusals.oneProfile };
  if (!liesInPlane(project, loops)) return { success: false, reason: refusals.notPlane };
  const textOf = expressionFinder(project);
  const positionOf = (id: number): QuantityPosition =>
    quantityPosition(
      findRecord(project, "point", id)?.position ?? [0, 0, 0],
      [0, 1, 2].map((axis) => textOf({ kind: "point", id, field: `position.${axis}` })),
    );
  const curves = [outer, ...holes].map((loop) =>
    loop.map((step) => curveOf(findRecord(project, "line", Math.abs(step)), step < 0, positionOf)),
  );
  if (curves.flat().includes(null)) return { success: false, reason: refusals.curvesOfFeatures };
  const [first = [], ...others] = curves.map((loop) => loop.filter((curve) => curve !== null));
  return { success: true, profile: { outer: first, ...(others.length > 0 && { holes: others }) } };
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
  const circle = circleThrough(valuesOf(a), valuesOf(b), valuesOf(c));
  if (!circle) return null;
  const { centre, normal, start } = circle;
  return { kind: "circle", center: centre, axis: normal, radius: distance(start, centre) };
}
