import { useStore } from "zustand";
import { asksForStretching, bestValue, worstShown, type QualityMeasure } from "../../document/mesh-quality";
import { measuredIn, measureNames, spaceNames, strings } from "../../strings";
import { formatShort } from "../../strings/format";
import type { ShownField } from "../../session/solutions";
import type { ShownSmoothness } from "../../session/smoothness-feed";
import { shownBodies } from "../../viewer/shown-bodies";
import { viridis } from "../../ui/theme/viridis";
import {
  useApp,
  useMeshOfOthers,
  useProject,
  useQualitySpace,
  useRegions,
  useRun,
  useView,
} from "../shared/app-context";
import { useSlots } from "../shared/slots";
import { ScaleLegend } from "./scale-legend";
import styles from "./legend.module.css";
import { RegionList } from "../shared/region-list";

/** The meaning of the mesh's colours. */
export function Legend() {
  const app = useApp();
  const isReplaying = useStore(app.replay.state, ({ isShown }) => isShown);
  const { Legend: ReplayLegend } = useSlots();
  const showsDeviation = useDeviationShown();
  const sizes = useStore(app.sizes.state, (state) => state.shown);
  const smoothness = useStore(app.smoothness.state, (state) => state.shown);
  const field = useFieldShown();
  if (isReplaying) return <ReplayLegend />;
  if (smoothness) return <SmoothnessLegend shown={smoothness} />;
  if (sizes) return <SizeLegend range={sizes.range} />;
  if (field) return <FieldLegend field={field} />;
  if (showsDeviation) return <DeviationLegend />;
  return <MeshLegend />;
}

/** The colour scale of a curvature; what the zebra stripes mean. */
function SmoothnessLegend({ shown: { by, range } }: { readonly shown: ShownSmoothness }) {
  const { units } = useProject();
  if (by === "zebra") {
    return (
      <figure className={styles["legend"]} aria-label={strings.display.zebra} data-testid="zebra-legend">
        <figcaption>{strings.display.zebra}</figcaption>
      </figure>
    );
  }
  const [low, high] = range;
  const name = strings.display.curvature[by];
  const unit = units === undefined ? "" : ` (1/${units}${by === "gaussian" ? "²" : ""})`;
  const values = low === high ? [low] : ticks.map((tick) => low + tick * (high - low));
  const middle = viridis[(viridis.length - 1) / 2];
  return (
    <ScaleLegend
      name={`${name}${unit}`}
      testId="curvature-legend"
      ticks={values.map((value) => formatShort(Number(value.toPrecision(3))))}
      {...(low === high && middle !== undefined && { background: middle })}
    />
  );
}

/** Returns the values of the mesh that the view shows; null if it shows none. */
function useFieldShown(): ShownField | null {
  const app = useApp();
  const field = useStore(app.solutions.state, (state) => state.shown);
  const isVisible = useView((state) => state.layers.mesh);
  const hasMesh = useShowsMesh();
  const isOfMesh = useRun(
    ({ mesh, unoptimized }) => unoptimized === null && mesh?.mesh.tetrahedra === field?.tetrahedra,
  );
  const hasIsosurface = useStore(
    app.solutions.state,
    ({ shapes, shown }) => shapes.isosurface !== null && shown?.isPerElement === false,
  );
  return (isVisible || hasIsosurface) && hasMesh && isOfMesh ? field : null;
}

/** The colour scale of a field. */
function FieldLegend({ field: { choice, range } }: { readonly field: ShownField }) {
  const [low, high] = range;
  const values = low === high ? [low] : ticks.map((tick) => low + tick * (high - low));
  const middle = viridis[(viridis.length - 1) / 2];
  return (
    <ScaleLegend
      name={choice.label}
      testId="field-legend"
      ticks={values.map((value) => formatShort(Number(value.toPrecision(3))))}
      {...(low === high && middle !== undefined && { background: middle })}
    />
  );
}

/** Returns whether the view shows the deviation of new triangles of a body. */
function useDeviationShown(): boolean {
  const app = useApp();
  const project = useProject();
  const surface = useView((state) => state.bodySurface);
  const meshLayer = useView((state) => state.layers.mesh);
  const bodyLayer = useView((state) => state.layers.bodies);
  const hasFront = useRun(({ front }) => (front?.length ?? 0) > 0);
  const hasMesh = useShowsMesh() || hasFront;
  useStore(app.bodies.state, ({ byId }) => byId);
  if (!bodyLayer || surface !== "new" || (meshLayer && hasMesh)) return false;
  return shownBodies(project, app.bodies).some(
    ({ preview, split }) => preview !== null && preview.values !== null && split === null,
  );
}

/** Ticks on the scale of sizes, as shares of it: the ratio of two neighbouring ticks is the same everywhere. */
const sizeTicks = [1, 0.75, 0.5, 0.25, 0];

/** The colour scale of the target sizes. */
function SizeLegend({ range: [low, high] }: { readonly range: readonly [number, number] }) {
  const name = strings.background.sizeLegend;
  const { units } = useProject();
  const isOneSize = low === high;
  const values = isOneSize ? [low] : sizeTicks.map((share) => low * (high / low) ** share);
  // As many digits as tell neighbouring ticks apart.
  const digits =
    [2, 3].find((n) => new Set(values.map((value) => value.toPrecision(n))).size === values.length) ?? 4;
  const middle = viridis[(viridis.length - 1) / 2];
  return (
    <ScaleLegend
      name={units === undefined ? name : `${name} (${units})`}
      testId="size-legend"
      ticks={values.map((value) => formatShort(Number(value.toPrecision(digits))))}
      {...(isOneSize && middle !== undefined && { background: middle })}
    />
  );
}

/** The colour scale of the distance between the new triangles and the given surface. */
function DeviationLegend() {
  const name = strings.bodies.preview.deviationLegend;
  return (
    <ScaleLegend name={name} testId="deviation-legend" ticks={ticks.map((tick) => (1 - tick).toFixed(2))} />
  );
}

/** The meaning of the colours of tetrahedra. */
function MeshLegend() {
  const shading = useView((state) => state.shading);
  const visible = useView((state) => state.layers.mesh);
  const hasMesh = useShowsMesh();
  if (shading === "plain" || !visible || !hasMesh) return null;
  return shading === "region" ? <RegionLegend /> : <MeasureLegend measure={shading} />;
}

/**
 * Returns whether the view shows tetrahedra if their layer is on. While the front advances, the view shows the front instead of
 * the mesh.
 */
function useShowsMesh(): boolean {
  const isOfOthers = useMeshOfOthers();
  return useRun(
    ({ front, unoptimized, mesh }) =>
      unoptimized !== null || (front === null && !isOfOthers && (mesh?.report.tetrahedra ?? 0) > 0),
  );
}

/** The colour and size of each region; nothing if there is only one. */
function RegionLegend() {
  const regions = useRegions();
  if (regions.length < 2) return null;
  return (
    <figure
      className={`${styles["legend"]} ${styles["regions"]}`}
      aria-label={strings.regions.title}
      data-testid="legend"
      data-legend="list"
    >
      <figcaption>{strings.regions.title.toLowerCase()}</figcaption>
      <RegionList testId="legend-region" />
    </figure>
  );
}

/** Returns the space of the colours, null if there is no choice. A mesh that is being optimized is measured in space. */
function useShownSpace() {
  const isUnoptimized = useRun((state) => state.unoptimized !== null);
  const isStretched = asksForStretching(useProject());
  const chosen = useQualitySpace();
  const space = isUnoptimized ? (isStretched ? ("space" as const) : null) : chosen;
  return { space, isUnoptimized };
}

/** Positions of the ticks on the colour scale. */
const ticks = [1, 0.75, 0.5, 0.25, 0];

/** The colour scale of a measure. */
function MeasureLegend({ measure }: { readonly measure: QualityMeasure }) {
  const worst = worstShown[measure];
  const { space, isUnoptimized } = useShownSpace();
  const lines = [
    measureNames[measure].toLowerCase(),
    ...(space ? [spaceNames[space]] : []),
    ...(isUnoptimized ? [strings.viewport.unoptimized] : []),
  ];
  const values = ticks.map((tick) => worst + tick * (bestValue[measure] - worst));
  return (
    <ScaleLegend
      name={measuredIn(measureNames[measure], space)}
      lines={lines}
      testId="legend"
      ticks={values.map((value) => (measure === "dihedral" ? `${Math.round(value)}°` : value.toFixed(2)))}
    />
  );
}
