import { useMemo } from "react";
import { searchCost, type SearchCost } from "../../lessons/search-cost";
import { lessonStrings as texts } from "../../strings/lessons";
import { usePlayer } from "../player/use-player";
import styles from "./lessons.module.css";

/** Units of the drawing, which is scaled to the width of the panel. */
const width = 260;
const height = 130;
/** Room for the axes. */
const [left, right, top, bottom] = [54, 14, 6, 32];

/** How many faces a linear search and a search in space look at, for the front that is shown. */
export function SearchChart() {
  const trace = usePlayer((state) => state.trace);
  const cost = useMemo(() => trace && searchCost(trace), [trace]);
  if (!cost) return null;
  const lastOf = (values: readonly number[]): number => values.at(-1) ?? 0;
  const [elements, linear, near] = [lastOf(cost.elements), lastOf(cost.linear), lastOf(cost.near)];
  const text = texts.costText(elements, linear, near);
  return (
    <figure className={styles["figure"]} data-linear={linear} data-near={near}>
      <svg
        viewBox={`${-left} ${-top} ${left + width + right} ${top + height + bottom}`}
        role="img"
        aria-label={text}
      >
        <path className={styles["axis"]} d={`M0 0V${height}H${width}`} />
        {[0, 0.5, 1].map((share) => (
          <g key={share} className={styles["ticks"]}>
            <path className={styles["axis"]} d={`M-3 ${height * (1 - share)}h3`} />
            <text x={-6} y={height * (1 - share)} data-end>
              {texts.axisNumber(share * linear)}
            </text>
            <path className={styles["axis"]} d={`M${width * share} ${height}v3`} />
            <text x={width * share} y={height + 11}>
              {texts.axisNumber(Math.round(share * elements))}
            </text>
          </g>
        ))}
        <g className={styles["ticks"]}>
          <text x={width / 2} y={height + 26}>
            {texts.costAxes.across}
          </text>
          <text transform={`translate(${6 - left} ${height / 2}) rotate(-90)`}>{texts.costAxes.up}</text>
        </g>
        <path className={styles["linear"]} d={curveOf(cost, cost.linear)} />
        <path className={styles["near"]} d={curveOf(cost, cost.near)} />
      </svg>
      <ul className={styles["key"]}>
        <li data-curve="linear">{texts.costLinear}</li>
        <li data-curve="near">{texts.costNear}</li>
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
