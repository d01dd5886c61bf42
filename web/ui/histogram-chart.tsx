import { formatCount, formatShort } from "../strings/format";
import styles from "./histogram-chart.module.css";

export interface HistogramChartProps {
  /** Count per bar; null while the counts are being computed. */
  readonly bars: readonly number[] | null;
  /** Upper end of the last bar; the first bar begins at 0. */
  readonly end: number;
  /** Values written below the bars, ascending from 0 to `end`. */
  readonly ticks: readonly number[];
  readonly label: string;
  /** Returns the colour of a bar, given the value at its middle. */
  readonly colorOf: (value: number) => string;
  /** Returns the text of a bar for tooltips and screen readers. */
  readonly describe: (count: number, from: number, to: number) => string;
  readonly testId: string;
  /** Statistics below the bars. */
  readonly facts: readonly (readonly [name: string, value: string])[];
}

/** Height of the highest bar, in pixels. */
const height = 84;
/** Least height of a bar that is not empty, in pixels. */
const minHeight = 1.5;

/** A bar chart of counts with statistics below it. */
export function HistogramChart(props: HistogramChartProps) {
  const { bars, end, ticks, label, colorOf, describe, testId, facts } = props;
  const counts = bars ?? [];
  const highest = Math.max(1, ...counts);
  return (
    <>
      <div className={styles["chart"]} data-testid={testId}>
        <span className={styles["highest"]} aria-hidden>
          {bars && formatCount(highest)}
        </span>
        <div
          className={styles["bars"]}
          role="list"
          aria-label={label}
          aria-busy={bars === null}
          style={{ height }}
        >
          {counts.map((count, index) => {
            const from = (index / counts.length) * end;
            const to = ((index + 1) / counts.length) * end;
            const text = describe(count, from, to);
            return (
              <div key={from} role="listitem" aria-label={text} title={text} data-testid={`bar-${index}`}>
                <div
                  style={{
                    height: count === 0 ? 0 : Math.max(minHeight, (count / highest) * height),
                    background: colorOf((from + to) / 2),
                  }}
                />
              </div>
            );
          })}
        </div>
        <div className={styles["ticks"]} aria-hidden>
          {ticks.map((tick) => (
            <span key={tick} style={{ left: `${(100 * tick) / end}%` }}>
              {formatShort(Number(tick.toPrecision(3)))}
            </span>
          ))}
        </div>
      </div>
      <p className={styles["foot"]} data-testid={`${testId}-facts`}>
        {facts.map(([name, value]) => (
          <span key={name}>
            {name} <b>{value}</b>
          </span>
        ))}
      </p>
    </>
  );
}
