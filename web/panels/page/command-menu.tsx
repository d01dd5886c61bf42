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
            <CommandItems menu={menu} hasSubmenus />
          </Menubar.Dropdown>
        </Menubar.Menu>
      ))}
    </Menubar>
  );
}

interface CommandItemsProps {
  readonly menu: MenuName;
  /** Show long sections as menus of their own, so that the menu is no taller than the screen. */
  readonly hasSubmenus?: boolean;
}

/** The items of one menu, with dividers between sections. Mounted only while the menu is open. */
export function CommandItems({ menu, hasSubmenus = false }: CommandItemsProps) {
  const app = useApp();
  // Render again whenever a command may have become enabled or checked.
  useDocument((state) => state);
  useView((state) => state);
  useRun((state) => state.busy);
  useStore(app.viewer);
  useStore(app.replay.state, ({ isShown, isRecording }) => isShown || isRecording);
  const items = commands.filter((command) => command.menu === menu && command.inMenu);
  const sections = [...new Set(items.map(({ section }) => section))];
  const labels: Readonly<Record<number, string>> = hasSubmenus ? (strings.submenus[menu] ?? {}) : {};
  return sections.map((section, index) => {
    const label = labels[section];
    const before = sections[index - 1];
    // Submenus follow each other without a divider.
    const isDivided = index > 0 && !(label !== undefined && before !== undefined && labels[before]);
    const own = items.filter((command) => command.section === section);
    return (
      <Fragment key={section}>
        {isDivided && <Menu.Divider />}
        {label === undefined ? <ItemList items={own} /> : <Submenu label={label} items={own} />}
      </Fragment>
    );
  });
}

function ItemList({ items }: { readonly items: readonly Command[] }) {
  return items.map((command) => <CommandItem key={command.id} command={command} />);
}

function Submenu({ label, items }: { readonly label: string; readonly items: readonly Command[] }) {
  return (
    <Menu.Sub>
      <Menu.Sub.Target>
        <Menu.Sub.Item leftSection={<span className={styles["check"]} />}>{label}</Menu.Sub.Item>
      </Menu.Sub.Target>
      <Menu.Sub.Dropdown>
        <ItemList items={items} />
      </Menu.Sub.Dropdown>
    </Menu.Sub>
  );
}

/** Returns the button of the menu in which an element is. */
function menuButtonOf(element: Element | null): HTMLElement | null {
  const menu = element?.closest('[role="menu"]');
  const button = menu && document.getElementById(menu.getAttribute("aria-labelledby") ?? "");
  return button?.closest('[role="menu"]') ? menuButtonOf(button) : (button ?? null);
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
  const run = (): void => {
    // A dialog returns the focus to the element that had it: the item will be gone.
    menuButtonOf(document.activeElement)?.focus({ preventScroll: true });
    runCommand(app, command);
  };
  if (command.checked) {
    return (
      <Menu.CheckboxItem
        {...common}
        checked={command.checked(app)}
        // Layers of the view are often switched one after the other. A tool or a mode is used in the view, below the menu.
        closeMenuOnClick={command.menu !== "view"}
        onChange={run}
      />
    );
  }
  return <Menu.Item {...common} leftSection={<span className={styles["check"]} />} onClick={run} />;
}
