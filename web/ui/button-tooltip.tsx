import { Tooltip, type TooltipProps } from "@mantine/core";
import { useState } from "react";

/**
 * The tooltip of a button. It disappears when the button is pressed, until the pointer comes back: it would cover what the
 * button opens.
 */
export function ButtonTooltip({ children, ...rest }: TooltipProps) {
  const [isPressed, setPressed] = useState(false);
  return (
    <Tooltip
      openDelay={400}
      {...rest}
      {...(isPressed && { opened: false })}
      onPointerDown={() => setPressed(true)}
      onPointerEnter={() => setPressed(false)}
    >
      {children}
    </Tooltip>
  );
}
