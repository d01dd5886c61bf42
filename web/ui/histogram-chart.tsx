import { formatShort } from "./format";

export interface HistogramChartProps {
  readonly bars: readonly number[];
  /** The measure's best value, where the last bar ends; the first begins at 0. */
  readonly best: number;
  readonly label: string;
  /** Colour of a bar, from the value in its middle. */
  readonly colorOf: (value: number) => string;
  readonly describe: (count: number, from: number, to: number) => string;
}

const height = 84;
/** A bar with anything in it is at least this high. */
const leastHeight = 1.5;
const axisMarks = [0, 0.25, 0.5, 0.75, 1];

/** Bars in the colours of the view. Each carries its numbers for the mouse and for screen readers. */
export function HistogramChart({ bars, best, label, colorOf, describe }: HistogramChartProps) {
  const highest = Math.max(1, ...bars);
  return (
    <div className="tf-histogram" data-testid="quality-histogram">
      <div className="tf-histogram-bars" role="list" aria-label={label} style={{ height }}>
        {bars.map((count, index) => {
          const from = (index / bars.length) * best;
          const to = ((index + 1) / bars.length) * best;
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
        {axisMarks.map((mark) => (
          <span key={mark}>{formatShort(Number((mark * best).toPrecision(2)))}</span>
        ))}
      </div>
    </div>
  );
}
