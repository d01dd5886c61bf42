import { ActionIcon, Button, Kbd, Switch, Text, Tooltip } from "@mantine/core";
import { IconArrowsExchange, IconPlugConnectedX } from "@tabler/icons-react";
import type { MeshStatus } from "tetrafront";
import { bestValue, worstShown, type QualityMeasure } from "../document/mesh-quality";
import { measureNames, strings } from "../ui/strings";
import { viridis } from "../ui/viridis";
import { useApp, useRegions, useRun, useStale, useView } from "./app-context";
import { CutAxisControl, CutSlider } from "./cut-controls";
import { RegionList } from "./region-list";

/** The cut, where the eye is: on or off, axis, position, side. */
export function CutBar() {
  const app = useApp();
  const cut = useView((state) => state.cut);
  return (
    <div className="tf-cutbar" role="group" aria-label={strings.display.cut}>
      <Switch
        size="xs"
        label={strings.display.cut}
        checked={cut.enabled}
        data-testid="cut-toggle"
        onChange={(event) => app.view.setCut({ enabled: event.currentTarget.checked })}
      />
      {cut.enabled && (
        <>
          <CutAxisControl />
          <CutSlider />
          <Tooltip label={strings.display.flip}>
            <ActionIcon
              size={24}
              variant="subtle"
              color="gray"
              aria-label={strings.display.flip}
              aria-pressed={cut.flipped}
              data-testid="cut-flip"
              onClick={() => app.view.setCut({ flipped: !cut.flipped })}
            >
              <IconArrowsExchange size={15} aria-hidden />
            </ActionIcon>
          </Tooltip>
        </>
      )}
    </div>
  );
}

function badgeTexts(
  failure: string | null,
  stale: boolean,
  status: MeshStatus | undefined,
  hasFront: boolean,
): readonly [title: string, hint: string] {
  const { viewport } = strings;
  if (failure !== null) return [strings.messages.engineFailed, failure];
  if (stale) return [viewport.stale, viewport.staleHint];
  if (status === "stalled") return [viewport.incomplete, viewport.incompleteStalled];
  return [viewport.incomplete, hasFront ? viewport.incompleteCancelled : viewport.incompleteUnpolished];
}

/** Says when the mesh on show is not what the model asks for, and offers the remedy. */
export function MeshBadge() {
  const app = useApp();
  const stale = useStale();
  const busy = useRun((state) => state.busy);
  const failure = useRun((state) => state.failure);
  const status = useRun((state) => state.mesh?.report.status);
  const hasFront = useRun((state) => (state.mesh?.volume.front.length ?? 0) > 0);
  if (busy) return null;
  const incomplete = status === "stalled" || status === "cancelled";
  if (!stale && !incomplete && failure === null) return null;
  const [title, hint] = badgeTexts(failure, stale, status, hasFront);
  return (
    <div className="tf-badge" data-testid="mesh-badge" role="status">
      <span>
        <b>{title}</b> <span className="tf-wide">{hint}</span>
      </span>
      <Button size="compact-xs" variant="default" onClick={() => void app.run.generate()}>
        {strings.viewport.update}
      </Button>
    </div>
  );
}

const legendMarks = [1, 0.75, 0.5, 0.25, 0];

/** What the colours of the mesh mean. */
export function Legend() {
  const shading = useView((state) => state.shading);
  const visible = useView((state) => state.layers.mesh);
  const hasMesh = useRun((state) => (state.mesh?.report.tetrahedra ?? 0) > 0);
  if (shading === "plain" || !visible || !hasMesh) return null;
  return shading === "region" ? <RegionLegend /> : <ScaleLegend measure={shading} />;
}

/** The colour and size of each region; nothing where there is one only. */
function RegionLegend() {
  const regions = useRegions();
  if (regions.length < 2) return null;
  return (
    <figure className="tf-legend tf-legend-regions" aria-label={strings.regions.title} data-testid="legend">
      <figcaption>{strings.regions.title.toLowerCase()}</figcaption>
      <RegionList testId="legend-region" />
    </figure>
  );
}

/** The scale of a measure, in numbers. */
function ScaleLegend({ measure }: { readonly measure: QualityMeasure }) {
  return (
    <figure className="tf-legend" aria-label={`${strings.viewport.legend}: ${measureNames[measure]}`}>
      <div
        className="tf-legend-bar"
        style={{ background: `linear-gradient(to top, ${viridis.join(", ")})` }}
      />
      <div className="tf-legend-marks">
        {legendMarks.map((mark) => {
          const worst = worstShown[measure];
          const value = worst + mark * (bestValue[measure] - worst);
          return (
            <span key={mark}>{measure === "dihedral" ? `${Math.round(value)}°` : value.toFixed(2)}</span>
          );
        })}
      </div>
      <figcaption>{measureNames[measure].toLowerCase()}</figcaption>
    </figure>
  );
}

export function MouseHint() {
  return (
    <div className="tf-hint">
      {strings.viewport.hints.map(([key, effect]) => (
        <span key={key}>
          <Kbd size="xs">{key}</Kbd> {effect}
        </span>
      ))}
    </div>
  );
}

/** Instead of a blank view. */
export function ViewNotice({ trouble }: { readonly trouble: "no-webgl" | "context-lost" }) {
  const lost = trouble === "context-lost";
  return (
    <div className="tf-notice" role="alert">
      <IconPlugConnectedX size={28} aria-hidden />
      <Text fw={600}>{lost ? strings.viewport.contextLost : strings.viewport.noWebgl}</Text>
      <Text size="sm" c="dimmed">
        {lost ? strings.viewport.contextLostHint : strings.viewport.noWebglHint}
      </Text>
    </div>
  );
}
