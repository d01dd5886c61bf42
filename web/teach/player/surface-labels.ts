/** Labels of what a step of a patch is about, in space: the same names as in the drawing of its plane. */
import type { EdgeStep, PlanarFront, SurfaceTrace } from "tetrafront/trace";
import { mean } from "../../document/vectors";
import { playerStrings } from "../strings/player";
import type { LensLabel } from "./lens-marks";
import { cornersOfPlane } from "./plane-drawing";
import { examinedCandidate } from "./planar-lens";
import { endsOf } from "./planar-judge";
import { inSpace } from "./surface-scene";

const texts = playerStrings.marks;

/**
 * Returns the labels of a state, from 0: the corners of the patch whose front advances, and the base edge of the step with a
 * candidate. `candidate`: as for `examinedCandidate`.
 */
export function surfaceLabels(
  surface: SurfaceTrace,
  state: number,
  candidate: number | null,
): readonly LensLabel[] {
  const front = surface.fronts[surface.frontAt(state) ?? -1];
  if (!front || state >= front.lastStep) return [];
  const step = surface.stepAt(state);
  return [...cornerLabels(front), ...(step?.kind === "edge" ? edgeLabels(front, step, candidate) : [])];
}

const cornerLabels = (front: PlanarFront): LensLabel[] =>
  cornersOfPlane(front).map(({ name, node }) => ({
    kind: "candidate",
    position: inSpace(front, node),
    text: name,
  }));

/** A new node that was refused has no position in space. */
function edgeLabels(front: PlanarFront, step: EdgeStep, rank: number | null): LensLabel[] {
  const tried = examinedCandidate(step, rank);
  const middle = (edge: number) => mean(endsOf(front, edge).map((node) => inSpace(front, node)));
  const labels: LensLabel[] = [{ kind: "base", position: middle(step.edge), text: texts.base(step.edge) }];
  if (!tried) return labels;
  const { node, isNew, culprit } = tried;
  if (node !== null)
    labels.push({
      kind: "candidate",
      position: inSpace(front, node),
      text: texts.node(isNew ? null : node),
    });
  if (culprit !== null)
    labels.push({ kind: "failing", position: middle(culprit), text: texts.edge(culprit) });
  return labels;
}
