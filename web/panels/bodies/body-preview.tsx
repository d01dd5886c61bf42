import { Button, Progress, SegmentedControl, Text } from "@mantine/core";
import { IconEye, IconX } from "@tabler/icons-react";
import type { PreparedBody } from "tetrafront";
import type { ProjectBody } from "tetrafront/project";
import { previewBody, showBodySurface } from "../../commands/surface-actions";
import { Facts } from "../../ui/facts";
import { FieldRow } from "../../ui/fields/field-row";
import { IconButton } from "../../ui/icon-button";
import { formatAngle, formatCount, formatMeasure } from "../../strings/format";
import { strings } from "../../strings";
import { ratioMeanings } from "../../strings/ratio-meanings";
import { Explained } from "../../ui/explained";
import { useApp, useProject, useMeshOfOthers, useRun, useView } from "../shared/app-context";
import { PositionList } from "../shared/position-list";
import styles from "./bodies.module.css";
import { useBody, usePreparation } from "./use-body";

const texts = strings.bodies.preview;

/** The preview of the triangles that will be meshed: its progress, its statistics, and what the view shows. */
export function BodyPreview({ body }: { readonly body: ProjectBody }) {
  const app = useApp();
  const state = useBody(body.id);
  const { preparation, isCurrent } = usePreparation(body);
  const isFillable = state?.inspection?.isFillable === true;
  // A run waits for the preview, and shows the progress of both as one.
  const isMeshing = useRun(({ busy, task }) => busy && task === "mesh");
  return (
    <section data-testid="body-preview" data-current={isCurrent}>
      {state?.preparing != null
        ? !isMeshing && <Making fraction={state.preparing} onCancel={() => app.bodies.cancel(body.id)} />
        : !isCurrent && (
            <Button
              fullWidth
              size="xs"
              mt={6}
              variant="default"
              disabled={!isFillable}
              leftSection={<IconEye size={14} aria-hidden />}
              data-testid="body-preview-make"
              onClick={() => previewBody(app, body.id)}
            >
              {preparation ? texts.update : texts.make}
            </Button>
          )}
      {state?.preparationFailure != null && (
        <Text size="sm" c="var(--tf-error)" role="alert" mt={4}>
          {state.preparationFailure}
        </Text>
      )}
      {preparation && !isCurrent && (
        <Text size="xs" c="dimmed" mt={4}>
          {texts.stale}
        </Text>
      )}
      <ShownTriangles hasPreview={isCurrent} />
      {preparation && isCurrent && <PreparedFacts prepared={preparation.prepared} />}
      {preparation && isCurrent && <DroppedDetails prepared={preparation.prepared} />}
    </section>
  );
}

function Making({ fraction, onCancel }: { readonly fraction: number; readonly onCancel: () => void }) {
  return (
    <div className={styles["progress"]} role="status" aria-label={texts.making}>
      <Progress
        value={100 * fraction}
        size="sm"
        aria-label={texts.making}
        // Without graphics hardware, animating the bar costs as much as the work.
        transitionDuration={0}
      />
      <Text size="xs">{Math.round(100 * fraction)} %</Text>
      <IconButton label={texts.cancel} size={24} onClick={onCancel}>
        <IconX size={14} aria-hidden />
      </IconButton>
    </div>
  );
}

function PreparedFacts({ prepared }: { readonly prepared: PreparedBody }) {
  const { triangles, size, minSize, tolerance, deviation, smallestAngle, meanRadiusRatio } = prepared;
  const { units } = useProject();
  const rows: readonly (readonly [label: string, value: string | undefined, testId?: string])[] = [
    [strings.bodies.triangles, formatCount(triangles.length / 3), "prepared-triangles"],
    [texts.size, size === undefined ? undefined : formatMeasure(size, units)],
    [texts.minSize, minSize === undefined ? undefined : formatMeasure(minSize, units)],
    [texts.tolerance, tolerance === undefined ? undefined : formatMeasure(tolerance, units)],
    [
      texts.deviation,
      deviation === undefined ? undefined : formatMeasure(deviation, units),
      "prepared-deviation",
    ],
    [texts.smallestAngle, smallestAngle === undefined ? undefined : formatAngle(smallestAngle)],
    [texts.meanRatio, meanRadiusRatio?.toFixed(3)],
  ];
  return (
    <Facts>
      {rows.flatMap(([label, value, testId]) =>
        value === undefined
          ? []
          : [
              <dt key={`${label} name`}>
                {label === texts.meanRatio ? (
                  <Explained name={label} meaning={ratioMeanings.triangle} />
                ) : (
                  label
                )}
              </dt>,
              <dd key={label} data-testid={testId}>
                {value}
              </dd>,
            ],
      )}
    </Facts>
  );
}

/** What was dropped, and the warnings about the new triangles. */
function DroppedDetails({
  prepared: { mergedDetails = [], diagnostics },
}: {
  readonly prepared: PreparedBody;
}) {
  return (
    <>
      {mergedDetails.length > 0 && (
        <PositionList
          summary={texts.details(mergedDetails.length)}
          positions={mergedDetails.map(({ onto }, index) => ({
            label: texts.detail(index + 1),
            position: onto,
          }))}
          testId="dropped-details"
        />
      )}
      {diagnostics.map(({ message, severity }) => (
        <Text
          key={message}
          size="xs"
          c={severity === "information" ? "dimmed" : "var(--tf-warning)"}
          mt={4}
          data-testid="prepared-warning"
        >
          {message}
        </Text>
      ))}
    </>
  );
}

/** Selects the triangles that the view shows. */
function ShownTriangles({ hasPreview }: { readonly hasPreview: boolean }) {
  const app = useApp();
  const surface = useView((state) => state.bodySurface);
  const layer = useView((state) => state.layers.mesh);
  const isOfOthers = useMeshOfOthers();
  const hasMesh = useRun(({ mesh }) => !isOfOthers && (mesh?.report.tetrahedra ?? 0) > 0);
  if (!hasPreview && !hasMesh) return null;
  const views = (["given", "new", "mesh"] as const).map((value) => ({
    value,
    label: texts.views[value],
    disabled: (value === "new" && !hasPreview) || (value === "mesh" && !hasMesh),
  }));
  const shown = hasMesh && layer ? "mesh" : hasPreview ? surface : "given";
  return (
    <FieldRow label={texts.shown}>
      <SegmentedControl
        size="xs"
        fullWidth
        aria-label={texts.shown}
        data={views}
        value={shown}
        onChange={(value) => showBodySurface(app, value)}
      />
    </FieldRow>
  );
}
