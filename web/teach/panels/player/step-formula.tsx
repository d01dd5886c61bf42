import { useMemo } from "react";
import type { AdvanceStep, TracedCandidate } from "tetrafront/trace";
import { newElement, sixVolumes } from "../../player/judge";
import { distanceToFace, idealNumbers } from "../../player/unit-space";
import { playerStrings } from "../../strings/player";
import { Formula, FormulaMeaning } from "./formula";
import { digits } from "./latex";
import styles from "./player.module.css";
import { useTrace } from "./use-player";

const { ideal: idealTexts, refusal: refusalTexts } = playerStrings;

/** How the ideal point of a step is placed (step F5.1), with its numbers. */
export function IdealFormula({ step }: { readonly step: AdvanceStep }) {
  const trace = useTrace();
  const { target, base, size, radius, height } = useMemo(() => idealNumbers(trace, step), [trace, step]);
  return (
    <section aria-label={idealTexts.title} data-testid="lens-ideal">
      <h2 className={styles["title"]}>{idealTexts.title}</h2>
      <Formula
        parts={[
          String.raw`h=\min(\max(0.97\,\delta,\,0.55\,b),\,2\,b)`,
          String.raw`\quad=${digits(size)},`,
          String.raw`\delta=${digits(target)},\quad b=${digits(base)}`,
        ]}
      />
      <Formula
        parts={[
          String.raw`\max\!\left(\sqrt{h^2-R^2},\ 0.3\,h\right)=${digits(height)}`,
          String.raw`R=${digits(radius)}`,
        ]}
      />
      <FormulaMeaning>{step.tensor ? idealTexts.stretchedHint : idealTexts.hint}</FormulaMeaning>
    </section>
  );
}

interface RefusalFormulaProps {
  readonly step: AdvanceStep;
  readonly candidate: TracedCandidate;
}

/** The test that a candidate behind the base face, or a new node too close to a face, has failed, with its numbers. */
export function RefusalFormula({ step, candidate }: RefusalFormulaProps) {
  const { verdict, culprit } = candidate;
  if (verdict === "behind") return <Behind step={step} candidate={candidate} />;
  return verdict === "too-close" && culprit !== null ? (
    <TooClose step={step} candidate={candidate} face={culprit} />
  ) : null;
}

function TooClose({ step, candidate, face }: RefusalFormulaProps & { readonly face: number }) {
  const trace = useTrace();
  const { distance, least } = useMemo(
    () => distanceToFace(trace, step, candidate.position, face),
    [trace, step, candidate, face],
  );
  const { size } = useMemo(() => idealNumbers(trace, step), [trace, step]);
  return (
    <section aria-label={refusalTexts.tooClose} data-testid="lens-refusal">
      <h2 className={styles["title"]}>{refusalTexts.tooClose}</h2>
      <Formula
        parts={[
          String.raw`\mathrm{dist}=${digits(distance)}\,h=${digits(distance * size)}`,
          String.raw`\quad${distance < least ? "<" : String.raw`\ge`}${digits(least)}\,h=${digits(least * size)}`,
        ]}
      />
      <p className={styles["hint"]}>{refusalTexts.tooCloseHint}</p>
    </section>
  );
}

function Behind({ step, candidate }: RefusalFormulaProps) {
  const trace = useTrace();
  const { corners } = newElement(trace, step.face, candidate.position, candidate.node);
  return (
    <section aria-label={refusalTexts.behind} data-testid="lens-refusal">
      <h2 className={styles["title"]}>{refusalTexts.behind}</h2>
      <Formula
        parts={[
          String.raw`6\,V=((\mathbf{b}-\mathbf{a})\times(\mathbf{c}-\mathbf{a}))\cdot(\mathbf{p}-\mathbf{a})`,
          String.raw`\quad=${digits(sixVolumes(corners))}`,
        ]}
      />
      <p className={styles["hint"]}>{refusalTexts.behindHint}</p>
    </section>
  );
}
