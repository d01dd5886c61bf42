import type { App } from "../app/app";
import type { EditedSetting } from "../session/shell";
import { drawnKinds, recordsOf, type Entity } from "../document/entities";
import { templates } from "../document/templates";
import { entityWords, paletteStrings, settingNames, strings, synonyms, templateStrings } from "../strings";
import { shareStrings } from "../teach/strings/share";
import { openExample, openTemplate } from "./project-actions";
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
      words: synonyms[command.id] ?? "",
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
      const rightTab = id === "display" || id === "quality" ? id : "inspector";
      if (rightTab === "inspector") app.view.clear();
      app.shell.setState({
        rightTab,
        drawer: "right",
        editedSetting: isField(id) ? id : null,
      });
    },
  }));
}

const sharing = {
  link: (app: App) => void import("./share-actions").then(({ copyLink }) => copyLink(app)),
  embed: (app: App) => void import("./share-actions").then(({ copyEmbedCode }) => copyEmbedCode(app)),
  picture: (app: App) =>
    void import("../teach/commands/step-pictures").then(({ savePicture }) => savePicture(app)),
  drawing: (app: App) =>
    void import("../teach/commands/step-pictures").then(({ saveDrawing }) => saveDrawing(app)),
  animation: (app: App) =>
    void import("../teach/commands/step-pictures").then(({ saveAnimation }) => saveAnimation(app)),
} as const;

/** Returns what passes on the step of the front that is shown, as in the menu of the player. */
function sharingItems(app: App): PaletteItem[] {
  const hasFront = app.player.state.getState().trace !== null;
  return (Object.keys(sharing) as (keyof typeof sharing)[]).map((id) => ({
    id: `share-step-${id}`,
    group: paletteStrings.front,
    label: shareStrings[id],
    words: paletteStrings.sharing[id],
    hotkey: null,
    needs: hasFront ? null : paletteStrings.needs.front,
    run: () => sharing[id](app),
  }));
}

/** Returns the step of the front whose number a query has, or how to ask for one: "step 100". */
function stepItems(app: App, query: string): PaletteItem[] {
  const { trace } = app.player.state.getState();
  const item = { id: "go-to-step", group: paletteStrings.front, words: "jump frame seek", hotkey: null };
  const { begin, label } = paletteStrings.goToStep;
  const number = /\bstep\s+(\d+)\s*$/i.exec(query)?.[1];
  if (trace === null || number === undefined)
    return [
      {
        ...item,
        label: label(null, trace?.stepCount ?? null),
        needs: trace === null ? paletteStrings.needs.front : null,
        begins: begin,
        run: () => undefined,
      },
    ];
  const step = Number(number);
  if (step > trace.stepCount) return [];
  return [{ ...item, label: label(step, trace.stepCount), needs: null, run: () => app.player.seek(step) }];
}

/**
 * Returns the lessons. Before their titles are known, returns the one whose number a query has: "lesson 10".
 * Throws nothing: an unknown number opens the list of lessons.
 */
function lessonItems(app: App, query: string, titles: readonly (string | null)[] | null): PaletteItem[] {
  const typed = Number(/\blesson\s+(\d+)\s*$/i.exec(query)?.[1] ?? 0);
  const known = titles?.map((title, index) => ({ title, number: index + 1 }));
  const lessons = known?.filter(({ title }) => title !== null) ?? [{ title: null, number: typed }];
  return lessons
    .filter(({ number }) => number > 0)
    .map(({ title, number }) => ({
      id: `lesson-${number}`,
      group: paletteStrings.lessons,
      label: paletteStrings.lesson(number, title),
      words: "",
      hotkey: null,
      needs: null,
      takesFocus: true,
      run: () => {
        app.shell.setState({ startPage: false });
        void import("../teach/commands/lesson-actions").then(({ openLessonNumber }) =>
          openLessonNumber(app, { number, runs: [], step: null }),
        );
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

/**
 * Returns all entries. Disabled commands, entities, examples, lessons and settings are only found, never listed. `query`: may
 * have the number of a step or lesson. `lessons`: their titles, null for one that cannot be read; null before they are loaded.
 */
export function paletteItems(
  app: App,
  query = "",
  lessons: readonly (string | null)[] | null = null,
): { readonly listed: PaletteItem[]; readonly found: PaletteItem[] } {
  const ofCommands = commandItems(app);
  return {
    listed: ofCommands.filter(({ needs }) => needs === null),
    found: [
      ...stepItems(app, query),
      ...settingItems(app),
      ...templateItems(app),
      ...exampleItems(app),
      ...lessonItems(app, query, lessons),
      ...entityItems(app),
      ...ofCommands.filter(({ needs }) => needs !== null),
      ...sharingItems(app),
    ],
  };
}
