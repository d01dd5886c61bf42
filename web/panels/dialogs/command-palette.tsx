import { Kbd } from "@mantine/core";
import { Spotlight } from "@mantine/spotlight";
import { IconSearch } from "@tabler/icons-react";
import { useState } from "react";
import { useStore } from "zustand";
import { commands, keyNames, runCommand } from "../../commands/registry";
import { strings } from "../../strings";
import { useApp, useDocument, useRun, useView } from "../shared/app-context";
import { paletteStore } from "../shared/palette";

/** Does a label contain all words of a query, in any order? */
function hasWords(label: string, query: string): boolean {
  const text = label.toLowerCase();
  return query
    .toLowerCase()
    .split(/\s+/)
    .every((word) => text.includes(word));
}

/** The command palette: every command that is enabled. */
export function CommandPalette() {
  const app = useApp();
  // Keep the text here: a palette that is reopened while it closes would keep the old text.
  const [query, setQuery] = useState("");
  useDocument((state) => state.history.past.length + state.history.future.length);
  useRun((state) => state.busy);
  useView((state) => state.selection.length);
  useStore(app.viewer);
  const actions = commands
    .filter((command) => command.enabled(app) && hasWords(command.label(app), query))
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
      store={paletteStore}
      shortcut={null}
      query={query}
      onQueryChange={setQuery}
      // The actions are already filtered.
      filter={(_, found) => found}
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
