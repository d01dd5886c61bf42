import { ActionIcon, Toolbar } from "@mantine/core";
import {
  IconArrowsMove,
  IconCube,
  IconFocusCentered,
  IconCylinder,
  IconLine,
  IconPoint,
  IconPointer,
  IconRulerMeasure,
  IconSphere,
  IconPyramid,
  IconTriangle,
  type Icon,
} from "@tabler/icons-react";
import { commandNamed, hasCommand, keyNames, runNamed } from "../../commands/registry";
import type { Command } from "../../commands/command";
import { toolNames, type ToolName } from "../../document/tools";
import { strings } from "../../strings";
import { ButtonTooltip } from "../../ui/button-tooltip";
import { useApp, useView } from "../shared/app-context";
import styles from "./tool-column.module.css";

const toolIcons: Readonly<Record<ToolName, Icon>> = {
  select: IconPointer,
  point: IconPoint,
  line: IconLine,
  patch: IconTriangle,
  node: IconPyramid,
  source: IconFocusCentered,
  move: IconArrowsMove,
  measure: IconRulerMeasure,
};

/** Commands that create a whole piece, and their icons. */
const pieces: readonly (readonly [command: string, Icon: Icon])[] = [
  ["create-box", IconCube],
  ["create-cylinder", IconCylinder],
  ["create-sphere", IconSphere],
];

/** The tools of the view, and commands that create pieces, one below the other. */
export function ToolColumn() {
  const app = useApp();
  const active = useView(({ tool, brush, moving }) => (brush || moving ? null : tool));
  const defined = pieces.filter(([id]) => hasCommand(id));
  return (
    <Toolbar aria-label={strings.viewport.tools} orientation="vertical" className={styles["column"]}>
      {toolNames.map((tool) => (
        <ToolButton
          key={tool}
          command={commandNamed(`tool-${tool}`)}
          Icon={toolIcons[tool]}
          pressed={active === tool}
          onClick={() => app.view.setTool(tool)}
        />
      ))}
      {defined.length > 0 && <hr className={styles["divider"]} aria-hidden />}
      {defined.map(([id, Icon]) => (
        <ToolButton key={id} command={commandNamed(id)} Icon={Icon} onClick={() => runNamed(app, id)} />
      ))}
    </Toolbar>
  );
}

interface ToolButtonProps {
  readonly command: Command;
  readonly Icon: Icon;
  /** Undefined if the button does not take a tool. */
  readonly pressed?: boolean;
  readonly onClick: () => void;
}

function ToolButton({ command, Icon, pressed, onClick }: ToolButtonProps) {
  const app = useApp();
  const label = command.label(app);
  const [key] = command.keys;
  return (
    <ButtonTooltip
      label={key === undefined ? label : `${label} (${keyNames(key).join(" ")})`}
      position="right"
    >
      <ActionIcon
        className={styles["button"]}
        variant={pressed ? "light" : "subtle"}
        color={pressed ? "blue" : "gray"}
        aria-label={label}
        aria-pressed={pressed}
        data-testid={command.id}
        onClick={onClick}
      >
        <Icon size={18} aria-hidden />
      </ActionIcon>
    </ButtonTooltip>
  );
}
