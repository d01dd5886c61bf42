/** Labels of what a step of a patch is about, in space: the same names as in the drawing of its plane. */
import type { EdgeStep, PlanarFront, StationStep, SurfaceTrace } from "tetrafront/trace";
import { mean } from "../../document/vectors";
import { filmStrings } from "../strings/film";
import { playerStrings } from "../strings/player";
import { isBeforeTest } from "./beats";
import type { Beat } from "../strings/film";
import type { LensLabel } from "./lens-marks";
import { cornersOfPlane } from "./plane-drawing";
import { candidateInBeat, examinedCandidate } from "./planar-lens";
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
  beat: Beat | null = null,
): readonly LensLabel[] {
  const step = surface.stepAt(state);
  if (step?.kind === "station") return beat === null ? [] : stationLabels(step, beat);
  const front = surface.fronts[surface.frontAt(state) ?? -1];
  if (!front || state >= front.lastStep) return [];
  return [...cornerLabels(front), ...(step?.kind === "edge" ? edgeLabels(front, step, candidate, beat) : [])];
}

/** The size at the station, then the averagings that the next side has needed, then the side. */
function stationLabels({ from, to, startSize, rounds, length }: StationStep, beat: Beat): LensLabel[] {
  const { size, averages, side } = filmStrings.station;
  const labels: LensLabel[] = [{ kind: "base", position: from, text: size(startSize) }];
  if (beat !== "station") labels.push({ kind: "ideal", position: mean([from, to]), text: averages(rounds) });
  if (beat === "side") labels.push({ kind: "candidate", position: to, text: side(length) });
  return labels;
}

const cornerLabels = (front: PlanarFront): LensLabel[] =>
  cornersOfPlane(front).map(({ name, node }) => ({
    kind: "candidate",
    position: inSpace(front, node),
    text: name,
  }));

/** A new node that was refused has no position in space. */
function edgeLabels(front: PlanarFront, step: EdgeStep, rank: number | null, beat: Beat | null): LensLabel[] {
  const tried = isBeforeTest(beat) ? null : examinedCandidate(step, candidateInBeat(step, rank, beat));
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
