import type { QualityReport } from "tetrafront";
import { bestValue, scalePosition, worstShown } from "../../document/mesh-quality";
import {
  countsOf,
  nearTarget,
  shapesOf,
  shareBetween,
  targetAngles,
  type CountedMeasure,
  type Range,
  type RegionChoice,
} from "../../document/quality-counts";
import { formatAngle, formatCount, formatShare } from "../../strings/format";
import { HistogramChart } from "../../ui/histogram-chart";
import { SectionTitle } from "../../ui/frames/section-title";
import { strings } from "../../strings";
import { ratioMeanings } from "../../strings/ratio-meanings";
import { Explained } from "../../ui/explained";
import { viridisAt } from "../../ui/theme/viridis";
import type { QualityStatistics } from "./use-quality-statistics";

const texts = strings.report;

interface ChartProps {
  readonly title: string;
  /** What the title means, if it needs that. */
  readonly meaning?: string;
  readonly quality: QualityReport;
  readonly choice: RegionChoice;
  readonly measure: CountedMeasure;
  readonly ticks: readonly number[];
  readonly colorOf: (value: number) => string;
  readonly valueText: (value: number) => string;
  /** What the bars count: "angles", "tetrahedra" … */
  readonly noun: string;
  /** Statistics below the bars. */
  readonly facts: Facts;
}

type Facts = readonly (readonly [name: string, value: string])[];

function Chart({
  title,
  meaning,
  quality,
  choice,
  measure,
  ticks,
  colorOf,
  valueText,
  noun,
  facts,
}: ChartProps) {
  const bars = countsOf(quality, choice, measure);
  return (
    <section aria-label={title}>
      <SectionTitle>
        {meaning === undefined ? title : <Explained name={title} meaning={meaning} />}
      </SectionTitle>
      <HistogramChart
        bars={bars}
        end={bars.length * quality.binWidths[measure]}
        ticks={ticks}
        label={strings.quality.histogram(title)}
        testId={`chart-${measure}`}
        colorOf={colorOf}
        describe={(count, from, to) => texts.bar(formatCount(count), noun, valueText(from), valueText(to))}
        facts={facts}
      />
    </section>
  );
}

export interface QualityChartProps {
  readonly statistics: QualityStatistics;
  readonly choice: RegionChoice;
}

/** Returns the colour of a bar: the accent if the value is in a range, else that of a warning. */
const colorWithin =
  ({ from, to }: Range) =>
  (value: number): string =>
    value >= from && value <= to ? "var(--tf-chart)" : "var(--tf-chart-off)";

/** Histogram of all dihedral angles. */
export function AngleChart({ statistics: { quality }, choice }: QualityChartProps) {
  const { min, max } = shapesOf(quality, choice).dihedral;
  return (
    <Chart
      title={texts.dihedral}
      quality={quality}
      choice={choice}
      measure="dihedral"
      ticks={[0, 30, 60, 90, 135, 180]}
      colorOf={colorWithin(targetAngles)}
      valueText={formatAngle}
      noun={texts.angles}
      facts={[
        [strings.quality.min, formatAngle(min)],
        [texts.max, formatAngle(max)],
      ]}
    />
  );
}

/** Histogram of the radius ratios of the elements. */
export function RatioChart({ statistics: { quality }, choice }: QualityChartProps) {
  const { min, mean } = shapesOf(quality, choice).radiusRatio;
  const valueText = (value: number): string => value.toFixed(2);
  return (
    <Chart
      title={texts.radiusRatio}
      meaning={ratioMeanings.tetrahedron}
      quality={quality}
      choice={choice}
      measure="radiusRatio"
      ticks={[0, 0.25, 0.5, 0.75, bestValue["radius-ratio"]]}
      colorOf={(value) =>
        viridisAt(scalePosition(Math.max(value, worstShown["radius-ratio"]), "radius-ratio"))
      }
      valueText={valueText}
      noun={texts.tetrahedra}
      facts={[
        [strings.quality.min, min.toFixed(3)],
        [strings.quality.mean, mean.toFixed(3)],
      ]}
    />
  );
}

/** Histogram of edge lengths, divided by the target length or by the mean. */
export function EdgeChart({ statistics: { quality, edgeReference }, choice }: QualityChartProps) {
  const share = shareBetween(countsOf(quality, choice, "edge"), quality.binWidths.edge, nearTarget);
  const { mean, nearTarget: shareOfAll } = quality.edges;
  return (
    <Chart
      title={texts.edges[edgeReference]}
      quality={quality}
      choice={choice}
      measure="edge"
      ticks={[0, nearTarget.from, 1, nearTarget.to, 2, 3]}
      colorOf={colorWithin(nearTarget)}
      valueText={(value) => value.toFixed(1)}
      noun={texts.edgeNoun}
      facts={[
        [texts.nearTarget(nearTarget.from, nearTarget.to), formatShare(choice === null ? shareOfAll : share)],
        // Divided by the mean, the mean is 1.
        ...(choice === null && edgeReference === "target"
          ? [[strings.quality.mean, mean.toFixed(2)] as const]
          : []),
      ]}
    />
  );
}
