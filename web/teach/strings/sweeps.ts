/** Texts about the sweeps of the optimizer after a recorded front. */
import { formatCount, formatCounted } from "../../strings/format";
import type { SweepKind } from "tetrafront/trace";

const kinds: Readonly<Record<SweepKind, string>> = {
  swap: "Edges removed",
  move: "Nodes moved",
  newton: "Nodes moved by Newton steps",
  split: "Long edges split",
  collapse: "Nodes removed",
  improve: "Poor elements improved",
  "last-resort": "Last tries on poor elements",
};

export const sweepStrings = {
  title: "Optimization",
  intro:
    "The front is closed. Now the optimizer improves the elements, sweep after sweep; the boundary stays.",
  hint: (poor: number | null) =>
    poor === null
      ? "Choose a row: the view shows the elements that have an angle below 30° then."
      : poor === 0
        ? "No element has an angle below 30°."
        : `${formatCounted(poor, "element has", "elements have")} an angle below 30°: the view shows them, the worst darkest.`,
  tooLarge: "Of meshes with more than 100,000 elements, only numbers are recorded.",
  sweep: "Sweep",
  changes: "Changes",
  elements: "Elements",
  angle: "Angle",
  angleHint: "Smallest dihedral angle",
  ratio: "Ratio",
  ratioHint: "Mean radius ratio: 1 if all elements are regular",
  front: "Front",
  kinds,
  name: (index: number, kind: string) => `${formatCount(index)}: ${kind}`,
  show: (index: number, kind: string) =>
    index === 0 ? "Show the mesh of the front" : `Show the mesh after sweep ${formatCount(index)}: ${kind}`,
  moved: (count: number) => formatCounted(count, "node"),
  made: (count: number) => formatCounted(count, "element"),
  unchanged: "none",
  degrees: (angle: number) => `${angle.toFixed(1)}°`,
  chart: (sweeps: number, before: number, after: number, from: number, to: number) =>
    `Over ${formatCounted(sweeps, "sweep")}, the smallest dihedral angle changes from ${before.toFixed(1)}° to ${after.toFixed(1)}°, and the mean radius ratio from ${from.toFixed(3)} to ${to.toFixed(3)}.`,
  chartAngle: "smallest angle",
  chartRatio: "mean radius ratio",
  restored: (result: number) =>
    `The mesh after sweep ${formatCount(result)} is the result: the later ones have found none that is better in every measure.`,
} as const;
