import { Menu } from "@mantine/core";
import { useStore } from "zustand";
import { commandNamed, keyNames, runCommand } from "../../commands/registry";
import { strings } from "../../strings";
import { useApp } from "../shared/app-context";
import styles from "./drawing.module.css";

/** The box or lasso that a drag draws around entities. */
export function SelectionOutline() {
  const app = useApp();
  const outline = useStore(app.drawing.state, (state) => state.outline);
  if (!outline) return null;
  return (
    <svg className={styles["outline"]} aria-hidden>
      <polygon
        points={outline.points.map(({ x, y }) => `${x},${y}`).join(" ")}
        data-touching={outline.touching || undefined}
      />
    </svg>
  );
}

/** The commands of the context menu, in sections. */
const sections = [
  ["fit-selection", "hide", "isolate", "show-all"],
  ["select-all", "select-inverse", "select-same-kind", "select-connected", "select-boundary"],
  ["plane-selection", "split-line", "delete"],
] as const;

/** The menu of the selection, where the right button was clicked. */
export function ContextMenu() {
  const app = useApp();
  const at = useStore(app.drawing.state, (state) => state.menu);
  if (!at) return null;
  return (
    <Menu
      opened
      position="right-start"
      onClose={() => app.drawing.state.setState({ menu: null, menuPosition: null })}
    >
      <Menu.Target>
        <span className={styles["anchor"]} style={{ left: at.x, top: at.y }} />
      </Menu.Target>
      <Menu.Dropdown aria-label={strings.viewport.menu} data-testid="context-menu">
        {sections.map((ids, index) => [
          index > 0 && <Menu.Divider key={index} />,
          ...ids.map((id) => {
            const command = commandNamed(id);
            const [key] = command.keys;
            return (
              <Menu.Item
                key={id}
                disabled={!command.enabled(app)}
                rightSection={key === undefined ? null : keyNames(key).join(" ")}
                onClick={() => runCommand(app, command)}
              >
                {command.label(app)}
              </Menu.Item>
            );
          }),
        ])}
      </Menu.Dropdown>
    </Menu>
  );
}
