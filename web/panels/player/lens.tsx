import { Text } from "@mantine/core";
import { lazy, Suspense, useMemo } from "react";
import type { AdvanceStep } from "tetrafront";
import { decisive, examine, type LensCandidate } from "../../player/lens";
import { strings } from "../../strings";
import { formatShort } from "../../ui/format";
import { ScrollPanel } from "../../ui/frames/scroll-panel";
import tables from "../../ui/table.module.css";
import { useApp } from "../shared/app-context";
import { sentenceOf, whatIfOf } from "./lens-sentence";
import styles from "./player.module.css";
import { usePlayer, useTrace } from "./use-player";

const texts = strings.player;
const CrossingFormula = lazy(async () => ({ default: (await import("./crossing-formula")).CrossingFormula }));

/** Why a step ended as it did. */
export function Lens() {
  const isPlaying = usePlayer((state) => state.isPlaying);
  return (
    <ScrollPanel label={texts.lens} className={styles["lens"]} data-testid="lens">
      {isPlaying ? <Text size="sm">{texts.playing}</Text> : <StepUnderLens />}
    </ScrollPanel>
  );
}

function StepUnderLens() {
  const trace = useTrace();
  const number = usePlayer((state) => state.step);
  const chosen = usePlayer((state) => state.candidate);
  const step = useMemo(() => trace.stepAt(number), [trace, number]);
  const examined = useMemo(() => {
    if (step?.kind !== "advance") return null;
    const candidate = step.candidates[chosen ?? decisive(step) ?? 0];
    return candidate ? examine(trace, step, candidate) : null;
  }, [trace, step, chosen]);
  if (!step) return <Text size="sm">{texts.beforeFirst}</Text>;
  if (step.kind === "recovery") return <Text size="sm">{texts.changes[step.change]}</Text>;
  return (
    <>
      {examined && <Sentence step={step} examined={examined} />}
      {step.outcome === "postponed" && <p>{texts.postponed(step.nextRuleClass)}</p>}
      <Candidates step={step} />
      {examined?.pair && (
        <Suspense fallback={null}>
          <CrossingFormula pair={examined.pair} />
        </Suspense>
      )}
      <BaseFacts step={step} />
    </>
  );
}

function Sentence({ step, examined }: { readonly step: AdvanceStep; readonly examined: LensCandidate }) {
  const whatIf = whatIfOf(examined);
  return (
    <>
      <p data-testid="lens-sentence">
        <b>{sentenceOf(step, examined)}</b>
      </p>
      {whatIf !== null && <p data-testid="lens-what-if">{whatIf}</p>}
    </>
  );
}

/** The candidates in the order in which they were tried; a click examines one. */
function Candidates({ step }: { readonly step: AdvanceStep }) {
  const { player } = useApp();
  const chosen = usePlayer((state) => state.candidate) ?? decisive(step);
  if (step.candidates.length === 0) return null;
  return (
    <table className={`${tables["table"]} ${tables["compact"]}`} aria-label={texts.candidates}>
      <thead>
        <tr>
          <th scope="col">{texts.candidate}</th>
          <th scope="col">{texts.score}</th>
          <th scope="col">{texts.verdict}</th>
        </tr>
      </thead>
      <tbody>
        {step.candidates.map(({ node, isNew, score, verdict, culprit }, i) => (
          // Candidates have no identity beside their rank.
          <tr key={i} data-highlighted={i === chosen || undefined}>
            <th scope="row">
              <button
                type="button"
                className={styles["candidate"]}
                data-testid={`lens-candidate-${i}`}
                aria-pressed={i === chosen}
                onClick={() => player.state.setState({ candidate: i })}
              >
                {texts.candidateName(i + 1, isNew ? null : node)}
              </button>
            </th>
            <td>{score.toFixed(3)}</td>
            <td>{texts.verdictAt(texts.verdicts[verdict], culprit)}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

function BaseFacts({ step }: { readonly step: AdvanceStep }) {
  const facts: readonly (readonly [string, string])[] = [
    [texts.bucket, String(step.bucket)],
    [texts.layers, String(step.layers)],
    [texts.ruleClass, step.ruleClass === 0 ? texts.strict : String(step.ruleClass)],
    [texts.targetEdge, formatShort(step.targetEdge)],
    [texts.nearby, String(step.nearbyFaces)],
    [texts.ranked, String(step.rankedCandidates)],
  ];
  return (
    <section aria-label={texts.base(step.face)}>
      <h2 className={styles["title"]}>{texts.base(step.face)}</h2>
      <dl className={styles["facts"]}>
        {facts.map(([name, value]) => (
          <div key={name}>
            <dt>{name}</dt>
            <dd>{value}</dd>
          </div>
        ))}
      </dl>
      <p className={styles["hint"]}>{step.isRemeshing ? texts.region : texts.whyNow}</p>
    </section>
  );
}
