import { Button, SegmentedControl, Text } from "@mantine/core";
import type { BodyPlacement, ProjectBody } from "tetrafront/project";
import { setPlacement } from "../../document/body-edits";
import { expressionOf, keepingExpression } from "../../document/expression-edits";
import { anglesOf, noRotation, rotationOf } from "../../document/placement";
import type { Position } from "../../document/position";
import { FieldRow } from "../../ui/fields/field-row";
import { NumberRow } from "../../ui/fields/number-row";
import { PositionRow } from "../../ui/fields/position-row";
import { strings } from "../../strings";
import { positionExpressions } from "../shared/kept-expressions";
import { useApp, useProject, useView } from "../shared/app-context";
import { aboveZero } from "../shared/size-fields";
import styles from "./bodies.module.css";
import { useBody } from "./use-body";

const texts = strings.bodies.placement;

/** Steps of the fields: degrees, and a factor. */
const angleStep = 5;
const scaleStep = 0.1;

const withAxis = (values: Position, axis: 0 | 1 | 2, value: number): Position => {
  const next: [number, number, number] = [...values];
  next[axis] = value;
  return next;
};

/** Where a body is. */
export function BodyPlacementFields({ body }: { readonly body: ProjectBody }) {
  const app = useApp();
  const project = useProject();
  const box = useBody(body.id)?.inspection?.box;
  const { position = [0, 0, 0], rotation = noRotation, scale = 1 } = body.placement ?? {};
  const angles = anglesOf(rotation);
  const extent = box ? Math.max(...box.high.map((high, k) => high - (box.low[k] ?? 0))) : 1;
  const path = (field: string) => ({ kind: "body", id: body.id, field: `placement.${field}` }) as const;
  const edit = (change: BodyPlacement, key: string) =>
    setPlacement(body.id, { position, rotation, scale, ...change }, key);
  const setNumber = (change: BodyPlacement, field: string, expression: string | null): void =>
    app.documents.edit(keepingExpression(edit(change, field), path(field), expression));
  return (
    <details className={styles["options"]} data-testid="body-placement">
      <summary>{texts.title}</summary>
      <HandleControl body={body.id} />
      <PositionRow
        label={texts.position}
        value={position}
        step={10 ** Math.round(Math.log10(extent / 20))}
        testId="placement-position"
        expressions={positionExpressions(project, path("position"))}
        onCommit={(axis, value, expression) =>
          setNumber({ position: withAxis(position, axis, value) }, `position.${axis}`, expression)
        }
      />
      <PositionRow
        label={texts.rotation}
        value={angles}
        step={angleStep}
        testId="placement-rotation"
        onCommit={(axis, value) =>
          app.documents.edit(
            edit({ rotation: rotationOf(withAxis(angles, axis, value)) }, `rotation-${axis}`),
          )
        }
      />
      <NumberRow
        label={texts.scale}
        value={scale}
        step={scaleStep}
        refuse={aboveZero}
        testId="placement-scale"
        expression={expressionOf(project, path("scale"))}
        onCommit={(value, expression) => setNumber({ scale: value }, "scale", expression)}
      />
      <Text size="xs" c="dimmed" mb={6}>
        {texts.hint}
      </Text>
      <Button
        size="compact-xs"
        variant="default"
        disabled={body.placement === undefined}
        onClick={() => app.documents.edit(setPlacement(body.id, {}))}
      >
        {texts.reset}
      </Button>
    </details>
  );
}

const modes = ["off", "translate", "rotate"] as const;

/** Shows handles in the view that move or rotate the body. */
function HandleControl({ body }: { readonly body: number }) {
  const app = useApp();
  const moving = useView((state) => state.moving);
  return (
    <FieldRow label={texts.handles}>
      <SegmentedControl
        size="xs"
        fullWidth
        aria-label={texts.handles}
        data={modes.map((value) => ({ value, label: texts.modes[value] }))}
        value={moving?.body === body ? moving.mode : "off"}
        onChange={(mode) => app.view.setMoving(mode === "off" ? null : { body, mode })}
      />
    </FieldRow>
  );
}
