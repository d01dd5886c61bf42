import type { SolvedMesh } from "../../session/solutions";
import { formatCount } from "../../strings/format";
import { solutionStrings as texts } from "../../strings/solution";
import { useApp } from "../shared/app-context";
import styles from "./solution.module.css";

/** Size of the drawing, and of its margins for the numbers, in its own units. */
const box = { width: 260, height: 132, left: 40, right: 14, top: 10, bottom: 22 } as const;

interface Point {
  readonly index: number;
  readonly elements: number;
  readonly error: number;
}

/** Returns the decades and their parts that a range covers: the ticks of a logarithmic axis. */
function ticksOf(low: number, high: number): readonly number[] {
  const ticks: number[] = [];
  for (let power = Math.floor(Math.log10(low)); power <= Math.ceil(Math.log10(high)); ++power)
    for (const digit of [1, 2, 5]) ticks.push(Number(`${digit}e${power}`));
  const inside = ticks.filter((tick) => tick >= low && tick <= high);
  const decades = inside.filter((tick) => Number.isInteger(Math.log10(tick)));
  return decades.length >= 2 ? decades : inside.slice(0, 4);
}

/** Returns the position on a logarithmic axis. A range without length is widened. */
function axis(values: readonly number[], from: number, to: number) {
  const low = Math.min(...values) / 1.25;
  const high = Math.max(...values) * 1.25;
  const scale = (to - from) / Math.log(high / low);
  return { at: (value: number): number => from + scale * Math.log(value / low), ticks: ticksOf(low, high) };
}

export interface ErrorChartProps {
  readonly meshes: readonly SolvedMesh[];
  readonly at: number | null;
}

/** The estimated error of each mesh over its number of elements. A click shows a mesh. */
export function ErrorChart({ meshes, at }: ErrorChartProps) {
  const { solutions } = useApp();
  const points = meshes.flatMap(({ mesh, estimatedError }, index): Point[] =>
    estimatedError === null || estimatedError <= 0
      ? []
      : [{ index, elements: mesh.report.tetrahedra, error: estimatedError }],
  );
  if (points.length < 2) return null;
  const x = axis(points.map(({ elements }) => elements), box.left, box.width - box.right); // prettier-ignore
  const y = axis(points.map(({ error }) => error), box.height - box.bottom, box.top); // prettier-ignore
  const bottom = box.height - box.bottom;
  const place = ({ elements, error }: Point): string =>
    `${x.at(elements).toFixed(1)},${y.at(error).toFixed(1)}`;
  return (
    <svg
      className={styles["chart"]}
      viewBox={`0 0 ${box.width} ${box.height}`}
      role="group"
      aria-label={texts.chart}
      data-testid="error-chart"
    >
      {x.ticks.map((tick) => (
        <g key={tick} aria-hidden>
          <line x1={x.at(tick)} x2={x.at(tick)} y1={box.top} y2={bottom} />
          <text x={x.at(tick)} y={box.height - 8} textAnchor="middle">
            {formatCount(tick)}
          </text>
        </g>
      ))}
      {y.ticks.map((tick) => (
        <g key={tick} aria-hidden>
          <line x1={box.left} x2={box.width - box.right} y1={y.at(tick)} y2={y.at(tick)} />
          <text x={box.left - 4} y={y.at(tick) + 3} textAnchor="end">
            {texts.error3(tick)}
          </text>
        </g>
      ))}
      <polyline points={points.map(place).join(" ")} />
      {points.map((point) => {
        const text = texts.chartPoint(
          texts.cycle(point.index),
          formatCount(point.elements),
          texts.error3(point.error),
        );
        const [cx, cy] = place(point).split(",");
        return (
          <circle
            key={point.index}
            cx={cx}
            cy={cy}
            r={point.index === at ? 5 : 3.5}
            data-shown={point.index === at || undefined}
            role="img"
            aria-label={text}
            onClick={() => solutions.show(point.index)}
          >
            <title>{text}</title>
          </circle>
        );
      })}
    </svg>
  );
}
