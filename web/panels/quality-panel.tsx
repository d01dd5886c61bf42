import { Button, CopyButton, Text, UnstyledButton } from "@mantine/core";
import { bestValue, placeOnScale, type QualityMeasure } from "../document/mesh-quality";
import { SectionTitle } from "../ui/field-row";
import { formatAngle, formatCount, formatSeconds, formatShort } from "../ui/format";
import { HistogramChart } from "../ui/histogram-chart";
import { measureNames, strings } from "../ui/strings";
import { viridisAt } from "../ui/viridis";
import { useApp, useRun, useStale, useView } from "./app-context";
import { useHistogram } from "./use-histogram";

/** Bars of the histogram. */
const barCount = 20;
const axisShares = [0, 0.25, 0.5, 0.75, 1];

function valueText(measure: QualityMeasure, value: number): string {
  return measure === "dihedral" ? formatAngle(value) : value.toFixed(3);
}

/** Statistics of the mesh on show, and how its elements are spread over the quality measure. */
export function QualityPanel() {
  const app = useApp();
  const mesh = useRun((state) => state.mesh);
  const shading = useView((state) => state.shading);
  const stale = useStale();
  const measure = shading === "dihedral" ? "dihedral" : "radius-ratio";
  const histogram = useHistogram(mesh, measure, barCount);
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
  const { report } = mesh;
  const { unmeasured } = strings.quality;
  // Without an element the report holds zeros that nobody measured.
  const measured = report.tetrahedra > 0;
  return (
    <section className="tf-quality" data-stale={stale || undefined}>
      <SectionTitle>
        {strings.quality.title}
        {stale && <span className="tf-section-note">{strings.viewport.stale.toLowerCase()}</span>}
      </SectionTitle>
      {measured && (
        <>
          <Text size="sm" c="dimmed" mb={4}>
            {measureNames[measure]}
          </Text>
          <HistogramChart
            bars={histogram?.bars ?? null}
            end={bestValue[measure]}
            marks={axisShares.map((share) => share * bestValue[measure])}
            testId="quality-histogram"
            label={strings.quality.histogram(measureNames[measure])}
            colorOf={(value) => viridisAt(placeOnScale(value, measure))}
            describe={(count, from, to) =>
              strings.quality.bar(formatCount(count), valueText(measure, from), valueText(measure, to))
            }
          />
          <p className="tf-histogram-foot">
            <span>
              {strings.quality.min} <b>{histogram ? valueText(measure, histogram.min) : unmeasured}</b>
            </span>
            <span>
              {strings.quality.mean} <b>{histogram ? valueText(measure, histogram.mean) : unmeasured}</b>
            </span>
          </p>
        </>
      )}
      <dl className="tf-facts">
        <dt>{strings.quality.tetrahedra}</dt>
        <dd>{formatCount(report.tetrahedra)}</dd>
        <dt>{strings.quality.nodes}</dt>
        <dd>{measured ? formatCount(report.nodes) : unmeasured}</dd>
        <dt>{strings.quality.triangles}</dt>
        <dd>{formatCount(report.triangles)}</dd>
        <dt>{strings.quality.dihedral}</dt>
        <dd>
          {measured
            ? `${formatAngle(report.dihedral.min)} – ${formatAngle(report.dihedral.max)}`
            : unmeasured}
        </dd>
        <dt>{strings.quality.volume}</dt>
        <dd>{measured ? formatShort(report.volume) : unmeasured}</dd>
        <dt>{strings.quality.time}</dt>
        <dd>{formatSeconds(report.seconds.total)}</dd>
        {measured && report.fingerprint !== "" && <Fingerprint value={report.fingerprint} />}
      </dl>
      {measured && (
        <Button
          size="compact-sm"
          mt={10}
          variant="default"
          data-testid="all-figures"
          onClick={() => app.shell.setState({ rightTab: "quality" })}
        >
          {strings.report.all}
        </Button>
      )}
    </section>
  );
}

/** Equal for equal meshes, on every platform. A click copies it. */
function Fingerprint({ value }: { readonly value: string }) {
  return (
    <>
      <dt>{strings.quality.fingerprint}</dt>
      <dd>
        <CopyButton value={value}>
          {({ copied, copy }) => (
            <UnstyledButton className="tf-mono" data-testid="fingerprint" onClick={copy}>
              {copied ? strings.quality.copied : value}
            </UnstyledButton>
          )}
        </CopyButton>
      </dd>
    </>
  );
}
