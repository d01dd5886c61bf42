import { formatCount, formatCounted } from "./format";
import type { MeshReport } from "tetrafront";

/** Texts about runs and meshes. */

export const phaseNames = {
  check: "Checking the model",
  bodies: "Preparing bodies",
  remesh: "Remeshing the surface",
  sides: "Dividing lines",
  surface: "Meshing patches",
  volume: "Advancing the front",
  optimize: "Optimizing the elements",
  verify: "Verifying",
} as const;

export const measureNames = {
  "radius-ratio": "Radius ratio",
  dihedral: "Smallest dihedral angle",
} as const;

/** Returns the name of a measure. If the mesh is stretched, adds where it is measured. */
export function measuredIn(measure: string, space: "metric" | "space" | null): string {
  return space === null ? measure : `${measure} ${spaceNames[space]}`;
}

export const spaceNames = { metric: "in the metric", space: "in space" } as const;

/** Returns a code such as "loop-not-closed" as a heading. */
export function problemTitle(code: string): string {
  const words = code.replaceAll("-", " ");
  return words.charAt(0).toUpperCase() + words.slice(1);
}

/** Returns a sentence for each kind of recovery that the run needed. */
export function recoverySteps({
  relaxed,
  starred,
  remeshed,
  filled,
  steinerPoints,
}: MeshReport["recovery"]): readonly string[] {
  const steps: readonly (readonly [count: number, step: string])[] = [
    [
      relaxed,
      `Relaxed: ${formatCounted(relaxed, "element was", "elements were")} accepted by a more lenient rule.`,
    ],
    [
      starred,
      `Starred: ${formatCounted(starred, "pocket was", "pockets were")} joined to one interior point.`,
    ],
    [
      remeshed,
      `Remeshed: ${formatCounted(remeshed, "pocket was", "pockets were")} filled after the surrounding elements were removed.`,
    ],
    [filled, `Filled: ${formatCounted(filled, "pocket was", "pockets were")} closed by the exact fill.`],
    [
      steinerPoints,
      `Steiner points: the exact fill added ${formatCounted(steinerPoints, "interior point")}.`,
    ],
  ];
  return steps.flatMap(([count, step]) => (count > 0 ? [step] : []));
}

/** Lines of the log. */
export const logStrings = {
  meshing: (name: string) => `Meshing “${name}”`,
  boundaryTriangles: (count: string) => `${count} boundary triangles`,
  size: (tetrahedra: string, nodes: string) => `${tetrahedra} tetrahedra, ${nodes} nodes`,
  done: (size: string, seconds: string, fingerprint: string) =>
    `Done: ${size} in ${seconds}; fingerprint ${fingerprint}`,
  cancelled: (size: string, seconds: string, about: string | null) =>
    `Cancelled after ${seconds}; ${size} so far${about === null ? "" : `, of about ${about} tetrahedra`}`,
  cancelledAt: (made: string, about: string | null) =>
    `Cancelled at ${made}${about === null ? "" : ` of about ${about}`} tetrahedra`,
  cancelledBefore: "Cancelled before anything was meshed",
  stalled: (size: string, seconds: string) =>
    `Stalled after ${seconds}; ${size}, the remaining front is shown`,
  invalid: "Not meshed: the model has errors",
  opened: (file: string, size: string) => `Opened ${file}: ${size}`,
  improving: (tetrahedra: string) => `Improving ${tetrahedra} tetrahedra`,
  improved: (improvement: Gain) => improvementText(improvement),
  adapted: (size: string) => `Adapted: ${size}`,
  adaptationDiscarded: "The model has changed meanwhile, so the adapted mesh was discarded",
  improvementDiscarded: "The model has changed meanwhile, so the improvement was discarded",
} as const;

/** Shapes of the elements before and after an improvement. */
interface Gain {
  readonly isImproved: boolean;
  readonly isPartial: boolean;
  readonly before: Shapes;
  readonly after: Shapes;
}

interface Shapes {
  readonly tetrahedra: number;
  readonly dihedral: { readonly min: number; readonly max: number };
  readonly radiusRatio: { readonly min: number; readonly mean: number };
  readonly outOfRange: number;
}

/** Returns how an improvement has ended. */
export function improvementOutcome(improvement: Gain): string {
  const { isImproved, isPartial } = improvement;
  const much = gainsOf(improvement).length > 0 ? "" : " slightly";
  if (isImproved) return isPartial ? `Stopped; improved${much} so far` : `Improved${much}`;
  return isPartial
    ? "Stopped before a better mesh was found. The mesh is unchanged."
    : "No better mesh was found. The mesh is unchanged.";
}

/** Returns what an improvement has gained, and how many elements there are now. */
export function improvementText(improvement: Gain): string {
  const outcome = improvementOutcome(improvement);
  if (!improvement.isImproved) return outcome;
  const gains = gainsOf(improvement);
  const { before, after } = improvement;
  const [was, is] = [before, after].map(({ tetrahedra }) => formatCount(tetrahedra));
  const counts = was === is ? `${is} tetrahedra as before` : `${was} → ${is} tetrahedra`;
  return `${outcome}: ${[...gains, counts].join(", ")}.`;
}

/** Returns the figures that have changed, as far as they are shown. */
function gainsOf({ before, after }: Gain): readonly string[] {
  const changed = (what: string, text: (shapes: Shapes) => string): string[] =>
    text(before) === text(after) ? [] : [`${what} ${text(before)} → ${text(after)}`];
  return [
    ...changed("smallest dihedral angle", ({ dihedral }) => `${dihedral.min.toFixed(1)}°`),
    ...changed("largest", ({ dihedral }) => `${dihedral.max.toFixed(1)}°`),
    ...changed("least radius ratio", ({ radiusRatio }) => radiusRatio.min.toFixed(3)),
    ...changed("mean radius ratio", ({ radiusRatio }) => radiusRatio.mean.toFixed(3)),
    ...changed("outside 30°–135°", ({ outOfRange }) => formatCount(outOfRange)),
  ];
}
