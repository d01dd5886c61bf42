import { useMemo } from "react";
import { searchCost, type SearchCost } from "../../lessons/search-cost";
import { lessonStrings as texts } from "../../strings/lessons";
import { usePlayer } from "../player/use-player";
import styles from "./lessons.module.css";

/** Units of the drawing, which is scaled to the width of the panel. */
const width = 260;
const height = 130;

/** How many faces a linear search and a search in space look at, for the front that is shown. */
export function SearchChart() {
  const trace = usePlayer((state) => state.trace);
  const cost = useMemo(() => trace && searchCost(trace), [trace]);
  if (!cost) return null;
  const [elements, linear, near] = [cost.elements, cost.linear, cost.near].map((all) => all.at(-1) ?? 0);
  const text = texts.costText(elements ?? 0, linear ?? 0, near ?? 0);
  return (
    <figure className={styles["figure"]} data-testid="search-chart" data-linear={linear} data-near={near}>
      <svg viewBox={`0 0 ${width} ${height}`} role="img" aria-label={text}>
        <path className={styles["axis"]} d={`M0.5 0V${height - 0.5}H${width}`} />
        <path className={styles["linear"]} d={curveOf(cost, cost.linear)} />
        <path className={styles["near"]} d={curveOf(cost, cost.near)} />
      </svg>
      <ul className={styles["key"]}>
        <li data-curve="linear">{texts.costLinear}</li>
        <li data-curve="near">{texts.costNear}</li>
        <li>{texts.costAxis(elements ?? 0)}</li>
      </ul>
      <figcaption>{text}</figcaption>
    </figure>
  );
}

/** Returns a curve over the elements, both axes linear and from 0. */
function curveOf({ elements, linear }: SearchCost, counts: readonly number[]): string {
  const [last, highest] = [Math.max(1, elements.at(-1) ?? 1), Math.max(1, linear.at(-1) ?? 1)];
  return counts
    .map((count, i) => {
      const x = (width * (elements[i] ?? 0)) / last;
      return `${i === 0 ? "M" : "L"}${x.toFixed(1)} ${(height * (1 - count / highest)).toFixed(1)}`;
    })
    .join("");
}
