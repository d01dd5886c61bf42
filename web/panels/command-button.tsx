import { ActionIcon, Tooltip } from "@mantine/core";
import type { ReactNode } from "react";
import { commandNamed, keyNames, runCommand } from "../commands/registry";
import { useApp, useDocument } from "./app-context";

export interface CommandButtonProps {
  /** Id in the registry. */
  readonly command: string;
  readonly disabled?: boolean;
  /** For commands that switch something. */
  readonly pressed?: boolean;
  readonly testId?: string;
  readonly children: ReactNode;
}

/** An icon that runs a command; its tooltip tells name and hotkey. */
export function CommandButton({ command: id, disabled, pressed, testId, children }: CommandButtonProps) {
  const app = useApp();
  const command = commandNamed(id);
  // Undo and redo tell what they would do.
  useDocument((state) => state.history);
  const label = command.label(app);
  const [key] = command.keys;
  return (
    <Tooltip label={key === undefined ? label : `${label} (${keyNames(key).join(" ")})`} openDelay={400}>
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
    </Tooltip>
  );
}
