import { Text } from "@mantine/core";
import { lazy, Suspense, useMemo } from "react";
import type { EdgeStep, PlanarFront, StationStep, SurfaceStep, SurfaceTrace } from "tetrafront/trace";
import { isBeforeTest } from "../../player/beats";
import { beatAt } from "../../player/film-state";
import { labelAt, type EntityLabels } from "../../player/entity-labels";
import {
  candidateInBeat,
  examineCandidate,
  supposedCandidate,
  type PlanarLensCandidate,
} from "../../player/planar-lens";
import { filmStrings, type Beat } from "../../strings/film";
import { playerStrings } from "../../strings/player";
import { formatShort } from "../../../strings/format";
import { BaseFacts, type Fact } from "./base-facts";
import { CandidatesAndFormulas } from "./candidate-table";
import { planarSentenceOf } from "./lens-sentence";
import { usePlayer } from "./use-player";

const texts = playerStrings;
const PlanarFormula = lazy(async () => ({ default: (await import("./planar-formula")).PlanarFormula }));

/** Why a step of a line or a patch ended as it did. `state`: from 0. */
export function SurfaceLens({ surface, state }: { readonly surface: SurfaceTrace; readonly state: number }) {
  const step = useMemo(() => surface.stepAt(state), [surface, state]);
  const labels = usePlayer((shown) => shown.labels);
  if (!step) return <Text size="sm">{texts.beforeLines}</Text>;
  if (step.kind === "edge") {
    const front = surface.fronts[step.front];
    return front ? <EdgeUnderLens front={front} step={step} /> : null;
  }
  return (
    <>
      <p data-testid="lens-sentence">
        <b>{sentenceOf(surface, step, labels)}</b>
      </p>
      {step.kind === "station" && <p>{texts.line.measured(step.sides)}</p>}
      {state === surface.lastLineStep && <p>{texts.beforePatches}</p>}
    </>
  );
}

function sentenceOf(
  surface: SurfaceTrace,
  step: Exclude<SurfaceStep, EdgeStep>,
  labels: EntityLabels | null,
): string {
  const line = (index: number): string => labelAt(labels?.lines, index);
  const patch = (index: number): string => labelAt(labels?.patches, index);
  switch (step.kind) {
    case "station":
      return stationSentence(step, line(step.line));
    case "divided":
      return step.sideCount === 0
        ? texts.line.undivided(line(step.line))
        : texts.line.divided(line(step.line), step.length, step.sideCount);
    case "halved":
      return texts.line.halved(line(step.line), step.side);
    case "patch": {
      const front = surface.fronts[step.front];
      return texts.patch.begins(patch(step.patch), surface.frontSizeAt(step.step), front?.isCurved ?? false);
    }
    case "improved":
      return texts.patch.improved(patch(step.patch), step.trianglesBefore, step.triangles);
  }
}

function stationSentence({ end, startSize, length, rounds }: StationStep, line: string): string {
  const name = texts.line.title(line);
  const sentence =
    end === "settled"
      ? texts.line.settled(startSize, length, rounds)
      : end === "capped"
        ? texts.line.capped(startSize)
        : texts.line.knot;
  return `${name}. ${sentence}`;
}

function EdgeUnderLens({ front, step }: { readonly front: PlanarFront; readonly step: EdgeStep }) {
  const rank = usePlayer((state) => state.candidate);
  const beat = usePlayer(beatAt);
  const isEarly = isBeforeTest(beat);
  const chosen = candidateInBeat(step, rank, beat);
  const examined = useMemo(() => {
    const candidate = chosen === null ? undefined : step.candidates[chosen];
    return candidate ? examineCandidate(front, step, candidate) : null;
  }, [front, step, chosen]);
  const supposed = supposedCandidate(step, rank);
  const facts: readonly Fact[] = [
    { ...texts.patch.size, value: formatShort(step.size) },
    { ...texts.patch.metric, value: step.metric.map((term) => Number(term.toPrecision(3))).join(" ") },
    { ...texts.patch.sizeClass, value: String(step.sizeClass) },
    { ...texts.patch.layer, value: String(step.layer) },
    { ...texts.patch.pass, value: String(step.pass) },
    { ...texts.patch.nearby, value: String(step.nearbyEdges) },
    { ...texts.patch.ranked, value: String(step.rankedCandidates) },
  ];
  const rows = step.candidates.map((candidate) => ({
    name: candidate.isNew ? null : candidate.node,
    score: candidate.score.toFixed(3),
    verdict: isEarly
      ? filmStrings.untested
      : texts.verdictAt(texts.patch.verdicts[candidate.verdict], candidate.culprit),
  }));
  return (
    <>
      {examined && (
        <p data-testid="lens-sentence">
          <b>{earlySentence(step, beat) ?? planarSentenceOf(examined.candidate)}</b>
        </p>
      )}
      <CandidatesAndFormulas
        label={texts.patch.candidates}
        rows={rows}
        chosen={isEarly ? rank : chosen}
        scoreHint={texts.patch.scoreHint}
      >
        {examined && !isEarly && (
          <Suspense fallback={null}>
            <PlanarFormula front={front} step={step} examined={examined} />
          </Suspense>
        )}
      </CandidatesAndFormulas>
      {examined && !isEarly && <WhatIf examined={examined} />}
      {supposed && <p data-testid="lens-front-change">{texts.patch.supposed(supposed.isNew)}</p>}
      {step.outcome === "postponed" && !isEarly && <p>{texts.patch.postponed(step.nextPass)}</p>}
      <BaseFacts title={texts.patch.base(step.edge)} facts={facts} hint={texts.patch.whyNow} />
    </>
  );
}

/** Returns what a beat before the test is about; null for later ones. */
function earlySentence({ candidates }: EdgeStep, beat: Beat | null): string | null {
  if (!isBeforeTest(beat)) return null;
  const { edge, ideal } = filmStrings.planarSentences;
  return beat === "edge"
    ? edge
    : beat === "ideal"
      ? ideal
      : filmStrings.sentences.candidates(candidates.length);
}

function WhatIf({ examined }: { readonly examined: PlanarLensCandidate }) {
  const whatIf = whatIfInPlane(examined);
  return whatIf !== null && <p data-testid="lens-what-if">{whatIf}</p>;
}

/** As `whatIfOf` of the volume. Seams and the box of the patch are not part of our own check. */
function whatIfInPlane({ candidate: { verdict }, isBehind, crossed }: PlanarLensCandidate): string | null {
  const { whatIf, disagreement } = texts.patch;
  if (verdict === "same-node" || verdict === "outside") return null;
  if (verdict === "behind") return isBehind ? null : disagreement.inFront;
  if (isBehind) return disagreement.behind;
  if (crossed.length > 0) return verdict === "accepted" ? disagreement.crosses(crossed) : whatIf(crossed);
  return verdict === "crosses" ? disagreement.clear : null;
}
