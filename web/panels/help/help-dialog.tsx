import { Anchor, Kbd, Loader, Text, TextInput, UnstyledButton } from "@mantine/core";
import { IconSearch } from "@tabler/icons-react";
import libraryLicense from "occt-import-js/dist/license.occt-import-js.txt?url";
import openCascadeLicense from "occt-import-js/dist/license.occt.txt?url";
import { lazy, Suspense, useState } from "react";
import type { App } from "../../app/app";
import type { Command } from "../../commands/command";
import { commands, keyNames } from "../../commands/registry";
import type { HelpSection } from "../../document/help-search";
import { SectionTitle } from "../../ui/frames/section-title";
import { FramedDialog } from "../../ui/frames/framed-dialog";
import { strings, synonyms } from "../../strings";
import { useApp, useShell } from "../shared/app-context";
import { PanelBoundary } from "../shared/panel-boundary";
import type { HelpPlace } from "./help-document";
import styles from "./help-dialog.module.css";

const texts = strings.help;

const load = () => import("./help-document");
const HelpDocument = lazy(load);
const HelpResults = lazy(async () => ({ default: (await load()).HelpResults }));

/** Id of the page of keys and mouse actions, beside those of the documents. */
const keysPage = "keys";
const keysPlace: HelpPlace = { document: keysPage, heading: null };

/** The help: keys and mouse actions, and the documents of the project. A search finds sections of all of them. */
export function HelpDialog() {
  const app = useApp();
  const opened = useShell((state) => state.dialog === "help");
  const [place, setPlace] = useState<HelpPlace>(keysPlace);
  const [query, setQuery] = useState("");
  const open = (next: HelpPlace): void => {
    setQuery("");
    setPlace(next);
  };
  const close = (): void => {
    app.shell.setState({ dialog: null });
    open(keysPlace);
  };
  const isSearch = query.trim() !== "";
  const title = isSearch ? texts.search : (texts.documents[place.document] ?? texts.title);
  return (
    <FramedDialog opened={opened} size="xl" title={title} onClose={close}>
      <TextInput
        size="sm"
        mb="sm"
        data-autofocus
        aria-label={texts.search}
        placeholder={texts.search}
        leftSection={<IconSearch size={15} aria-hidden />}
        data-testid="help-search"
        value={query}
        onChange={(event) => setQuery(event.currentTarget.value)}
      />
      <div className={styles["pages"]}>
        <PageList
          current={isSearch ? null : place.document}
          onOpen={(document) => open({ document, heading: null })}
        />
        <div className={styles["page"]}>
          <PanelBoundary>
            <Suspense fallback={<Loader size="sm" />}>
              {isSearch ? (
                <HelpResults query={query} keys={keySections(app)} onOpen={open} />
              ) : place.document === keysPage ? (
                <KeysPage />
              ) : (
                <HelpDocument place={place} onOpen={open} />
              )}
            </Suspense>
          </PanelBoundary>
        </div>
      </div>
    </FramedDialog>
  );
}

interface PageListProps {
  /** Id of the page that is shown; null for the results of a search. */
  readonly current: string | null;
  readonly onOpen: (document: string) => void;
}

function PageList({ current, onOpen }: PageListProps) {
  return (
    <nav aria-label={texts.contents} className={styles["list"]}>
      {[keysPage, ...Object.keys(texts.documents)].map((id) => (
        <UnstyledButton
          key={id}
          className={styles["entry"]}
          aria-current={id === current ? "page" : undefined}
          data-testid={`help-page-${id}`}
          onClick={() => onOpen(id)}
        >
          {texts.documents[id] ?? texts.title}
        </UnstyledButton>
      ))}
    </nav>
  );
}

const actions = [...texts.mouse, ...texts.fields];
const keyedCommands = commands.filter(({ keys }) => keys.length > 0);

/** Returns the commands with their menus and keys, and the mouse actions, as sections for the search. */
export const keySections = (app: App): readonly HelpSection[] =>
  [
    { title: texts.title, text: texts.keys, words: synonyms["help"] ?? "" },
    ...commands
      .filter(({ inMenu, keys }) => inMenu || keys.length > 0)
      .map((command) => ({ title: command.label(app), text: placeOf(command), words: command.words })),
    ...actions.map(([title, text]) => ({ title, text, words: "" })),
  ].map(({ title, text, words }, index) => ({
    document: keysPage,
    index,
    title,
    text: `${title}\n${text}`,
    words,
  }));

/** Returns the keys of a command, and its menu. */
const placeOf = ({ inMenu, keys, menu }: Command): string =>
  [
    ...keys.map((key) => keyNames(key).join(" ")),
    ...(inMenu ? [texts.inMenu(strings.menus[menu])] : []),
  ].join(", ");

/** All keys and mouse actions; those of commands come from the registry. */
function KeysPage() {
  const app = useApp();
  return (
    <>
      <div className={styles["columns"]}>
        <dl>
          {actions.map(([what, effect]) => (
            <div key={what}>
              <dt>{what}</dt>
              <dd>{effect}</dd>
            </div>
          ))}
        </dl>
        <dl>
          {keyedCommands.map((command) => (
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
      <About />
    </>
  );
}

function About() {
  return (
    <>
      <SectionTitle>{strings.appName}</SectionTitle>
      <Text size="sm" c="dimmed">
        {texts.about}
      </Text>
      <Text size="sm" c="dimmed">
        {texts.cadLibrary}{" "}
        <Anchor href={openCascadeLicense} target="_blank">
          OpenCascade
        </Anchor>
        {", "}
        <Anchor href={libraryLicense} target="_blank">
          occt-import-js
        </Anchor>
        {", "}
        <Anchor href="./THIRD-PARTY-NOTICES.txt" target="_blank">
          replicad-opencascadejs
        </Anchor>
        {"."}
      </Text>
      <Text size="sm" c="dimmed" mt={4}>
        <Anchor href="./LICENSE.txt" target="_blank">
          {texts.license}
        </Anchor>
        {", "}
        <Anchor href="./THIRD-PARTY-NOTICES.txt" target="_blank" data-testid="notices">
          {texts.notices}
        </Anchor>
      </Text>
    </>
  );
}
