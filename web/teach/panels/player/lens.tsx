import { Text } from "@mantine/core";
import { lazy, memo, Suspense, useDeferredValue, useMemo } from "react";
import type { AdvanceStep } from "tetrafront/trace";
import { isBeforeTest, playsBeats } from "../../player/beats";
import { beatAt, elementsShown, isUnfinished } from "../../player/film-state";
import { decisive, examine, type LensCandidate } from "../../player/lens";
import { examinedIn, lensSceneOf, type LensScene } from "../../player/lens-scene";
import { surfaceState } from "../../player/phases";
import { recordedScores } from "../../player/recorded-score";
import { recoveryCounts } from "../../player/recovery-counts";
import { filmStrings } from "../../strings/film";
import { playerStrings } from "../../strings/player";
import { formatShort } from "../../../strings/format";
import { ScrollPanel } from "../../../ui/frames/scroll-panel";
import { BaseFacts, type Fact } from "./base-facts";
import { CandidatesAndFormulas, type CandidateRow } from "./candidate-table";
import { frontChangeOf, sentenceOf, whatIfOf } from "./lens-sentence";
import styles from "./player.module.css";
import { SurfaceLens } from "./surface-lens";
import { usePlayer, useTrace } from "./use-player";

const texts = playerStrings;
const Sweeps = lazy(async () => ({ default: (await import("./sweeps")).Sweeps }));
const IdealFormula = lazy(async () => ({ default: (await import("./step-formula")).IdealFormula }));
const RefusalFormula = lazy(async () => ({ default: (await import("./step-formula")).RefusalFormula }));
const CrossingFormula = lazy(async () => ({ default: (await import("./crossing-formula")).CrossingFormula }));

/** Why a step ended as it did. */
export function Lens() {
  const isPlaying = usePlayer((state) => state.isPlaying && !playsBeats(state));
  const sweeps = usePlayer(({ trace, lensStep }) =>
    trace && lensStep === trace.stepCount ? trace.optimization : null,
  );
  return (
    <ScrollPanel label={texts.lens} className={styles["lens"]} data-testid="lens">
      {sweeps && (
        <Suspense fallback={null}>
          <Sweeps optimization={sweeps} />
        </Suspense>
      )}
      {isPlaying ? <Text size="sm">{texts.playing}</Text> : <Step />}
    </ScrollPanel>
  );
}

function Step() {
  const trace = useTrace();
  const state = usePlayer(({ lensStep }) => surfaceState(trace, lensStep));
  if (trace.surface === null || state === null) return <VolumeLens />;
  return <SurfaceLens surface={trace.surface} state={state} />;
}

/** What the lens shows of the volume. */
interface UnderLens {
  readonly number: number;
  readonly chosen: number | null;
  readonly scene: LensScene | null;
}

/** The view answers a step first; the sentences and formulas about it follow. */
function VolumeLens() {
  const number = usePlayer((state) => state.lensStep);
  const chosen = usePlayer((state) => state.candidate);
  const scene = usePlayer(lensSceneOf);
  const shown = useDeferredValue(useMemo(() => ({ number, chosen, scene }), [number, chosen, scene]));
  return <StepUnderLens {...shown} />;
}

const StepUnderLens = memo(function StepUnderLens({ number, chosen, scene }: UnderLens) {
  const trace = useTrace();
  const beat = usePlayer(beatAt);
  const hasEnded = usePlayer((state) => !isUnfinished(state));
  const step = useMemo(() => trace.stepAt(number), [trace, number]);
  const examined = useMemo(() => {
    if (step?.kind !== "advance") return null;
    // The view shows the same, unless it waits for the last of scrubbed states.
    if (scene?.step.step === step.step) return scene.examined;
    const candidate = step.candidates[chosen ?? decisive(step) ?? 0];
    return candidate ? examine(trace, step, candidate) : null;
  }, [trace, step, chosen, scene]);
  const change = scene && scene.step.step === step?.step ? frontChangeOf(scene) : null;
  if (!step) return <Text size="sm">{texts.beforeFirst}</Text>;
  if (step.kind === "recovery")
    return <p>{texts.recovery(step.change, recoveryCounts(trace, step), beat)}</p>;
  const isEarly = scene !== null && isBeforeTest(scene.beat);
  return (
    <>
      {examined && (
        <p data-testid="lens-sentence">
          <b>{earlySentence(step, scene) ?? sentenceOf(step, examined)}</b>
        </p>
      )}
      <CandidatesAndFormulas
        label={texts.candidates}
        rows={rowsOf(step, isEarly)}
        chosen={chosen ?? (isEarly ? null : examinedIn(step, scene?.beat ?? null))}
        scoreHint={texts.scoreHint}
        further={
          <Suspense fallback={null}>
            <IdealFormula step={step} />
          </Suspense>
        }
      >
        {examined && !isEarly && (
          <Suspense fallback={null}>
            <RefusalFormula step={step} candidate={examined.candidate} />
          </Suspense>
        )}
        {examined?.test && !isEarly && (
          <Suspense fallback={null}>
            <CrossingFormula {...examined.test} />
          </Suspense>
        )}
      </CandidatesAndFormulas>
      {number === trace.stepCount && hasEnded && <End />}
      {examined && !isEarly && <WhatIf examined={examined} />}
      {change !== null && !isEarly && <p data-testid="lens-front-change">{change}</p>}
      {step.outcome === "postponed" && !isEarly && <p>{texts.postponed(step.nextRuleClass)}</p>}
      <FaceFacts step={step} />
    </>
  );
});

/** Returns what a beat before the test is about; null for later ones. */
function earlySentence({ candidates }: AdvanceStep, scene: LensScene | null): string | null {
  if (!scene || !isBeforeTest(scene.beat)) return null;
  const { base, ideal, candidates: tried } = filmStrings.sentences;
  return scene.beat === "base" ? base : scene.beat === "ideal" ? ideal : tried(candidates.length);
}

/** `isEarly`: the verdicts are not known yet. */
function rowsOf({ candidates }: AdvanceStep, isEarly: boolean): readonly CandidateRow[] {
  const scores = recordedScores(candidates);
  return candidates.map(({ node, isNew, verdict, culprit }, i) => ({
    name: isNew ? null : node,
    score: scores[i] ?? "",
    verdict: isEarly ? filmStrings.untested : texts.verdictAt(texts.verdicts[verdict], culprit),
  }));
}

/** Says after the last step that the volume is full, if the front was completed. */
function End() {
  const trace = useTrace();
  const elements = usePlayer(elementsShown);
  const hint =
    elements === "cut" || elements === "all"
      ? filmStrings.pullApart
      : elements === "none"
        ? ""
        : texts.recentElements;
  if ((trace.steps.frontSizes[trace.stepCount] ?? 0) > 0) return null;
  const count = trace.elementsAt(trace.stepCount).length;
  return (
    <p data-testid="lens-end">
      {texts.noFaces(count)} {hint}
    </p>
  );
}

function WhatIf({ examined }: { readonly examined: LensCandidate }) {
  const whatIf = whatIfOf(examined);
  return whatIf !== null && <p data-testid="lens-what-if">{whatIf}</p>;
}

function FaceFacts({ step }: { readonly step: AdvanceStep }) {
  const { header } = useTrace();
  const facts: readonly Fact[] = [
    { ...texts.bucket, value: String(step.bucket) },
    { ...texts.layers, value: String(step.layers) },
    { ...texts.ruleClass, value: step.ruleClass === 0 ? texts.strict : String(step.ruleClass) },
    { ...texts.targetEdge, value: formatShort(step.targetEdge) },
    { ...texts.nearby, value: String(step.nearbyFaces) },
    { ...texts.ranked, value: String(step.rankedCandidates) },
  ];
  const hint = step.isRemeshing ? texts.region : texts.whyNow[header.order];
  return <BaseFacts title={texts.base(step.face)} facts={facts} hint={hint} />;
}
