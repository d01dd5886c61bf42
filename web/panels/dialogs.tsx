import { Button, Kbd, List, Text } from "@mantine/core";
import { Spotlight } from "@mantine/spotlight";
import { IconSearch } from "@tabler/icons-react";
import { useState } from "react";
import { useStore } from "zustand";
import { commands, keyNames, runCommand } from "../commands";
import { SectionTitle } from "../ui/field-row";
import { FramedDialog } from "../ui/framed-dialog";
import { strings } from "../ui/strings";
import { useApp, useDocument, useRun, useShell, useView } from "./app-context";

/** The command palette: every command that may run now. */
export function CommandPalette() {
  const app = useApp();
  // Held here, for a palette opened again before it has quite closed would keep the old text.
  const [query, setQuery] = useState("");
  useDocument((state) => state.history.past.length + state.history.future.length);
  useRun((state) => state.busy);
  useView((state) => state.selection.length);
  useStore(app.viewer);
  const actions = commands
    .filter((command) => command.enabled(app))
    .map((command) => ({
      id: command.id,
      group: strings.menus[command.menu],
      label: command.label(app),
      rightSection:
        command.keys[0] === undefined ? null : <Kbd size="xs">{keyNames(command.keys[0]).join(" ")}</Kbd>,
      onClick: () => runCommand(app, command),
    }));
  const groups = Object.values(strings.menus).map((group) => ({
    group,
    actions: actions.filter((action) => action.group === group),
  }));
  return (
    <Spotlight
      shortcut="mod+K"
      query={query}
      onQueryChange={setQuery}
      onSpotlightOpen={() => setQuery("")}
      tagsToIgnore={[]}
      actions={groups.filter((group) => group.actions.length > 0)}
      nothingFound={strings.header.paletteEmpty}
      highlightQuery
      overlayProps={{ blur: 0, backgroundOpacity: 0.5 }}
      attributes={{ content: { "aria-label": strings.header.palette } }}
      scrollAreaProps={{ viewportProps: { tabIndex: 0 } }}
      scrollable
      maxHeight={420}
      searchProps={{
        leftSection: <IconSearch size={16} aria-hidden />,
        placeholder: strings.header.palette,
        "aria-label": strings.header.palette,
      }}
    />
  );
}

/** Keys and mouse, from the same registry as everything else. */
export function HelpDialog() {
  const app = useApp();
  const opened = useShell((state) => state.dialog === "help");
  const keyed = commands.filter(({ keys }) => keys.length > 0);
  return (
    <FramedDialog
      opened={opened}
      size="lg"
      title={strings.help.title}
      onClose={() => app.shell.setState({ dialog: null })}
    >
      <div className="tf-help">
        <dl>
          {[...strings.help.mouse, ...strings.help.fields].map(([what, effect]) => (
            <div key={what}>
              <dt>{what}</dt>
              <dd>{effect}</dd>
            </div>
          ))}
        </dl>
        <dl>
          {keyed.map((command) => (
            <div key={command.id}>
              <dt>
                {command.keys.map((key) => (
                  <Kbd key={key} size="xs">
                    {keyNames(key).join(" ")}
                  </Kbd>
                ))}
              </dt>
              <dd>{command.label(app)}</dd>
            </div>
          ))}
        </dl>
      </div>
      <SectionTitle>{strings.appName}</SectionTitle>
      <Text size="sm" c="dimmed">
        {strings.help.about}
      </Text>
    </FramedDialog>
  );
}

/** What went wrong and is said nowhere else on the page. */
export function MessageDialog() {
  const app = useApp();
  const message = useShell((state) => state.message);
  const close = (): void => app.shell.setState({ message: null });
  return (
    <FramedDialog opened={message !== null} title={message?.title} onClose={close}>
      <List size="sm" spacing={4} data-testid="message">
        {message?.lines.map((line) => (
          <List.Item key={line}>{line}</List.Item>
        ))}
      </List>
      <Button mt="md" onClick={close} data-autofocus>
        {strings.messages.close}
      </Button>
    </FramedDialog>
  );
}
