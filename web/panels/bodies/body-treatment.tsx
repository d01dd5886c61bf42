import { SegmentedControl, Text } from "@mantine/core";
import { IconRotate } from "@tabler/icons-react";
import { REMESH_DEFAULTS } from "tetrafront";
import { BODY_SURFACES, type BodyRemeshing, type ProjectBody } from "tetrafront/project";
import { setBodySurface, setRemeshing } from "../../document/body-edits";
import { expressionOf, keepingExpression } from "../../document/expression-edits";
import { isSolid } from "../../document/operations/solids";
import { FieldRow } from "../../ui/fields/field-row";
import { NumberField } from "../../ui/fields/number-field";
import { SectionTitle } from "../../ui/frames/section-title";
import { IconButton } from "../../ui/icon-button";
import { strings } from "../../strings";
import { ElementCount } from "../shared/element-count";
import { useApp, useProject } from "../shared/app-context";
import { aboveZero, featureAngle, notNegative, sizeStep } from "../shared/size-fields";
import styles from "./bodies.module.css";
import { useBody, usePreparation } from "./use-body";

const texts = strings.bodies.treatment;

type Field = keyof BodyRemeshing;

const fields: readonly Field[] = [
  "size",
  "minSize",
  "maxSize",
  "tolerance",
  "featureAngle",
  "anglePerEdge",
  "layers",
  "dropDetails",
  "growth",
];

const refuseLayers = (value: number): string | null =>
  value >= 0 && value <= 100 ? null : texts.invalidLayers;

const refusals: { readonly [F in Field]: (value: number) => string | null } = {
  size: aboveZero,
  minSize: aboveZero,
  maxSize: aboveZero,
  tolerance: aboveZero,
  featureAngle,
  anglePerEdge: featureAngle,
  layers: refuseLayers,
  dropDetails: notNegative,
  growth: notNegative,
};

/** What meshing does with the given triangles: remesh, refine or keep them; and the options of remeshing. */
export function BodyTreatment({ body }: { readonly body: ProjectBody }) {
  const app = useApp();
  const surface = body.surface ?? "remesh";
  return (
    <section data-testid="body-treatment">
      <SectionTitle>{isSolid(body) ? texts.ofSolid : texts.title}</SectionTitle>
      {!isSolid(body) && (
        <SegmentedControl
          size="xs"
          fullWidth
          aria-label={texts.label}
          data={BODY_SURFACES.map((value) => ({ value, label: texts.values[value] }))}
          value={surface}
          onChange={(value) => app.documents.edit(setBodySurface(body.id, value))}
        />
      )}
      <Text size="xs" c="dimmed" my={4}>
        {isSolid(body) ? texts.hintOfSolid : texts.hints[surface]}
      </Text>
      {surface !== "keep" && (
        <>
          <RemeshingField body={body} field="size" />
          <ElementCount />
        </>
      )}
      {surface === "remesh" && (
        <details className={styles["options"]} data-testid="remeshing-options">
          <summary>{texts.options}</summary>
          {fields.slice(1).map((field) => (
            <RemeshingField key={field} body={body} field={field} />
          ))}
        </details>
      )}
    </section>
  );
}

interface RemeshingFieldProps {
  readonly body: ProjectBody;
  readonly field: Field;
}

/** An option of remeshing. While it is automatic, the field shows the value that the last preview has used. */
function RemeshingField({ body, field }: RemeshingFieldProps) {
  const app = useApp();
  const project = useProject();
  const used = useAutomaticValues(body)[field];
  const set = body.remeshing?.[field];
  const value = set ?? used;
  const path = { kind: "body", id: body.id, field: `remeshing.${field}` } as const;
  const commit = (next: number | null, expression: string | null = null): void =>
    app.documents.edit(keepingExpression(setRemeshing(body.id, field, next), path, expression));
  return (
    <FieldRow label={texts.fields[field]}>
      <div className={styles["automatic"]} title={texts.hintOf[field]}>
        <NumberField
          key={set === undefined ? "automatic" : "set"}
          label={texts.fields[field]}
          value={set ?? Number(used.toPrecision(4))}
          step={field === "layers" ? 1 : sizeStep(value)}
          refuse={refusals[field]}
          testId={`remeshing-${field}`}
          expression={expressionOf(project, path)}
          onCommit={commit}
        />
        {set === undefined ? (
          <Text size="xs" c="dimmed" component="span">
            {texts.automatic}
          </Text>
        ) : (
          <IconButton
            label={texts.reset(texts.fields[field])}
            size={24}
            data-testid={`remeshing-${field}-reset`}
            onClick={() => commit(null)}
          >
            <IconRotate size={14} aria-hidden />
          </IconButton>
        )}
      </div>
    </FieldRow>
  );
}

/** Defaults of the package, as shares of the diagonal and of a given size. */
const defaults = {
  size: 1 / 15,
  minSize: { diagonal: 1 / 150, size: 1 / 10 },
  tolerance: { automatic: 1 / 250, diagonal: 1 / 700, size: 1 / 20 },
  anglePerEdge: { automatic: 36, size: 60 },
  growth: 0.3,
} as const;

/** Returns the values of options that the user has not set: what the last preview has chosen, else the defaults. */
function useAutomaticValues(body: ProjectBody): { readonly [F in Field]: number } {
  const { preparation } = usePreparation(body);
  const { box, edgeLengths } = useBody(body.id)?.inspection ?? {};
  const extents = box ? box.high.map((high, k) => high - (box.low[k] ?? 0)) : [];
  const scale = body.placement?.scale ?? 1;
  const diagonal = scale * Math.hypot(...extents);
  const prepared = preparation?.prepared;
  const given = body.remeshing?.size;
  const { minSize, tolerance, anglePerEdge } = defaults;
  // Without a size, most triangles that are refined stay as they are.
  const kept = body.surface === "refine" ? edgeLengths : undefined;
  const size = kept ? scale * kept.longest : (prepared?.size ?? defaults.size * diagonal);
  return {
    size,
    minSize: prepared?.minSize ?? (given === undefined ? minSize.diagonal * diagonal : minSize.size * given),
    maxSize: size,
    tolerance:
      prepared?.tolerance ??
      (given === undefined
        ? tolerance.automatic * diagonal
        : Math.min(tolerance.diagonal * diagonal, tolerance.size * given)),
    featureAngle: REMESH_DEFAULTS.featureAngle,
    anglePerEdge: given === undefined ? anglePerEdge.automatic : anglePerEdge.size,
    layers: given === undefined ? 1 : 0,
    dropDetails: 0,
    growth: defaults.growth,
  };
}
