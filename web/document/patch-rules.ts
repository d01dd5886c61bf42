import type { LineType, PatchType, Project } from "tetrafront";
import { entityNouns, patchMisfits } from "../strings";
import { entityName, findRecord } from "./entities";

/** Requirements on the outer loop of a patch type (Löhner & Parikh 1988, equations 11–15). */
export interface PatchRule {
  /** Number of lines in the outer loop; null: any. */
  readonly lines: number | null;
  /** The only type of line accepted; null: any. */
  readonly lineType: LineType | null;
  readonly holes: boolean;
}

export const patchRules: { readonly [P in PatchType]: PatchRule } = {
  planar: { lines: null, lineType: null, holes: true },
  "isoparametric-triangle": { lines: 3, lineType: "parabolic", holes: true },
  serendipity: { lines: 4, lineType: "parabolic", holes: true },
  "barnhill-gregory-nielson": { lines: 3, lineType: null, holes: true },
  coons: { lines: 4, lineType: null, holes: true },
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
  if (loops.length > 1 && !rule.holes) return patchMisfits.holes;
  const wrong = outer
    .map((step) => findRecord(project, "line", Math.abs(step)))
    .find((line) => rule.lineType !== null && line !== undefined && line.type !== rule.lineType);
  if (!wrong) return null;
  const entity = { kind: "line", id: wrong.id } as const;
  return patchMisfits.lineType(entityName(project, entity) ?? `${entityNouns.line} ${wrong.id}`);
}

type Vector = readonly [number, number, number];

const subtract = (a: Vector, b: Vector): Vector => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const cross = (a: Vector, b: Vector): Vector => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
const dot = (a: Vector, b: Vector): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

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
  const fitting = (["isoparametric-triangle", "barnhill-gregory-nielson", "coons"] as const).find(
    (type) => patchMisfit(project, type, loops) === null,
  );
  return fitting ?? "planar";
}
