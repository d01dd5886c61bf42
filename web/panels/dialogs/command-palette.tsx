import { Kbd } from "@mantine/core";
import { Spotlight, useSpotlight } from "@mantine/spotlight";
import { IconSearch } from "@tabler/icons-react";
import { useEffect, useState } from "react";
import { useStore } from "zustand";
import { paletteItems } from "../../commands/palette-items";
import { inGroups, searchPalette } from "../../commands/palette-search";
import { keyNames } from "../../commands/registry";
import { strings } from "../../strings";
import { useApp, useDocument, useRun, useView } from "../shared/app-context";
import styles from "./command-palette.module.css";
import { paletteStore, paletteText } from "../shared/palette";

/**
 * The command palette: every command that is enabled; a query also finds entities, examples, templates and settings, and
 * disabled commands with what they need.
 */
export function CommandPalette() {
  const app = useApp();
  const query = useStore(paletteText, (state) => state.query);
  const [returnsFocus, setReturnsFocus] = useState(true);
  const [field, setField] = useState<HTMLInputElement | null>(null);
  const { opened } = useSpotlight(paletteStore);
  useDocument((state) => state.history.past.length + state.history.future.length);
  useRun((state) => state.busy);
  useView((state) => state.selection.length);
  useStore(app.viewer);
  const { listed, found } = opened ? paletteItems(app, query) : nothing;
  const actions = inGroups(searchPalette(query, listed, found)).map(({ group, items }) => ({
    group,
    actions: items.map(({ id, label, hotkey, needs, run, begins, takesFocus = false }) => ({
      id,
      label,
      ...(needs !== null && {
        description: needs,
        "aria-disabled": true,
        className: styles["disabled"],
        closeSpotlightOnTrigger: false,
      }),
      ...(begins !== undefined && { closeSpotlightOnTrigger: false }),
      rightSection: hotkey === null ? null : <Kbd size="xs">{keyNames(hotkey).join(" ")}</Kbd>,
      onClick: () => {
        if (needs !== null) return;
        if (begins !== undefined) {
          paletteText.setState({ query: begins });
          field?.focus();
          return;
        }
        setReturnsFocus(!takesFocus);
        run();
      },
    })),
  }));
  useKeptKeys(field);
  return (
    <Spotlight
      store={paletteStore}
      shortcut={null}
      query={query}
      onQueryChange={(text) => paletteText.setState({ query: text })}
      // A palette that is opened while it closes has a new text already.
      clearQueryOnClose={false}
      // The actions are already filtered.
      filter={(_, given) => given}
      returnFocus={returnsFocus}
      onSpotlightOpen={() => setReturnsFocus(true)}
      tagsToIgnore={[]}
      actions={actions}
      nothingFound={strings.header.paletteEmpty}
      highlightQuery
      overlayProps={{ blur: 0, backgroundOpacity: 0.5 }}
      attributes={{ content: { "aria-label": strings.header.palette, "data-palette": true } }}
      scrollAreaProps={{ viewportProps: { tabIndex: 0 } }}
      scrollable
      maxHeight={420}
      searchProps={{
        ref: setField,
        leftSection: <IconSearch size={16} aria-hidden />,
        placeholder: strings.header.palette,
        "aria-label": strings.header.palette,
      }}
    />
  );
}

/** Selects the first action for keys that the field did not get, as after typing, and runs it if Enter was among them. */
function useKeptKeys(field: HTMLInputElement | null): void {
  const keptKeys = useStore(paletteText, (state) => state.keptKeys);
  const isEntered = useStore(paletteText, (state) => state.isEntered);
  useEffect(() => {
    if (field === null || keptKeys === 0) return;
    paletteStore.updateState((state) => ({ ...state, selected: -1 }));
    // The codes are those that the field of Mantine listens for.
    for (const code of isEntered ? ["ArrowDown", "Enter"] : ["ArrowDown"]) {
      field.dispatchEvent(new KeyboardEvent("keydown", { code, bubbles: true }));
    }
    if (isEntered) paletteText.setState({ isEntered: false });
  }, [field, keptKeys, isEntered]);
}

const nothing = { listed: [], found: [] } as const;
