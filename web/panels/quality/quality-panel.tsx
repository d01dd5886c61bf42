import { Button, CopyButton, Group, Text, UnstyledButton } from "@mantine/core";
import type { MeshReport, MeshResult } from "tetrafront";
import { bestValue, scalePosition, type QualityMeasure } from "../../document/mesh-quality";
import { cancelledText } from "../../session/run-log";
import { SectionTitle } from "../../ui/frames/section-title";
import {
  formatAngle,
  formatCount,
  formatMeasure,
  formatSeconds,
  formatShortShare,
} from "../../strings/format";
import { HistogramChart } from "../../ui/histogram-chart";
import { measuredIn, measureNames, strings } from "../../strings";
import { ratioMeanings } from "../../strings/ratio-meanings";
import { Explained } from "../../ui/explained";
import { viridisAt } from "../../ui/theme/viridis";
import { useApp, useProject, useQualitySpace, useRun, useStale, useView } from "../shared/app-context";
import { useHistogram } from "./use-histogram";
import { ImproveButton } from "./improvement";
import { SecondOrderSection } from "./second-order";
import { Facts } from "../../ui/facts";
import styles from "./quality-panel.module.css";

/** Number of bars of the histogram. */
const barCount = 20;
const tickShares = [0, 0.25, 0.5, 0.75, 1];

function valueText(measure: QualityMeasure, value: number): string {
  return measure === "dihedral" ? formatAngle(value) : value.toFixed(3);
}

/** Statistics of the shown mesh and a histogram of the quality measure. */
export function QualityPanel() {
  const app = useApp();
  const mesh = useRun((state) => state.mesh);
  const stale = useStale();
  const cancelled = useRun(cancelledText);
  if (!mesh) {
    return (
      <>
        <SectionTitle>{strings.quality.title}</SectionTitle>
        <Text size="sm" c="dimmed">
          {strings.quality.none}
        </Text>
      </>
    );
  }
  // Without elements, the statistics of the report are zeros without a meaning.
  const measured = mesh.report.tetrahedra > 0;
  const isUnfinished = measured && mesh.report.status === "cancelled";
  return (
    <section data-stale={stale || undefined}>
      <SectionTitle>
        {strings.quality.title}
        {stale && <span className={styles["note"]}>{strings.viewport.stale.toLowerCase()}</span>}
        {isUnfinished && <span className={styles["note"]}>{strings.quality.unfinished}</span>}
      </SectionTitle>
      {cancelled !== null && (
        <Text size="sm" mb={8}>
          {`${cancelled}.`}
        </Text>
      )}
      {measured && <MeasureHistogram mesh={mesh} />}
      <ReportFacts report={mesh.report} measured={measured} />
      {mesh.report.status === "done" && measured && <SecondOrderSection />}
      {measured && (
        <Group gap={8} mt={10}>
          <Button
            size="compact-sm"
            variant="default"
            data-testid="all-statistics"
            onClick={() => app.shell.setState({ rightTab: "quality" })}
          >
            {strings.report.all}
          </Button>
          <ImproveButton />
        </Group>
      )}
    </section>
  );
}

/**
 * The histogram of the measure by which the mesh is shaded, or of the radius ratio if the shading shows no
 * measure.
 */
function MeasureHistogram({ mesh }: { readonly mesh: MeshResult }) {
  const shading = useView((state) => state.shading);
  const measure = shading === "dihedral" ? "dihedral" : "radius-ratio";
  const space = useQualitySpace();
  const histogram = useHistogram(mesh, measure, space ?? "space", barCount);
  const { unmeasured } = strings.quality;
  return (
    <>
      <Text size="sm" c="dimmed" mb={4}>
        {measure === "radius-ratio" ? (
          <Explained name={measuredIn(measureNames[measure], space)} meaning={ratioMeanings.tetrahedron} />
        ) : (
          measuredIn(measureNames[measure], space)
        )}
      </Text>
      <HistogramChart
        bars={histogram?.bars ?? null}
        end={bestValue[measure]}
        ticks={tickShares.map((share) => share * bestValue[measure])}
        testId="quality-histogram"
        label={strings.quality.histogram(measureNames[measure])}
        colorOf={(value) => viridisAt(scalePosition(value, measure))}
        describe={(count, from, to) =>
          strings.quality.bar(formatCount(count), valueText(measure, from), valueText(measure, to))
        }
        facts={[
          [strings.quality.min, histogram ? valueText(measure, histogram.min) : unmeasured],
          [strings.quality.mean, histogram ? valueText(measure, histogram.mean) : unmeasured],
        ]}
      />
    </>
  );
}

interface ReportFactsProps {
  readonly report: MeshReport;
  /** Returns whether the report has statistics of elements. */
  readonly measured: boolean;
}

function ReportFacts({ report, measured }: ReportFactsProps) {
  const texts = strings.quality;
  const { units } = useProject();
  const ifMeasured = (text: string): string => (measured ? text : texts.unmeasured);
  const space = useQualitySpace();
  const origin = useRun((state) => state.origin);
  const { min, max } = space === "metric" ? report.quality.shapes.dihedral : report.dihedral;
  return (
    <Facts>
      <dt>{texts.tetrahedra}</dt>
      <dd>{formatCount(report.tetrahedra)}</dd>
      {report.interior.lattice > 0 && (
        <>
          <dt title={texts.latticeHint}>{texts.lattice}</dt>
          <dd>{texts.latticeShare(formatShortShare(report.interior.lattice / report.tetrahedra))}</dd>
        </>
      )}
      <dt>{texts.nodes}</dt>
      <dd>{ifMeasured(formatCount(report.nodes))}</dd>
      <dt>{texts.triangles}</dt>
      <dd>{formatCount(report.triangles)}</dd>
      <dt>{measuredIn(texts.dihedral, space)}</dt>
      <dd>{ifMeasured(`${formatAngle(min)} – ${formatAngle(max)}`)}</dd>
      <dt>{texts.volume}</dt>
      <dd>{ifMeasured(formatMeasure(report.volume, units, 3))}</dd>
      {origin ? (
        <>
          <dt>{texts.file}</dt>
          <dd>{origin.fileName}</dd>
        </>
      ) : (
        <>
          <dt>{texts.time}</dt>
          <dd>{formatSeconds(report.seconds.total)}</dd>
        </>
      )}
      {measured && report.fingerprint !== "" && <Fingerprint value={report.fingerprint} />}
    </Facts>
  );
}

/** A hash that is equal for equal meshes on every platform. A click copies it. */
function Fingerprint({ value }: { readonly value: string }) {
  return (
    <>
      <dt>{strings.quality.fingerprint}</dt>
      <dd>
        <CopyButton value={value}>
          {({ copied, copy }) => (
            <UnstyledButton className={styles["fingerprint"]} data-testid="fingerprint" onClick={copy}>
              {copied ? strings.quality.copied : value}
            </UnstyledButton>
          )}
        </CopyButton>
      </dd>
    </>
  );
}
