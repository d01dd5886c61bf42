import { Button, Group } from "@mantine/core";
import type { ReactNode } from "react";

export interface DialogButtonsProps {
  readonly cancel: string;
  readonly onCancel: () => void;
  /** The button that applies the form. */
  readonly children: ReactNode;
}

/** The last row of a dialog: cancel and apply. */
export function DialogButtons({ cancel, onCancel, children }: DialogButtonsProps) {
  return (
    <Group justify="flex-end" gap="xs" mt={12}>
      <Button size="xs" variant="default" onClick={onCancel}>
        {cancel}
      </Button>
      {children}
    </Group>
  );
}
