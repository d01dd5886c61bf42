import type { App } from "../app/app";
import type { EditedSetting } from "../session/shell";
import { drawnKinds, recordsOf, type Entity } from "../document/entities";
import { templates } from "../document/templates";
import {
  entityWords,
  paletteStrings,
  settingNames,
  solvedExampleNames,
  solvedExamples,
  strings,
  templateStrings,
} from "../strings";
import { openExample, openTemplate } from "./project-actions";
import { openSolved } from "./open-solved";
import type { Command } from "./command";
import { commands, runCommand } from "./registry";
import { showEntities } from "./selection-actions";

/** An entry of the command palette. */
export interface PaletteItem {
  readonly id: string;
  readonly group: string;
  readonly label: string;
  /** Other words that find it. */
  readonly words: string;
  /** Its hotkey, in Mantine's notation. */
  readonly hotkey: string | null;
  /** What a disabled command needs; null for entries that can be run. */
  readonly needs: string | null;
  readonly run: () => void;
  /** A text that the user completes: instead of running the entry, the palette stays open with it. */
  readonly begins?: string;
  /** Whether it moves the focus; otherwise the focus returns to where it was before the palette. */
  readonly takesFocus?: boolean;
}

/** Returns every command that is enabled or has a text of what it needs, in the order of the menus. */
function commandItems(app: App): PaletteItem[] {
  return commands
    .map((command) => {
      const isEnabled = command.enabled(app);
      return { command, isEnabled, needs: isEnabled ? null : command.needs(app) };
    })
    .filter(({ isEnabled, needs }) => isEnabled || needs !== null)
    .map(({ command, needs }) => ({
      id: command.id,
      group: strings.menus[command.menu],
      label: labelOf(app, command),
      words: `${command.words} ${strings.submenus[command.menu]?.[command.section] ?? ""}`,
      hotkey: command.keys[0] ?? null,
      needs,
      run: () => runCommand(app, command),
      takesFocus: command.id === "start",
    }));
}

/** Returns the label of a command without its menu: those of layers are nouns. */
const labelOf = (app: App, command: Command): string =>
  command.id.startsWith("layer-") ? paletteStrings.layer(command.label(app)) : command.label(app);

/** Returns whether a setting has a field that gets the focus. */
const isField = (id: string): id is EditedSetting =>
  ["uniform-size", "elements", "gradation", "units"].includes(id);

/** Returns the settings: each opens the panel that has it. The field of a number gets the focus. */
function settingItems(app: App): PaletteItem[] {
  return Object.entries(settingNames).map(([id, { label, words }]) => ({
    id: `setting-${id}`,
    group: paletteStrings.settings,
    label,
    words,
    hotkey: null,
    needs: null,
    takesFocus: isField(id),
    run: () => {
      const rightTab = id === "display" || id === "quality" || id === "solution" ? id : "inspector";
      if (rightTab === "inspector") app.view.clear();
      app.shell.setState({
        rightTab,
        drawer: "right",
        editedSetting: isField(id) ? id : null,
      });
    },
  }));
}

function exampleItems(app: App): PaletteItem[] {
  return app.gallery.models.map((model) => ({
    id: `example-${model.id}`,
    group: paletteStrings.examples,
    label: model.title,
    words: model.id,
    hotkey: null,
    needs: null,
    run: () => void openExample(app, model),
  }));
}

function solvedItems(app: App): PaletteItem[] {
  return solvedExampleNames.map((name) => ({
    id: `solved-${name}`,
    group: paletteStrings.examples,
    label: solvedExamples[name].title,
    words: paletteStrings.solvedWords,
    hotkey: null,
    needs: null,
    run: () => void openSolved(app, name),
  }));
}

function templateItems(app: App): PaletteItem[] {
  return templates.map(({ id, make }) => ({
    id: `template-${id}`,
    group: paletteStrings.templates,
    label: templateStrings.templates[id].title,
    words: templateStrings.title,
    hotkey: null,
    needs: null,
    run: () => openTemplate(app, make()),
  }));
}

/** Returns the entities of the project: by name, or by kind and id. */
function entityItems(app: App): PaletteItem[] {
  const { project } = app.documents;
  return drawnKinds.flatMap((kind) =>
    recordsOf(project, kind).map((record) => {
      const entity: Entity = { kind, id: record.id };
      const title = `${entityWords[kind].one} ${record.id}`;
      const name = "name" in record ? record.name : undefined;
      return {
        id: `entity-${kind}-${record.id}`,
        group: paletteStrings.entities,
        label: name === undefined ? title : `${name} (${title.toLowerCase()})`,
        words: title,
        hotkey: null,
        needs: null,
        run: () => {
          app.shell.setState({ startPage: false });
          showEntities(app, [entity]);
        },
      };
    }),
  );
}

/** Returns entries of another part of the page. A query may hold a number, as in "step 100". */
export type PaletteSource = (app: App, query: string) => readonly PaletteItem[];

const sources: PaletteSource[] = [];

/** Adds entries of another part of the page, before it is shown. */
export function addPaletteItems(source: PaletteSource): void {
  sources.push(source);
}

/** Returns all entries. Disabled commands, entities, examples, settings and those that were added are only found, never listed. */
export function paletteItems(
  app: App,
  query = "",
): { readonly listed: PaletteItem[]; readonly found: PaletteItem[] } {
  const ofCommands = commandItems(app);
  return {
    listed: ofCommands.filter(({ needs }) => needs === null),
    found: [
      ...sources.flatMap((itemsOf) => itemsOf(app, query)),
      ...settingItems(app),
      ...templateItems(app),
      ...exampleItems(app),
      ...solvedItems(app),
      ...entityItems(app),
      ...ofCommands.filter(({ needs }) => needs !== null),
    ],
  };
}
