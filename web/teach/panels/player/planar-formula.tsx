import type { EdgeStep, PlanarFront } from "tetrafront/trace";
import type { PlanarLensCandidate } from "../../player/planar-lens";
import { metricLength, planeOf, targetLength } from "../../player/planar-judge";
import { playerStrings } from "../../strings/player";
import { Formula } from "./formula";
import { digits } from "./latex";
import styles from "./player.module.css";

const texts = playerStrings.patch;

const metricRule = String.raw`\|\mathbf{d}\|_G=\sqrt{\mathbf{d}\cdot G\,\mathbf{d}}`;
const lengthRule = String.raw`\delta=\min(\max(1,\,0.55\,b),\,2b)`;

interface PlanarFormulaProps {
  readonly front: PlanarFront;
  readonly step: EdgeStep;
  readonly examined: PlanarLensCandidate;
}

/** The test in the plane that decides on a candidate, with its numbers. */
export function PlanarFormula({ front, step, examined }: PlanarFormulaProps) {
  const { verdict } = examined.candidate;
  if (verdict === "same-node" || verdict === "outside") return null;
  return (
    <section aria-label={texts.test} data-testid="lens-formula">
      <h2 className={styles["title"]}>{texts.test}</h2>
      {(verdict === "accepted" || verdict === "too-close") && <Lengths front={front} step={step} />}
      <Formula parts={testOf(front, step, examined)} />
      <p className={styles["hint"]}>{texts.testHints[verdict]}</p>
    </section>
  );
}

/** The length of the base edge, and the target length of the others. */
function Lengths({ front, step }: { readonly front: PlanarFront; readonly step: EdgeStep }) {
  const [a, b] = step.nodes.map((node) => planeOf(front, node));
  const base = a && b ? metricLength(step.metric, [b[0] - a[0], b[1] - a[1]]) : 0;
  return (
    <>
      <Formula parts={[metricRule]} />
      <Formula parts={[lengthRule]} />
      <Formula parts={[`b=${digits(base)},`, String.raw`\delta=${digits(targetLength(front, step))}`]} />
    </>
  );
}

function testOf(
  front: PlanarFront,
  { nodes, metric }: EdgeStep,
  examined: PlanarLensCandidate,
): readonly string[] {
  const { candidate, doubleArea, inside, distance, leastDistance } = examined;
  switch (candidate.verdict) {
    case "behind":
      return [
        String.raw`(\mathbf{b}-\mathbf{a})\times(\mathbf{p}-\mathbf{a})`,
        String.raw`\quad=${digits(doubleArea)}\le 0`,
      ];
    case "crosses": {
      const [from, to] = inside ?? [0, 0];
      return [
        String.raw`\mathbf{a}+t\,(\mathbf{b}-\mathbf{a}),`,
        String.raw`${digits(from)}\le t\le ${digits(to)}`,
      ];
    }
    case "too-close":
      return [
        String.raw`\mathrm{dist}_G=${digits(distance ?? 0)}`,
        String.raw`\quad<0.55\,\delta=${digits(leastDistance)}`,
      ];
    default: {
      const arms = nodes.map((node) => {
        const [x, y] = planeOf(front, node);
        return metricLength(metric, [candidate.plane[0] - x, candidate.plane[1] - y]);
      });
      return [
        String.raw`\|\mathbf{p}-\mathbf{a}\|_G=${digits(arms[0] ?? 0)},`,
        String.raw`\|\mathbf{p}-\mathbf{b}\|_G=${digits(arms[1] ?? 0)}`,
      ];
    }
  }
}
