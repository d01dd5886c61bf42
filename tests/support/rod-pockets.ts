/** The pockets at which the front stalls in the rod of needles, and how the engine closes them; lesson 10 shows them. */
import { readFileSync } from "node:fs";
import { readProject } from "tetrafront/project";
import type { RecoveryStep, Trace } from "tetrafront/trace";
import { recordFront } from "./recorded-models.js";

export interface RecordedPocket {
  readonly step: number;
  readonly change: string;
  /** Nodes of the pocket, then the new ones. */
  readonly positions: readonly (readonly number[])[];
  readonly faces: readonly (readonly number[])[];
  readonly elements: readonly (readonly number[])[];
}

/** Records the front in the rod of needles. */
export async function recordRod(): Promise<Trace> {
  const file = new URL("./needles.json", import.meta.url);
  const project = readProject(readFileSync(file, "utf8"));
  if (!project.success) throw new Error(project.errors[0].message);
  return recordFront(project.value);
}

/** Returns each pocket that was closed for good: by a star or by the exact fill. */
export function closedPockets(trace: Trace): readonly RecordedPocket[] {
  const steps = Array.from({ length: trace.stepCount + 1 }, (_none, step) => trace.stepAt(step));
  return steps.flatMap((step) =>
    step?.kind === "recovery" && ["star", "exact-fill"].includes(step.change) ? [pocketOf(trace, step)] : [],
  );
}

function pocketOf(
  trace: Trace,
  { step, change, removedFaces, addedNodes, addedElements }: RecoveryStep,
): RecordedPocket {
  const nodesOf = (all: Uint32Array, size: number, index: number): number[] => [
    ...all.subarray(size * index, size * index + size),
  ];
  const faces = [...removedFaces].map((face) => nodesOf(trace.faces.nodes, 3, face));
  const elements = [...addedElements].map((element) => nodesOf(trace.elements.nodes, 4, element));
  const own = [...new Set(faces.flat())].sort((a, b) => a - b);
  const nodes = [...own, ...addedNodes];
  const numbered = (each: readonly number[]): number[] => each.map((node) => nodes.indexOf(node));
  return {
    step,
    change,
    positions: nodes.map((node) => positionOf(trace, node)),
    faces: faces.map(numbered),
    elements: elements.map(numbered),
  };
}

const positionOf = ({ nodes }: Trace, node: number): number[] => [
  ...nodes.positions.subarray(3 * node, 3 * node + 3),
];
