import { ActionIcon, Tooltip, type ActionIconProps } from "@mantine/core";
import type { ComponentPropsWithoutRef } from "react";

export interface IconButtonProps
  extends ActionIconProps, Omit<ComponentPropsWithoutRef<"button">, keyof ActionIconProps> {
  /** Tooltip, and name for screen readers. */
  readonly label: string;
  readonly "data-testid"?: string;
}

/** A quiet button with an icon only. */
export function IconButton({ label, ...rest }: IconButtonProps) {
  return (
    <Tooltip label={label} openDelay={400}>
      <ActionIcon variant="subtle" color="gray" aria-label={label} {...rest} />
    </Tooltip>
  );
}
