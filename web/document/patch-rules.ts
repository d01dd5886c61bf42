import type { LineType, PatchType, Project } from "tetrafront/project";
import { entityNouns, patchMisfits } from "../strings";
import { entityName, findRecord } from "./entities";
import { cross, dot, subtract } from "./vectors";

/** Requirements on the outer loop of a patch type (Löhner & Parikh 1988, equations 11–15). */
export interface PatchRule {
  /** Number of lines in the outer loop; null: any. */
  readonly lines: number | null;
  /** The only type of line accepted; null: any. */
  readonly lineType: LineType | null;
  /** Number of loops; null: an outer loop and any number of holes. */
  readonly loops: number | null;
}

export const patchRules: { readonly [P in PatchType]: PatchRule } = {
  planar: { lines: null, lineType: null, loops: null },
  "isoparametric-triangle": { lines: 3, lineType: "parabolic", loops: null },
  serendipity: { lines: 4, lineType: "parabolic", loops: null },
  "barnhill-gregory-nielson": { lines: 3, lineType: null, loops: null },
  coons: { lines: 4, lineType: null, loops: null },
  gregory: { lines: 4, lineType: null, loops: null },
  nielson: { lines: 3, lineType: null, loops: null },
  loft: { lines: 4, lineType: null, loops: null },
  tube: { lines: null, lineType: null, loops: 2 },
};

/** In the order in which the app offers them. */
export const patchTypes = Object.keys(patchRules) as PatchType[];

/** Returns why loops cannot bound a patch of a type, in one sentence; null if they can. */
export function patchMisfit(
  project: Project,
  type: PatchType,
  loops: readonly (readonly number[])[],
): string | null {
  const rule = patchRules[type];
  const outer = loops[0] ?? [];
  if (rule.lines !== null && outer.length !== rule.lines) {
    return patchMisfits.lineCount(rule.lines, outer.length);
  }
  if (rule.loops !== null && loops.length !== rule.loops) {
    return patchMisfits.loopCount(rule.loops, loops.length);
  }
  const wrong = outer
    .map((step) => findRecord(project, "line", Math.abs(step)))
    .find((line) => rule.lineType !== null && line !== undefined && line.type !== rule.lineType);
  if (!wrong) return null;
  const entity = { kind: "line", id: wrong.id } as const;
  return patchMisfits.lineType(entityName(project, entity) ?? `${entityNouns.line} ${wrong.id}`);
}

/** Points are planar if their distance from a plane, relative to their extent, is at most this. */
const planarity = 1e-9;

/**
 * Returns whether all points of the loops' lines lie in one plane. This only proposes a type; the engine
 * checks it.
 */
export function liesInPlane(project: Project, loops: readonly (readonly number[])[]): boolean {
  const ids = new Set(
    loops.flat().flatMap((step) => findRecord(project, "line", Math.abs(step))?.points ?? []),
  );
  const positions = project.points.filter(({ id }) => ids.has(id)).map(({ position }) => position);
  const [origin] = positions;
  if (!origin) return false;
  const arms = positions.map((position) => subtract(position, origin));
  const longest = arms.reduce((best, arm) => (dot(arm, arm) > dot(best, best) ? arm : best));
  const normal = arms
    .map((arm) => cross(longest, arm))
    .reduce((best, next) => (dot(next, next) > dot(best, best) ? next : best));
  const reach = Math.sqrt(dot(longest, longest) * dot(normal, normal));
  return arms.every((arm) => Math.abs(dot(arm, normal)) <= planarity * reach);
}

/** Returns the most likely patch type for these loops. */
export function likelyPatchType(project: Project, loops: readonly (readonly number[])[]): PatchType {
  if (liesInPlane(project, loops)) return "planar";
  // Two loops that are not in one plane may be a curved patch with a hole only if the hole lies on it: rarely.
  const fitting = (["tube", "isoparametric-triangle", "barnhill-gregory-nielson", "coons"] as const).find(
    (type) => patchMisfit(project, type, loops) === null,
  );
  return fitting ?? "planar";
}
