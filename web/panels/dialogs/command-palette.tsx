import { Kbd } from "@mantine/core";
import { Spotlight, useSpotlight } from "@mantine/spotlight";
import { IconSearch } from "@tabler/icons-react";
import { useEffect, useRef, useState } from "react";
import { useStore } from "zustand";
import { paletteItems } from "../../commands/palette-items";
import { inGroups, searchPalette } from "../../commands/palette-search";
import { keyNames } from "../../commands/registry";
import { strings } from "../../strings";
import { useApp, useDocument, useRun, useView } from "../shared/app-context";
import styles from "./command-palette.module.css";
import { type EarlyKeys, paletteStore, takeEarlyKeys } from "../shared/palette";

/**
 * The command palette: every command that is enabled; a query also finds entities, examples, templates and settings, and
 * disabled commands with what they need.
 */
export function CommandPalette() {
  const app = useApp();
  // Keep the text here: a palette that is reopened while it closes would keep the old text.
  const [query, setQuery] = useState("");
  const [returnsFocus, setReturnsFocus] = useState(true);
  const [early, setEarly] = useState<EarlyKeys | null>(null);
  const field = useRef<HTMLInputElement>(null);
  const { opened } = useSpotlight(paletteStore);
  useDocument((state) => state.history.past.length + state.history.future.length);
  useRun((state) => state.busy);
  useView((state) => state.selection.length);
  useStore(app.viewer);
  const { listed, found } = opened ? paletteItems(app) : nothing;
  const actions = inGroups(searchPalette(query, listed, found)).map(({ group, items }) => ({
    group,
    actions: items.map(({ id, label, hotkey, needs, run, takesFocus = false }) => ({
      id,
      label,
      ...(needs !== null && {
        description: needs,
        "aria-disabled": true,
        className: styles["disabled"],
        closeSpotlightOnTrigger: false,
      }),
      rightSection: hotkey === null ? null : <Kbd size="xs">{keyNames(hotkey).join(" ")}</Kbd>,
      onClick: () => {
        if (needs !== null) return;
        setReturnsFocus(!takesFocus);
        run();
      },
    })),
  }));
  useEffect(() => {
    // Once the actions for the early text are shown, the first one is selected, as after typing.
    if (early === null) return;
    for (const code of early.isEntered ? ["ArrowDown", "Enter"] : ["ArrowDown"]) {
      field.current?.dispatchEvent(new KeyboardEvent("keydown", { code, bubbles: true }));
    }
  }, [early]);
  return (
    <Spotlight
      store={paletteStore}
      shortcut={null}
      query={query}
      onQueryChange={setQuery}
      // The actions are already filtered.
      filter={(_, given) => given}
      returnFocus={returnsFocus}
      onSpotlightOpen={() => {
        setQuery("");
        setEarly(null);
        setReturnsFocus(true);
      }}
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
        ref: field,
        leftSection: <IconSearch size={16} aria-hidden />,
        placeholder: strings.header.palette,
        "aria-label": strings.header.palette,
        onFocus: () => {
          const keys = takeEarlyKeys();
          if (keys.text === "" && !keys.isEntered) return;
          setQuery(keys.text);
          setEarly(keys);
        },
      }}
    />
  );
}

const nothing = { listed: [], found: [] } as const;
