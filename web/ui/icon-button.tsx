import { ActionIcon, type ActionIconProps } from "@mantine/core";
import type { ComponentPropsWithoutRef } from "react";
import { ButtonTooltip } from "./button-tooltip";

export interface IconButtonProps
  extends ActionIconProps, Omit<ComponentPropsWithoutRef<"button">, keyof ActionIconProps> {
  /** Tooltip, and name for screen readers. */
  readonly label: string;
  readonly "data-testid"?: string;
}

/** A quiet button with an icon only. */
export function IconButton({ label, ...rest }: IconButtonProps) {
  return (
    <ButtonTooltip label={label}>
      <ActionIcon variant="subtle" color="gray" aria-label={label} {...rest} />
    </ButtonTooltip>
  );
}
