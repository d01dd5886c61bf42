import { Select, Text, UnstyledButton } from "@mantine/core";
import { IconAlertTriangle, IconCircleCheck, IconClockExclamation } from "@tabler/icons-react";
import { useMemo, useState } from "react";
import type { ElementQuality, MeshReport, QualityReport as Quality } from "tetrafront";
import { showElement } from "../commands/selection-actions";
import { bestValue, placeOnScale, worstShown } from "../document/mesh-quality";
import {
  countsOf,
  nearWanted,
  shareBetween,
  wantedAngles,
  type CountedMeasure,
  type RegionChoice,
} from "../document/quality-counts";
import { SectionTitle } from "../ui/field-row";
import { formatAngle, formatCount, formatPlace, formatShare, formatShort } from "../ui/format";
import { HistogramChart } from "../ui/histogram-chart";
import { recoverySteps, strings } from "../ui/strings";
import { viridisAt } from "../ui/viridis";
import { useApp, useProject, useRun, useStale, useView } from "./app-context";
import { RegionSwatch } from "./region-list";

const texts = strings.report;

/** Everything the report of the mesh on show says about its elements. */
export function QualityReport() {
  const report = useRun((state) => state.mesh?.report);
  const stale = useStale();
  const measured = report !== undefined && report.quality.regions.length > 0;
  return (
    <div
      className="tf-scroll tf-pad tf-report"
      data-testid="quality-report"
      data-stale={stale || undefined}
      tabIndex={0}
      role="region"
      aria-label={texts.title}
    >
      {report && <Verdict report={report} stale={stale} />}
      {measured ? (
        <Figures report={report} />
      ) : (
        <Text size="sm" c="dimmed">
          {report ? texts.notFinished : strings.quality.none}
        </Text>
      )}
    </div>
  );
}

/** What the exact verifier has found, which runs at the end of every run. */
function Verdict({ report, stale }: { readonly report: MeshReport; readonly stale: boolean }) {
  const failed = report.diagnostics.find(({ code }) => code === "verification-failed");
  const verdict = failed ? "failed" : report.status === "done" ? "passed" : "none";
  const Icon = { passed: IconCircleCheck, failed: IconAlertTriangle, none: IconClockExclamation }[verdict];
  return (
    <div className="tf-verdict" data-verdict={verdict} data-testid="verdict">
      <Icon size={18} aria-hidden />
      <div>
        <b>{texts.verdicts[verdict]}</b>
        <p>{failed ? failed.message : texts.verdictHints[verdict]}</p>
        {stale && <p>{strings.viewport.staleHint}</p>}
      </div>
    </div>
  );
}

function Figures({ report }: { readonly report: MeshReport }) {
  const { quality } = report;
  const [wanted, setWanted] = useState<RegionChoice>(null);
  const choice = quality.regions.some(({ region }) => region === wanted) ? wanted : null;
  const stretched = useStretched();
  return (
    <>
      {stretched && (
        <Text size="xs" c="dimmed" mt={8} data-testid="stretched-hint">
          {texts.stretchedHint}
        </Text>
      )}
      {quality.regions.length > 1 && <RegionSelect quality={quality} choice={choice} onChoose={setWanted} />}
      <AngleChart report={report} choice={choice} />
      <RatioChart report={report} choice={choice} />
      <EdgeChart quality={quality} choice={choice} />
      <KeyFigures quality={quality} />
      <SectionTitle>{texts.worst(quality.worst.length)}</SectionTitle>
      <ElementTable elements={quality.worst} testId="worst" />
      <Limited quality={quality} />
      <Recovery recovery={report.recovery} />
    </>
  );
}

/** Whether the background grid wants elements longer one way than another. */
function useStretched(): boolean {
  const { nodes } = useProject().background;
  return useMemo(() => nodes.some(({ stretching }) => (stretching ?? 1) > 1), [nodes]);
}

interface RegionSelectProps {
  readonly quality: Quality;
  readonly choice: RegionChoice;
  readonly onChoose: (region: RegionChoice) => void;
}

function RegionSelect({ quality, choice, onChoose }: RegionSelectProps) {
  const all = quality.regions.reduce((sum, { tetrahedra }) => sum + tetrahedra, 0);
  return (
    <Select
      size="xs"
      mt={10}
      aria-label={texts.region}
      data-testid="quality-region"
      allowDeselect={false}
      data={[
        { value: "all", label: texts.allRegions(formatCount(all)) },
        ...quality.regions.map(({ region, tetrahedra }) => ({
          value: String(region),
          label: texts.oneRegion(region + 1, formatCount(tetrahedra)),
        })),
      ]}
      value={choice === null ? "all" : String(choice)}
      leftSection={choice !== null && <RegionSwatch region={choice} />}
      renderOption={({ option: { value, label } }) => (
        <span className="tf-region-option">
          {value !== "all" && <RegionSwatch region={Number(value)} />}
          {label}
        </span>
      )}
      onChange={(value) => onChoose(value === null || value === "all" ? null : Number(value))}
    />
  );
}

interface ChartProps {
  readonly title: string;
  readonly quality: Quality;
  readonly choice: RegionChoice;
  readonly measure: CountedMeasure;
  readonly marks: readonly number[];
  readonly colorOf: (value: number) => string;
  readonly valueText: (value: number) => string;
  /** What is counted: "angles", "tetrahedra" … */
  readonly noun: string;
  /** Figures below the bars, by name. */
  readonly facts: readonly (readonly [name: string, value: string])[];
}

function Chart({ title, quality, choice, measure, marks, colorOf, valueText, noun, facts }: ChartProps) {
  const bars = countsOf(quality, choice, measure);
  return (
    <section aria-label={title}>
      <SectionTitle>{title}</SectionTitle>
      <HistogramChart
        bars={bars}
        end={bars.length * quality.binWidths[measure]}
        marks={marks}
        label={strings.quality.histogram(title)}
        testId={`chart-${measure}`}
        colorOf={colorOf}
        describe={(count, from, to) => texts.bar(formatCount(count), noun, valueText(from), valueText(to))}
      />
      <p className="tf-histogram-foot">
        {facts.map(([name, value]) => (
          <span key={name}>
            {name} <b>{value}</b>
          </span>
        ))}
      </p>
    </section>
  );
}

interface ReportChartProps {
  readonly report: MeshReport;
  readonly choice: RegionChoice;
}

/** Bars of values as wished for have the accent's colour, all others that of a warning. */
const within =
  ({ from, to }: { readonly from: number; readonly to: number }) =>
  (value: number): string =>
    value >= from && value <= to ? "var(--tf-chart)" : "var(--tf-chart-off)";

function AngleChart({ report: { quality, dihedral }, choice }: ReportChartProps) {
  return (
    <Chart
      title={texts.dihedral}
      quality={quality}
      choice={choice}
      measure="dihedral"
      marks={[0, 30, 60, 90, 135, 180]}
      colorOf={within(wantedAngles)}
      valueText={formatAngle}
      noun={texts.angles}
      facts={
        choice === null
          ? [
              [strings.quality.min, formatAngle(dihedral.min)],
              [texts.max, formatAngle(dihedral.max)],
            ]
          : []
      }
    />
  );
}

function RatioChart({ report: { quality, radiusRatio }, choice }: ReportChartProps) {
  return (
    <Chart
      title={texts.radiusRatio}
      quality={quality}
      choice={choice}
      measure="radiusRatio"
      marks={[0, 0.25, 0.5, 0.75, bestValue["radius-ratio"]]}
      colorOf={(value) =>
        viridisAt(placeOnScale(Math.max(value, worstShown["radius-ratio"]), "radius-ratio"))
      }
      valueText={(value) => value.toFixed(2)}
      noun={texts.tetrahedra}
      facts={
        choice === null
          ? [
              [strings.quality.min, radiusRatio.min.toFixed(3)],
              [strings.quality.mean, radiusRatio.mean.toFixed(3)],
            ]
          : []
      }
    />
  );
}

function EdgeChart({ quality, choice }: { readonly quality: Quality; readonly choice: RegionChoice }) {
  const share =
    choice === null
      ? quality.edges.nearTarget
      : shareBetween(countsOf(quality, choice, "edge"), quality.binWidths.edge, nearWanted);
  return (
    <Chart
      title={texts.edge}
      quality={quality}
      choice={choice}
      measure="edge"
      marks={[0, nearWanted.from, 1, nearWanted.to, 2, 3]}
      colorOf={within(nearWanted)}
      valueText={(value) => value.toFixed(1)}
      noun={texts.edges}
      facts={[
        [texts.nearTarget(nearWanted.from, nearWanted.to), formatShare(share)],
        ...(choice === null ? [[strings.quality.mean, quality.edges.mean.toFixed(2)] as const] : []),
      ]}
    />
  );
}

function KeyFigures({ quality }: { readonly quality: Quality }) {
  return (
    <dl className="tf-facts">
      <dt>{texts.volumeRatio}</dt>
      <dd data-testid="volume-ratio">{formatShort(quality.volumeRatio)}</dd>
      {quality.smallest && (
        <>
          <dt>{texts.smallest}</dt>
          <dd>
            <ElementButton element={quality.smallest} text={formatShort(quality.smallest.volume)} />
          </dd>
        </>
      )}
      <dt title={texts.outOfRangeHint}>{texts.outOfRange}</dt>
      <dd data-testid="out-of-range">{formatCount(quality.outOfRange)}</dd>
      <dt title={texts.limitedHint}>{texts.limited}</dt>
      <dd data-testid="limited">{formatCount(quality.limitedByBoundary.count)}</dd>
    </dl>
  );
}

interface ElementButtonProps {
  readonly element: ElementQuality;
  readonly text: string;
  readonly testId?: string;
}

/** Goes to an element and marks it. */
function ElementButton({ element: { tetrahedron, centroid: place }, text, testId }: ElementButtonProps) {
  const app = useApp();
  const marked = useView((state) => state.element === tetrahedron);
  return (
    <UnstyledButton
      className="tf-element"
      aria-pressed={marked}
      aria-label={texts.show(formatCount(tetrahedron), formatPlace(place))}
      title={texts.show(formatCount(tetrahedron), formatPlace(place))}
      data-testid={testId}
      onClick={() => showElement(app, tetrahedron)}
    >
      {text}
    </UnstyledButton>
  );
}

interface ElementTableProps {
  readonly elements: readonly ElementQuality[];
  readonly testId: string;
}

/** Elements, worst first, with their angles and places. */
function ElementTable({ elements, testId }: ElementTableProps) {
  const marked = useView((state) => state.element);
  return (
    <table className="tf-table tf-elements" data-testid={testId}>
      <thead>
        <tr>
          {texts.columns.map((title) => (
            <th key={title} scope="col">
              {title}
            </th>
          ))}
        </tr>
      </thead>
      <tbody>
        {elements.map((element, index) => (
          <tr key={element.tetrahedron} data-marked={element.tetrahedron === marked || undefined}>
            <th scope="row">
              <ElementButton
                element={element}
                text={formatPlace(element.centroid.map((x) => Number(x.toPrecision(3))))}
                testId={`${testId}-${index}`}
              />
            </th>
            <td>{formatAngle(element.dihedral.min)}</td>
            <td>{formatAngle(element.dihedral.max)}</td>
            <td>{element.radiusRatio.toFixed(2)}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

/** Those that the boundary forbids to be better, apart from the rest. */
function Limited({ quality: { limitedByBoundary } }: { readonly quality: Quality }) {
  const { count, worst } = limitedByBoundary;
  if (count === 0) return null;
  return (
    <section>
      <SectionTitle>{texts.limitedTitle(formatCount(count))}</SectionTitle>
      <Text size="xs" c="dimmed" mb={4}>
        {texts.limitedHint}
      </Text>
      <ElementTable elements={worst} testId="limited-worst" />
    </section>
  );
}

/** The rungs by which the front was brought to an end, in words. */
function Recovery({ recovery }: { readonly recovery: MeshReport["recovery"] }) {
  const steps = recoverySteps(recovery);
  return (
    <section data-testid="recovery">
      <SectionTitle>{texts.recovery}</SectionTitle>
      {steps.length === 0 ? (
        <Text size="sm" c="dimmed">
          {texts.noRecovery}
        </Text>
      ) : (
        <ul className="tf-list">
          {steps.map((step) => (
            <li key={step}>{step}</li>
          ))}
        </ul>
      )}
    </section>
  );
}
