import type { MeshReport } from "tetrafront";

/** Texts about runs and meshes. */

export const phaseNames = {
  check: "Checking the model",
  bodies: "Preparing bodies",
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

const counted = (count: number, one: string, many: string): string =>
  count === 1 ? `1 ${one}` : `${count.toLocaleString("en-US")} ${many}`;

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
      `Relaxed: ${counted(relaxed, "element was", "elements were")} accepted by a more lenient rule.`,
    ],
    [starred, `Starred: ${counted(starred, "pocket was", "pockets were")} joined to one interior point.`],
    [
      remeshed,
      `Remeshed: ${counted(remeshed, "pocket was", "pockets were")} filled after the surrounding elements were removed.`,
    ],
    [filled, `Filled: ${counted(filled, "pocket was", "pockets were")} closed by the exact fill.`],
    [
      steinerPoints,
      `Steiner points: the exact fill added ${counted(steinerPoints, "interior point", "interior points")}.`,
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
  cancelled: (size: string, seconds: string) => `Cancelled after ${seconds}; ${size} so far`,
  stalled: (size: string, seconds: string) =>
    `Stalled after ${seconds}; ${size}, the remaining front is shown`,
  invalid: "Not meshed: the model has errors",
} as const;
