import { Button, Group, Radio, SegmentedControl, Select, Text } from "@mantine/core";
import { useState } from "react";
import { LENGTH_UNITS, type ElementOrder, type LengthUnit } from "tetrafront";
import { downloadMesh } from "../../commands/download-actions";
import {
  encodingsOf,
  exportFormats,
  extensionIn,
  type Encoding,
  type ExportFormat,
} from "../../document/export-formats";
import { unitOf } from "../../document/length-units";
import { fileStem } from "../../session/files";
import { strings } from "../../strings";
import { Facts } from "../../ui/facts";
import { ApplyButton, DialogForm } from "../../ui/frames/dialog-form";
import { FramedDialog } from "../../ui/frames/framed-dialog";
import { SectionTitle } from "../../ui/frames/section-title";
import { FieldRow } from "../../ui/fields/field-row";
import { useApp, useProject, useShell } from "../shared/app-context";
import { TextCommandButton } from "../shared/command-button";
import styles from "./export-dialog.module.css";

const texts = strings.export;
const contents = ["volume", "boundary"] as const;

/** What the user has chosen. What a format does not have stays chosen for the next one. */
interface Choice {
  readonly format: ExportFormat;
  readonly order: ElementOrder;
  readonly encoding: Encoding;
  /** Null: the unit of the project. */
  readonly unit: LengthUnit | null;
}

/** Saves the mesh in a file of another program: the format, and what it keeps. */
export function ExportDialog() {
  const app = useApp();
  const opened = useShell((state) => state.dialog === "export");
  const [choice, setChoice] = useState<Choice>(firstChoice);
  const { name, units } = useProject();
  const onClose = (): void => app.shell.setState({ dialog: null });
  const set = (change: Partial<Choice>): void => setChoice((before) => ({ ...before, ...change }));
  const { format, encoding, unit } = choice;
  const own = unitOf(units);
  const elementOrder = format.hasSecondOrder ? choice.order : 1;
  const extension = extensionIn(format, encoding);
  const apply = (): void => {
    onClose();
    void downloadMesh(app, extension, { elementOrder, unit: own && unit ? unit : null });
  };
  return (
    <FramedDialog opened={opened} size="lg" title={texts.title} onClose={onClose}>
      <DialogForm onApply={apply}>
        <div className={styles["columns"]}>
          <FormatChoice format={format} onChange={(chosen) => set({ format: chosen })} />
          <div>
            <OrderChoice {...choice} order={elementOrder} onChange={(order) => set({ order })} />
            <EncodingChoice {...choice} onChange={(chosen) => set({ encoding: chosen })} />
            <UnitChoice own={own ?? null} unit={unit} onChange={(chosen) => set({ unit: chosen })} />
            <KeptFacts format={format} order={elementOrder} />
            <Text size="sm" className={styles["file"]} data-testid="export-file">
              {texts.file}: <strong>{`${fileStem(name)}.${extension}`}</strong>
            </Text>
          </div>
        </div>
        <Group justify="flex-end" gap="xs" mt="md" className={styles["actions"]}>
          <TextCommandButton command="download-report" size="xs" variant="subtle" mr="auto">
            {texts.report}
          </TextCommandButton>
          <Button size="xs" variant="default" onClick={onClose}>
            {texts.cancel}
          </Button>
          <ApplyButton data-testid="export-apply">{texts.apply}</ApplyButton>
        </Group>
      </DialogForm>
    </FramedDialog>
  );
}

const [firstFormat] = exportFormats;

function firstChoice(): Choice {
  if (!firstFormat) throw new Error("There is no format");
  return { format: firstFormat, order: 1, encoding: "binary", unit: null };
}

interface FormatChoiceProps {
  readonly format: ExportFormat;
  readonly onChange: (format: ExportFormat) => void;
}

function FormatChoice({ format, onChange }: FormatChoiceProps) {
  return (
    <Radio.Group
      aria-label={texts.format}
      value={format.id}
      className={styles["formats"]}
      onChange={(id) => {
        const chosen = exportFormats.find((other) => other.id === id);
        if (chosen) onChange(chosen);
      }}
    >
      {contents.map((content) => (
        <section key={content} aria-label={texts.groups[content]}>
          <SectionTitle>{texts.groups[content]}</SectionTitle>
          {exportFormats
            .filter((other) => other.content === content)
            .map(({ id, extensions }) => (
              <Radio
                key={id}
                size="xs"
                value={id}
                className={styles["format"]}
                data-testid={`export-format-${id}`}
                data-autofocus={id === format.id || undefined}
                label={`${texts.formats[id] ?? id} .${Object.values(extensions).join(", .")}`}
              />
            ))}
        </section>
      ))}
    </Radio.Group>
  );
}

interface OrderChoiceProps {
  readonly format: ExportFormat;
  readonly order: ElementOrder;
  readonly onChange: (order: ElementOrder) => void;
}

function OrderChoice({ format, order, onChange }: OrderChoiceProps) {
  return (
    <FieldRow label={texts.order} hint={format.hasSecondOrder ? null : texts.orderHint}>
      <SegmentedControl
        size="xs"
        fullWidth
        aria-label={texts.order}
        data={[
          { value: "1", label: texts.orders[1] },
          { value: "2", label: texts.orders[2], disabled: !format.hasSecondOrder },
        ]}
        value={String(order)}
        onChange={(value) => onChange(value === "2" ? 2 : 1)}
      />
    </FieldRow>
  );
}

interface EncodingChoiceProps {
  readonly format: ExportFormat;
  readonly encoding: Encoding;
  readonly onChange: (encoding: Encoding) => void;
}

function EncodingChoice({ format, encoding, onChange }: EncodingChoiceProps) {
  const possible = encodingsOf(format);
  const [only, other] = possible;
  const reason = only && !other ? texts.onlyEncoding[only] : null;
  return (
    <FieldRow label={texts.encoding} hint={reason}>
      <SegmentedControl<Encoding>
        size="xs"
        fullWidth
        aria-label={texts.encoding}
        data-testid="export-encoding"
        data={(["text", "binary"] as const).map((value) => ({
          value,
          label: texts.encodings[value],
          disabled: !possible.includes(value),
        }))}
        value={possible.includes(encoding) ? encoding : (possible[0] ?? encoding)}
        onChange={onChange}
      />
    </FieldRow>
  );
}

interface UnitChoiceProps {
  /** The unit of the project; null if it has none. */
  readonly own: LengthUnit | null;
  readonly unit: LengthUnit | null;
  readonly onChange: (unit: LengthUnit | null) => void;
}

function UnitChoice({ own, unit, onChange }: UnitChoiceProps) {
  const others = LENGTH_UNITS.filter((other) => other !== own);
  return (
    <>
      <FieldRow label={texts.units}>
        <Select
          size="xs"
          aria-label={texts.units}
          data-testid="export-unit"
          allowDeselect={false}
          disabled={own === null}
          data={[
            { value: "own", label: texts.asDrawn(own && strings.units[own]) },
            ...others.map((other) => ({ value: other, label: strings.units[other] })),
          ]}
          value={own === null ? "own" : (unit ?? "own")}
          onChange={(chosen) => onChange(others.find((other) => other === chosen) ?? null)}
        />
      </FieldRow>
      {own === null && (
        <Text size="xs" c="dimmed">
          {texts.noUnits}
        </Text>
      )}
    </>
  );
}

function KeptFacts({ format, order }: { readonly format: ExportFormat; readonly order: ElementOrder }) {
  return (
    <section aria-label={texts.keeps} data-testid="export-keeps">
      <SectionTitle>{texts.keeps}</SectionTitle>
      <Facts>
        <dt>{texts.elements}</dt>
        <dd>{`${texts.contents[format.content]}, ${texts.orders[order].toLowerCase()}`}</dd>
        <dt>{texts.patches}</dt>
        <dd>{texts.kept[format.patches]}</dd>
        <dt>{texts.regions}</dt>
        <dd>{texts.kept[format.regions]}</dd>
        <dt>{texts.coordinates}</dt>
        <dd>{texts.digits[format.coordinates]}</dd>
      </Facts>
    </section>
  );
}
