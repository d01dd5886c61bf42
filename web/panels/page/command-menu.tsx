import { Kbd, Menu, Menubar } from "@mantine/core";
import { Fragment } from "react";
import { useStore } from "zustand";
import type { Command, MenuName } from "../../commands/command";
import { commands, keyNames, runCommand } from "../../commands/registry";
import { strings } from "../../strings";
import { useApp, useDocument, useRun, useView } from "../shared/app-context";
import styles from "./command-menu.module.css";

export const menuNames: readonly MenuName[] = ["file", "edit", "create", "view", "mesh", "help"];

/** The menus of the header, from the registry of commands. */
export function CommandMenubar() {
  return (
    <Menubar className={styles["menubar"]} aria-label={strings.header.menu}>
      {menuNames.map((menu) => (
        <Menubar.Menu key={menu}>
          <Menubar.Target className={styles["target"]}>{strings.menus[menu]}</Menubar.Target>
          <Menubar.Dropdown>
            <CommandItems menu={menu} />
          </Menubar.Dropdown>
        </Menubar.Menu>
      ))}
    </Menubar>
  );
}

/** The items of one menu, with dividers between sections. Mounted only while the menu is open. */
export function CommandItems({ menu }: { readonly menu: MenuName }) {
  const app = useApp();
  // Render again whenever a command may have become enabled or checked.
  useDocument((state) => state);
  useView((state) => state);
  useRun((state) => state.busy);
  useStore(app.viewer);
  useStore(app.player.state, ({ trace, recording }) => trace !== null || recording !== null);
  const items = commands.filter((command) => command.menu === menu);
  return items.map((command, index) => (
    <Fragment key={command.id}>
      {index > 0 && items[index - 1]?.section !== command.section && <Menu.Divider />}
      <CommandItem command={command} />
    </Fragment>
  ));
}

function CommandItem({ command }: { readonly command: Command }) {
  const app = useApp();
  const [key] = command.keys;
  const keys = key !== undefined && (
    <span className={styles["keys"]}>
      {keyNames(key).map((name) => (
        <Kbd key={name} size="xs">
          {name}
        </Kbd>
      ))}
    </span>
  );
  const common = { disabled: !command.enabled(app), rightSection: keys, children: command.label(app) };
  const run = (): void => runCommand(app, command);
  if (command.checked) {
    return <Menu.CheckboxItem {...common} checked={command.checked(app)} onChange={run} />;
  }
  return <Menu.Item {...common} leftSection={<span className={styles["check"]} />} onClick={run} />;
}
