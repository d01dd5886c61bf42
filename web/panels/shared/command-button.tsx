import { ActionIcon, Button, type ButtonProps } from "@mantine/core";
import type { ReactNode } from "react";
import { commandNamed, keyNames, runCommand } from "../../commands/registry";
import { ButtonTooltip } from "../../ui/button-tooltip";
import { useApp, useDocument } from "./app-context";

export interface CommandButtonProps {
  /** Id of the command. */
  readonly command: string;
  readonly disabled?: boolean;
  /** State of a command that toggles something. */
  readonly pressed?: boolean;
  readonly testId?: string;
  readonly children: ReactNode;
}

/** An icon that runs a command. Its tooltip has the name and the hotkey of the command. */
export function CommandButton({ command: id, disabled, pressed, testId, children }: CommandButtonProps) {
  const app = useApp();
  const command = commandNamed(id);
  // The labels of undo and redo contain the name of the step.
  useDocument((state) => state.history);
  const label = command.label(app);
  const [key] = command.keys;
  return (
    <ButtonTooltip label={key === undefined ? label : `${label} (${keyNames(key).join(" ")})`}>
      <ActionIcon
        size={28}
        variant={pressed ? "light" : "subtle"}
        color={pressed ? "blue" : "gray"}
        aria-label={label}
        aria-pressed={pressed}
        disabled={disabled ?? false}
        data-testid={testId}
        onClick={() => runCommand(app, command)}
      >
        {children}
      </ActionIcon>
    </ButtonTooltip>
  );
}

export interface TextCommandButtonProps extends Omit<ButtonProps, "onClick"> {
  /** Id of the command. */
  readonly command: string;
  readonly testId?: string;
  /** The label of the command, if it is missing. */
  readonly children?: ReactNode;
}

/** A small button with a text that runs a command. */
export function TextCommandButton({ command: id, testId, children, ...props }: TextCommandButtonProps) {
  const app = useApp();
  const command = commandNamed(id);
  return (
    <Button
      size="compact-xs"
      variant="default"
      {...props}
      data-testid={testId}
      onClick={() => runCommand(app, command)}
    >
      {children ?? command.label(app)}
    </Button>
  );
}
