import {
  ActionIcon,
  Button,
  Kbd,
  Menu,
  Toolbar,
  useComputedColorScheme,
  useMantineColorScheme,
} from "@mantine/core";
import {
  IconArrowBackUp,
  IconArrowForwardUp,
  IconChevronDown,
  IconChevronUp,
  IconDownload,
  IconFocusCentered,
  IconMenu2,
  IconMoon,
  IconPhoto,
  IconPlayerPlayFilled,
  IconPlayerStopFilled,
  IconScissors,
  IconSearch,
  IconShare,
  IconSun,
} from "@tabler/icons-react";
import { Fragment, useState } from "react";
import { useStore } from "zustand";
import type { MenuName } from "../../commands/command";
import { hasTetrahedra } from "../../commands/conditions";
import { runNamed } from "../../commands/registry";
import { IconButton } from "../../ui/icon-button";
import { Logo } from "../../ui/logo";
import { strings } from "../../strings";
import { useApp, useDocument, useRun, useView } from "../shared/app-context";
import { CommandButton } from "../shared/command-button";
import { CommandItems, CommandMenubar, menuNames } from "./command-menu";
import { palette } from "../shared/palette";
import type { Layout } from "../shared/use-layout";
import menuStyles from "./command-menu.module.css";
import styles from "./header.module.css";

const icon = { size: 17, "aria-hidden": true } as const;

/** Name, menus, frequent commands, palette, download, theme, and the primary button. */
export function Header({ layout }: { readonly layout: Layout }) {
  const phone = layout === "phone";
  const hasPast = useDocument((state) => state.history.past.length > 0);
  const canTakeBack = useStore(useApp().drawing.state, (state) => state.canTakeBack);
  const canUndo = hasPast || canTakeBack;
  const canRedo = useDocument((state) => state.history.future.length > 0);
  const cut = useView((state) => state.cut.enabled);
  const hasView = useStore(useApp().viewer, ({ viewer }) => viewer !== null);
  return (
    <header className={styles["header"]} data-presented>
      <span className={styles["brand"]}>
        <Logo />
        <h1>{strings.appName}</h1>
      </span>
      {phone ? <PhoneMenu /> : <CommandMenubar />}
      <Toolbar aria-label={strings.header.tools} className={styles["toolbar"]}>
        <CommandButton command="undo" disabled={!canUndo} testId="undo">
          <IconArrowBackUp {...icon} />
        </CommandButton>
        <CommandButton command="redo" disabled={!canRedo} testId="redo">
          <IconArrowForwardUp {...icon} />
        </CommandButton>
        {!phone && (
          <CommandButton command="fit" testId="fit">
            <IconFocusCentered {...icon} />
          </CommandButton>
        )}
        {!phone && (
          <CommandButton command="cut" pressed={cut} testId="cut-button">
            <IconScissors {...icon} />
          </CommandButton>
        )}
      </Toolbar>
      {!phone && <PaletteBox />}
      <span className={styles["end"]}>
        {/* Without room they are in the menu only. */}
        {layout === "wide" && (
          <>
            <CommandButton command="share" testId="share-link">
              <IconShare {...icon} />
            </CommandButton>
            <CommandButton command="picture" disabled={!hasView} testId="export-image">
              <IconPhoto {...icon} />
            </CommandButton>
          </>
        )}
        <ExportButton />
        <SchemeToggle />
        <GenerateButton compact={phone} />
      </span>
    </header>
  );
}

function PaletteBox() {
  return (
    <button type="button" className={styles["palette"]} data-testid="palette" onClick={() => palette.open()}>
      <IconSearch size={14} aria-hidden />
      <span>{strings.header.palette}</span>
      <Kbd size="xs">Ctrl K</Kbd>
    </button>
  );
}

/** The palette and all menus in one. Menus unfold in place, one at a time, because a phone has no room beside them. */
function PhoneMenu() {
  const [open, setOpen] = useState<MenuName | null>(null);
  return (
    <Menu position="bottom-start" width={280} onClose={() => setOpen(null)}>
      <Menu.Target>
        <ActionIcon size={32} variant="subtle" color="gray" aria-label={strings.header.menu}>
          <IconMenu2 size={18} aria-hidden />
        </ActionIcon>
      </Menu.Target>
      <Menu.Dropdown className={menuStyles["phone"]}>
        <Menu.Item rightSection={<IconSearch {...icon} />} onClick={() => palette.open()}>
          {strings.header.palette}
        </Menu.Item>
        {menuNames.map((menu) => (
          <Fragment key={menu}>
            <Menu.Item
              aria-expanded={open === menu}
              closeMenuOnClick={false}
              rightSection={open === menu ? <IconChevronUp {...icon} /> : <IconChevronDown {...icon} />}
              onClick={() => setOpen(open === menu ? null : menu)}
            >
              {strings.menus[menu]}
            </Menu.Item>
            {open === menu && (
              <div role="group" aria-label={strings.menus[menu]}>
                <CommandItems menu={menu} />
              </div>
            )}
          </Fragment>
        ))}
      </Menu.Dropdown>
    </Menu>
  );
}

function ExportButton() {
  const hasMesh = useRun(hasTetrahedra);
  return (
    <CommandButton command="export" disabled={!hasMesh} testId="download">
      <IconDownload {...icon} />
    </CommandButton>
  );
}

function SchemeToggle() {
  const { setColorScheme } = useMantineColorScheme({ keepTransitions: true });
  const dark = useComputedColorScheme("dark", { getInitialValueInEffect: false }) === "dark";
  const label = dark ? strings.header.light : strings.header.dark;
  return (
    <IconButton
      label={label}
      size={28}
      data-testid="theme"
      onClick={() => setColorScheme(dark ? "light" : "dark")}
    >
      {dark ? <IconSun {...icon} /> : <IconMoon {...icon} />}
    </IconButton>
  );
}

/** Meshes the model. While a run is active, the same place cancels it: the user need not look for another button. */
function GenerateButton({ compact }: { readonly compact: boolean }) {
  const app = useApp();
  const busy = useRun((state) => state.busy);
  const task = useRun((state) => state.task);
  const cancelling = useRun((state) => state.cancelling);
  const common = {
    size: "compact-md",
    h: 30,
    px: compact ? 10 : 14,
    fz: "sm",
    // The texts have different widths, but the header must not move when a run begins.
    miw: compact ? 104 : 144,
  } as const;
  if (busy) {
    return (
      <Button
        {...common}
        // The same element would keep a press that begins on the one and ends on the other button.
        key="cancel"
        color="red"
        variant="light"
        leftSection={<IconPlayerStopFilled size={13} aria-hidden />}
        aria-label={strings.status.cancel[task]}
        data-testid="cancel-run"
        disabled={cancelling}
        // The second press of a double click was meant for the other button.
        onClick={({ detail }) => detail < 2 && runNamed(app, "cancel")}
      >
        {cancelling ? strings.status.cancelling[task] : strings.header.cancel[task]}
      </Button>
    );
  }
  return (
    <Button
      {...common}
      key="generate"
      leftSection={<IconPlayerPlayFilled size={13} aria-hidden />}
      data-testid="generate"
      onClick={() => runNamed(app, "generate")}
    >
      {compact ? strings.header.generateShort : strings.header.generate}
    </Button>
  );
}
