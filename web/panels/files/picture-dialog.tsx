import { Checkbox, SegmentedControl, Stack } from "@mantine/core";
import { useState } from "react";
import type { PictureChoices } from "../../commands/view-picture";
import { pictureStrings as texts } from "../../strings/passing";
import { NumberRow } from "../../ui/fields/number-row";
import { DialogButtons } from "../../ui/frames/dialog-buttons";
import { ApplyButton, DialogForm } from "../../ui/frames/dialog-form";
import { FramedDialog } from "../../ui/frames/framed-dialog";
import {
  isPictureSize,
  maxPicturePixels,
  maxPictureSide,
  type PictureSize,
} from "../../viewer/picture-tiles";
import { useApp, useShell } from "../shared/app-context";

/** Saves a picture of the view in any size. */
export function PictureDialog() {
  const app = useApp();
  const opened = useShell((state) => state.dialog === "picture");
  const close = (): void => app.shell.setState({ dialog: null });
  return (
    <FramedDialog opened={opened} title={texts.title} onClose={close}>
      <PictureForm onClose={close} />
    </FramedDialog>
  );
}

const presets = ["view", "double", "4k", "square"] as const;
type Preset = (typeof presets)[number];

/** Returns the size of each preset for a view of some size, in CSS pixels. */
function sizesFor({ width, height }: PictureSize): Readonly<Record<Preset, PictureSize>> {
  return {
    view: { width, height },
    double: { width: 2 * width, height: 2 * height },
    "4k": { width: 3840, height: 2160 },
    square: { width: 2048, height: 2048 },
  };
}

const usedOptions: Pick<PictureChoices, "isTransparent" | "legend" | "axes"> = {
  isTransparent: false,
  legend: true,
  axes: true,
};

function PictureForm({ onClose }: { readonly onClose: () => void }) {
  const app = useApp();
  const [view] = useState(() => app.viewer.getState().viewer?.size ?? { width: 1280, height: 720 });
  const sizes = sizesFor({ width: Math.round(view.width), height: Math.round(view.height) });
  const [size, setSize] = useState<PictureSize>(sizes.double);
  const [options, setOptions] = useState(usedOptions);
  const preset = presets.find(
    (name) => sizes[name].width === size.width && sizes[name].height === size.height,
  );
  return (
    <DialogForm
      onApply={() => {
        onClose();
        void import("../../commands/view-picture").then(({ saveViewPicture }) =>
          saveViewPicture(app, { ...size, ...options }),
        );
      }}
    >
      <SegmentedControl
        size="xs"
        fullWidth
        mb={8}
        aria-label={texts.size}
        data-testid="image-preset"
        data={[...presets, ...(preset ? [] : ["own" as const])].map((value) => ({
          value,
          label: texts.presets[value],
        }))}
        value={preset ?? "own"}
        onChange={(value) => {
          const chosen = presets.find((name) => name === value);
          if (chosen) setSize(sizes[chosen]);
        }}
      />
      {(["width", "height"] as const).map((side) => (
        <NumberRow
          key={side}
          label={texts[side]}
          value={size[side]}
          step={10}
          refuse={(value) => (isPictureSize({ ...size, [side]: value }) ? null : limits)}
          first={side === "width"}
          rightSection={texts.pixels}
          testId={`image-${side}`}
          onCommit={(value) => setSize((before) => ({ ...before, [side]: value }))}
        />
      ))}
      <Stack gap={6} mt={10}>
        {(["isTransparent", "legend", "axes"] as const).map((option) => (
          <Checkbox
            key={option}
            size="xs"
            label={option === "isTransparent" ? texts.transparent : texts[option]}
            data-testid={option === "isTransparent" ? "image-transparent" : `image-${option}`}
            checked={options[option]}
            onChange={(event) => {
              const { checked } = event.currentTarget;
              setOptions((before) => ({ ...before, [option]: checked }));
            }}
          />
        ))}
      </Stack>
      <DialogButtons cancel={texts.cancel} onCancel={onClose}>
        <ApplyButton data-testid="image-save">{texts.save}</ApplyButton>
      </DialogButtons>
    </DialogForm>
  );
}

const limits = texts.limits(maxPictureSide, maxPicturePixels / 1e6);
