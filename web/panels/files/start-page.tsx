import { Anchor, Button, Checkbox, CloseButton, UnstyledButton } from "@mantine/core";
import {
  IconFileUpload,
  IconPencilPlus,
  IconSchool,
  IconTemperature,
  IconTemplate,
} from "@tabler/icons-react";
import { useCallback, useEffect, useRef, useState, type Ref } from "react";
import { openExample, openRecent } from "../../commands/project-actions";
import { openSolved } from "../../commands/open-solved";
import { runNamed } from "../../commands/registry";
import { thumbnailOf } from "../../session/gallery";
import { startPage } from "../../session/start-page";
import { startStrings as texts } from "../../strings/passing";
import { paletteStrings, solvedExampleNames, solvedExamples, strings } from "../../strings";
import { hasDialog, inputMode } from "../../tools/input-mode";
import { formatTime } from "../../strings/format";
import { SectionTitle } from "../../ui/frames/section-title";
import { useFocusReturn } from "../../ui/use-focus-return";
import { useApp } from "../shared/app-context";
import { TextCommandButton } from "../shared/command-button";
import { isPaletteOpen } from "../shared/palette";
import { DocumentPicture } from "./document-picture";
import { useRecentDocuments } from "./use-recent";
import styles from "./start-page.module.css";

/** Documents and examples that have room; dialogs list all. */
const recentCount = 4;
const exampleCount = 6;

/** Beside the first model: what this is, and how to begin. */
export default function StartPage({ ref }: { readonly ref: Ref<HTMLElement> }) {
  const { shell } = useApp();
  const heading = useRef<HTMLHeadingElement>(null);
  useFocusReturn(true);
  useEffect(() => {
    // From here, Tab leads to what it offers. Who types in a field goes on; the palette, which closes, is a dialog.
    if (inputMode(document.activeElement) !== "field") heading.current?.focus({ preventScroll: true });
  }, []);
  const close = useCallback((): void => shell.setState({ startPage: false }), [shell]);
  useEscape(close);
  return (
    <section ref={ref} className={styles["page"]} aria-labelledby="start-title" data-testid="start-page">
      <div className={styles["head"]}>
        <h2 ref={heading} id="start-title" tabIndex={-1}>
          {texts.title}
        </h2>
        <CloseButton size="sm" aria-label={texts.close} onClick={close} />
      </div>
      <p>{texts.what}</p>
      <p>{texts.promise}</p>
      <Beginnings />
      <Recent />
      <SolvedExamples />
      <Examples />
      <footer className={styles["foot"]}>
        <ShowAgain />
      </footer>
    </section>
  );
}

/** Calls a function on Escape, wherever the focus is on the page: the start page is what lies on top. Dialogs, menus and fields come first. */
function useEscape(onEscape: () => void): void {
  useEffect(() => {
    const life = new AbortController();
    const press = (event: KeyboardEvent): void => {
      const { key, target } = event;
      if (key !== "Escape" || hasDialog() || isPaletteOpen()) return;
      const isInside = target instanceof Element && target.closest('[data-testid="start-page"]') !== null;
      if (!isInside && inputMode(target) !== "view") return;
      event.preventDefault();
      event.stopPropagation();
      onEscape();
    };
    // Before the view, whose selection stays.
    window.addEventListener("keydown", press, { capture: true, signal: life.signal });
    return () => life.abort();
  }, [onEscape]);
}

function Beginnings() {
  const app = useApp();
  const icon = { size: 15, "aria-hidden": true } as const;
  return (
    <>
      {/* Files may be dropped anywhere on the page; this is where it is said. */}
      <UnstyledButton
        className={styles["drop"]}
        data-testid="start-drop"
        onClick={() => runNamed(app, "open")}
      >
        <IconFileUpload size={26} stroke={1.4} aria-hidden />
        <b>{window.matchMedia("(hover: none)").matches ? texts.choose : texts.drop}</b>
        <span>{texts.dropHint}</span>
      </UnstyledButton>
      <div className={styles["row"]}>
        <TextCommandButton command="new" size="compact-sm" leftSection={<IconPencilPlus {...icon} />}>
          {texts.empty}
        </TextCommandButton>
        <TextCommandButton command="new-template" size="compact-sm" leftSection={<IconTemplate {...icon} />}>
          {texts.templates}
        </TextCommandButton>
        <TextCommandButton command="lessons" size="compact-sm" leftSection={<IconSchool {...icon} />}>
          {texts.lessons}
        </TextCommandButton>
      </div>
    </>
  );
}

function Recent() {
  const app = useApp();
  const { documents } = useRecentDocuments();
  if (!documents || documents.length === 0) return null;
  return (
    <div>
      <div className={styles["title"]}>
        <SectionTitle>{texts.recent}</SectionTitle>
        {documents.length > recentCount && (
          <Anchor component="button" type="button" size="xs" onClick={() => runNamed(app, "recent")}>
            {texts.all}
          </Anchor>
        )}
      </div>
      <ul className={styles["recent"]}>
        {documents.slice(0, recentCount).map(({ id, name, at, openIn }) => (
          <li key={id}>
            <UnstyledButton
              className={styles["document"]}
              disabled={openIn !== null}
              data-testid={`start-recent-${id}`}
              onClick={() => void openRecent(app, id, name)}
            >
              <DocumentPicture id={id} />
              <span className={styles["name"]}>{name}</span>
              <span className={styles["time"]}>
                {[formatTime(at, Date.now()), openIn && strings.recent.alsoOpenIn[openIn]]
                  .filter(Boolean)
                  .join(", ")}
              </span>
            </UnstyledButton>
          </li>
        ))}
      </ul>
    </div>
  );
}

function Examples() {
  const app = useApp();
  const { models, opening } = app.gallery;
  // The opening model is open already.
  const shown = models.filter(({ id }) => id !== opening).slice(0, exampleCount);
  return (
    <div>
      <div className={styles["title"]}>
        <SectionTitle>{texts.examples}</SectionTitle>
        <Anchor component="button" type="button" size="xs" onClick={() => runNamed(app, "examples")}>
          {texts.all}
        </Anchor>
      </div>
      <ul className={styles["examples"]}>
        {shown.map((model) => (
          <li key={model.id}>
            <UnstyledButton
              className={styles["example"]}
              data-testid={`start-example-${model.id}`}
              onClick={() => void openExample(app, model)}
            >
              <img src={thumbnailOf(model)} alt="" width={240} height={150} loading="lazy" />
              <span>{model.title}</span>
            </UnstyledButton>
          </li>
        ))}
      </ul>
    </div>
  );
}

/** Problems that are solved with one click. */
function SolvedExamples() {
  const app = useApp();
  return (
    <div>
      <SectionTitle>{paletteStrings.solved}</SectionTitle>
      <div className={styles["row"]}>
        {solvedExampleNames.map((name) => (
          <Button
            key={name}
            size="compact-sm"
            variant="default"
            leftSection={<IconTemperature size={15} aria-hidden />}
            data-testid={`start-solved-${name}`}
            onClick={() => void openSolved(app, name)}
          >
            {solvedExamples[name].title}
          </Button>
        ))}
      </div>
    </div>
  );
}

function ShowAgain() {
  const [isWanted, setWanted] = useState(startPage.isWanted);
  return (
    <Checkbox
      size="xs"
      label={texts.showAgain}
      checked={isWanted}
      onChange={({ currentTarget: { checked } }) => {
        startPage.want(checked);
        setWanted(checked);
      }}
    />
  );
}
