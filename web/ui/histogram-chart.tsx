import { formatCount, formatShort } from "./format";

export interface HistogramChartProps {
  /** Null while nobody knows them. */
  readonly bars: readonly number[] | null;
  /** The value at which the last bar ends; the first begins at 0. */
  readonly end: number;
  /** Values written below the bars, ascending, the first 0 and the last `end`. */
  readonly marks: readonly number[];
  readonly label: string;
  /** Colour of a bar, from the value in its middle. */
  readonly colorOf: (value: number) => string;
  readonly describe: (count: number, from: number, to: number) => string;
  readonly testId: string;
}

const height = 84;
/** A bar with anything in it is at least this high. */
const leastHeight = 1.5;

/** Bars in the colours of the view. Each carries its numbers for the mouse and for screen readers. */
export function HistogramChart({ bars, end, marks, label, colorOf, describe, testId }: HistogramChartProps) {
  const known = bars ?? [];
  const highest = Math.max(1, ...known);
  return (
    <div className="tf-histogram" data-testid={testId}>
      <span className="tf-histogram-top" aria-hidden>
        {bars && formatCount(highest)}
      </span>
      <div
        className="tf-histogram-bars"
        role="list"
        aria-label={label}
        aria-busy={bars === null}
        style={{ height }}
      >
        {known.map((count, index) => {
          const from = (index / known.length) * end;
          const to = ((index + 1) / known.length) * end;
          const text = describe(count, from, to);
          return (
            <div key={from} role="listitem" aria-label={text} title={text} data-testid={`bar-${index}`}>
              <div
                style={{
                  height: count === 0 ? 0 : Math.max(leastHeight, (count / highest) * height),
                  background: colorOf((from + to) / 2),
                }}
              />
            </div>
          );
        })}
      </div>
      <div className="tf-histogram-axis" aria-hidden>
        {marks.map((mark) => (
          <span key={mark} style={{ left: `${(100 * mark) / end}%` }}>
            {formatShort(Number(mark.toPrecision(3)))}
          </span>
        ))}
      </div>
    </div>
  );
}
