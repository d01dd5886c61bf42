import { SegmentedControl, Text } from "@mantine/core";
import { useState } from "react";
import { coverModel } from "../../commands/background-actions";
import { DialogButtons } from "../../ui/frames/dialog-buttons";
import { ApplyButton, DialogForm } from "../../ui/frames/dialog-form";
import { FieldRow } from "../../ui/fields/field-row";
import { FramedDialog } from "../../ui/frames/framed-dialog";
import { NumberRow } from "../../ui/fields/number-row";
import { likelySize } from "../../document/extent";
import { strings } from "../../strings";
import { useApp, useProject, useShell } from "../shared/app-context";
import { aboveZero, sizeStep } from "../shared/size-fields";

const texts = strings.background;

/** Creates a background grid around the model. */
export function CoverDialog() {
  const app = useApp();
  const opened = useShell((state) => state.dialog === "cover");
  const close = (): void => app.shell.setState({ dialog: null });
  return (
    <FramedDialog opened={opened} title={texts.cover} onClose={close}>
      <CoverForm onClose={close} />
    </FramedDialog>
  );
}

function CoverForm({ onClose }: { readonly onClose: () => void }) {
  const app = useApp();
  const hasGrid = useProject().background.nodes.length > 0;
  const [shape, setShape] = useState<"box" | "tetrahedron">("box");
  const [size, setSize] = useState(() => {
    const { project } = app.documents;
    return project.meshing?.size ?? likelySize(project);
  });
  return (
    <DialogForm
      onApply={() => {
        onClose();
        void coverModel(app, { size, shape });
      }}
    >
      <Text size="sm" c="dimmed" mb={8}>
        {texts.coverHint}
      </Text>
      <FieldRow label={texts.shape}>
        <SegmentedControl
          size="xs"
          fullWidth
          aria-label={texts.shape}
          data={[
            { value: "box", label: texts.box },
            { value: "tetrahedron", label: texts.tetrahedron },
          ]}
          value={shape}
          onChange={setShape}
        />
      </FieldRow>
      <NumberRow
        label={strings.inspector.size}
        value={size}
        step={sizeStep(size)}
        refuse={aboveZero}
        first
        testId="cover-size"
        onCommit={setSize}
      />
      {hasGrid && (
        <Text size="sm" c="dimmed">
          {texts.replaces}
        </Text>
      )}
      <DialogButtons cancel={texts.cancel} onCancel={onClose}>
        <ApplyButton data-testid="cover-apply">{texts.create}</ApplyButton>
      </DialogButtons>
    </DialogForm>
  );
}
