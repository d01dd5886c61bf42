import { Button, Text } from "@mantine/core";
import { IconBrush } from "@tabler/icons-react";
import { useState } from "react";
import type { ProjectBody } from "tetrafront/project";
import { newBrush } from "../../document/brush";
import { NumberRow } from "../../ui/fields/number-row";
import { strings } from "../../strings";
import { useApp, useView } from "../shared/app-context";
import { aboveZero, sizeStep } from "../shared/size-fields";
import styles from "./bodies.module.css";
import { useBody, usePreparation } from "./use-body";

const texts = strings.bodies.brush;

/** The brush that paints an element size on the surface. */
export function BrushSection({ body }: { readonly body: ProjectBody }) {
  const app = useApp();
  const state = useBody(body.id);
  const { preparation } = usePreparation(body);
  const brush = useView((state) => state.brush);
  const [isOpen, setOpen] = useState(false);
  const [chosen, setChosen] = useState<{ readonly size?: number; readonly radius?: number }>({});
  const automatic = newBrush(body, state?.inspection?.box ?? null, preparation?.prepared.size);
  const size = brush?.size ?? chosen.size ?? automatic.size;
  const radius = brush?.radius ?? chosen.radius ?? automatic.radius;
  const set = (change: { readonly size?: number; readonly radius?: number }): void => {
    setChosen((before) => ({ ...before, ...change }));
    if (brush) app.view.setBrush({ ...brush, ...change });
  };
  return (
    <details
      className={styles["options"]}
      data-testid="body-brush"
      open={isOpen || brush !== null}
      onToggle={({ currentTarget }) => setOpen(currentTarget.open)}
    >
      <summary>{texts.title}</summary>
      <NumberRow
        label={texts.size}
        value={size}
        step={sizeStep(size)}
        refuse={aboveZero}
        testId="brush-size"
        onCommit={(next) => set({ size: next })}
      />
      <NumberRow
        label={texts.radius}
        value={radius}
        step={sizeStep(radius)}
        refuse={aboveZero}
        testId="brush-radius"
        onCommit={(next) => set({ radius: next })}
      />
      <Text size="xs" c="dimmed" mb={6}>
        {texts.hint}
      </Text>
      <Button
        size="compact-sm"
        variant={brush ? "filled" : "default"}
        aria-pressed={brush !== null}
        leftSection={<IconBrush size={14} aria-hidden />}
        data-testid="brush-toggle"
        onClick={() => app.view.setBrush(brush ? null : { size, radius })}
      >
        {texts.paint}
      </Button>
    </details>
  );
}
