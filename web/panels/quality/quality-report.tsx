import { SegmentedControl, Text } from "@mantine/core";
import { useState } from "react";
import type { MeshResult, QualityReport as Quality } from "tetrafront";
import type { QualitySpace } from "../../document/mesh-quality";
import type { RegionChoice } from "../../document/quality-counts";
import { Facts } from "../../ui/facts";
import { formatCount, formatMeasure, formatShort } from "../../strings/format";
import { ScrollPanel } from "../../ui/frames/scroll-panel";
import { SectionTitle } from "../../ui/frames/section-title";
import { strings } from "../../strings";
import { useApp, useProject, useQualitySpace, useRun, useStale } from "../shared/app-context";
import { ElementButton, ElementTable } from "./element-table";
import { AngleChart, EdgeChart, RatioChart } from "./quality-charts";
import { ImprovementSection } from "./improvement";
import { RecoverySection } from "./recovery-section";
import { RegionSelect } from "./region-select";
import { useQualityStatistics, type QualityStatistics } from "./use-quality-statistics";
import { Verdict } from "./verdict";

const texts = strings.report;

/** The quality of the elements of the shown mesh. */
export function QualityReport() {
  const mesh = useRun((state) => state.mesh);
  const stale = useStale();
  const isMeasured = mesh !== null && mesh.report.quality.regions.length > 0;
  return (
    <ScrollPanel label={texts.title} data-testid="quality-report" data-stale={stale || undefined}>
      {mesh && <Verdict report={mesh.report} stale={stale} />}
      {isMeasured ? (
        <>
          <ImprovementSection />
          <Measurements mesh={mesh} />
        </>
      ) : (
        <Text size="sm" c="dimmed">
          {mesh ? texts.notFinished : strings.quality.none}
        </Text>
      )}
    </ScrollPanel>
  );
}

function Measurements({ mesh }: { readonly mesh: MeshResult }) {
  const space = useQualitySpace();
  const origin = useRun((state) => state.origin);
  const statistics = useQualityStatistics(mesh, space);
  return (
    <>
      {space && <SpaceSwitch space={space} />}
      {statistics ? (
        <Statistics statistics={statistics} />
      ) : (
        <Text size="sm" c="dimmed" mt={10} role="status">
          {texts.measuring}
        </Text>
      )}
      {!origin && <RecoverySection recovery={mesh.report.recovery} />}
    </>
  );
}

const spaces: readonly QualitySpace[] = ["metric", "space"];

/** Chooses where quality is measured, everywhere on the page. */
function SpaceSwitch({ space }: { readonly space: QualitySpace }) {
  const app = useApp();
  return (
    <>
      <SegmentedControl<QualitySpace>
        size="xs"
        fullWidth
        mt={10}
        aria-label={texts.measuredIn}
        data-testid="quality-space"
        data={spaces.map((value) => ({ value, label: texts.spaces[value] }))}
        value={space}
        onChange={(qualitySpace) => app.view.state.setState({ qualitySpace })}
      />
      <Text size="xs" c="dimmed" mt={4}>
        {texts.spaceHints[space]}
      </Text>
    </>
  );
}

/** The charts and numbers, all measured in one space. */
function Statistics({ statistics }: { readonly statistics: QualityStatistics }) {
  const { quality } = statistics;
  const [chosen, setChosen] = useState<RegionChoice>(null);
  const choice = quality.regions.some(({ region }) => region === chosen) ? chosen : null;
  return (
    <>
      {quality.regions.length > 1 && <RegionSelect quality={quality} choice={choice} onChoose={setChosen} />}
      <AngleChart statistics={statistics} choice={choice} />
      <RatioChart statistics={statistics} choice={choice} />
      <EdgeChart statistics={statistics} choice={choice} />
      <ElementCounts quality={quality} />
      <SectionTitle>{texts.worst(quality.worst.length)}</SectionTitle>
      <ElementTable elements={quality.worst} testId="worst" />
      <LimitedSection quality={quality} />
    </>
  );
}

function ElementCounts({ quality }: { readonly quality: Quality }) {
  const { units } = useProject();
  return (
    <Facts>
      <dt>{texts.volumeRatio}</dt>
      <dd>{formatShort(quality.volumeRatio)}</dd>
      {quality.smallest && (
        <>
          <dt>{texts.smallest}</dt>
          <dd>
            <ElementButton
              element={quality.smallest}
              text={formatMeasure(quality.smallest.volume, units, 3)}
            />
          </dd>
        </>
      )}
      <dt title={texts.outOfRangeHint}>{texts.outOfRange}</dt>
      <dd data-testid="out-of-range">{formatCount(quality.outOfRange)}</dd>
      <dt title={texts.limitedHint}>{texts.limited}</dt>
      <dd data-testid="limited">{formatCount(quality.limitedByBoundary.count)}</dd>
    </Facts>
  );
}

/** The elements whose quality the boundary limits. */
function LimitedSection({ quality: { limitedByBoundary } }: { readonly quality: Quality }) {
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
