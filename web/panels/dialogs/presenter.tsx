import { useEffect, useRef, useState } from "react";
import { strings } from "../../strings";
import { enlarging } from "../../viewer/materials/enlarging";
import { hasDialog, inputMode } from "../../tools/input-mode";
import { useApp, useShell } from "../shared/app-context";
import { isPaletteOpen } from "../shared/palette";
import styles from "./presenter.module.css";

const texts = strings.presenter;

/** Fields in which Escape means nothing: they stay focused after a choice. */
const choices = 'select, input[type="checkbox"]';

/** Factor of what is drawn in the view, about that of the type (base.css). */
const presentedScale = 1.6;

type ClickerKey = "next" | "back" | "play" | "blank";

/** What the buttons of usual clickers send: one step on or back, the start of the show, and a black screen. */
const clickerKeys: ReadonlyMap<string, ClickerKey> = new Map([
  ["PageDown", "next"],
  ["PageUp", "back"],
  ["ArrowRight", "next"],
  ["ArrowDown", "next"],
  ["ArrowLeft", "back"],
  ["ArrowUp", "back"],
  ["F5", "play"],
  ["b", "blank"],
  ["B", "blank"],
  [".", "blank"],
]);

/**
 * Widgets that use arrow keys themselves. The menu bar and toolbars do not: one of their buttons may have been clicked last, for
 * example that of presenter mode.
 */
const arrowWidgets =
  'select, [role="tablist"], [role="radiogroup"], [role="slider"], [role="separator"], [role="tree"], [role="grid"], input[type="radio"]';
/** Texts that scroll up and down. */
const scrolled = '[role="region"], [role="log"]';

/** Returns whether a key of a clicker means something else where it is pressed. */
function isTaken({ key, target }: KeyboardEvent): boolean {
  if (!(target instanceof Element)) return inputMode(target) !== "view";
  if (key.startsWith("Arrow") && target.closest(arrowWidgets)) return true;
  if ((key === "ArrowUp" || key === "ArrowDown") && target.closest(scrolled)) return true;
  // A list or a check box stays focused after a choice.
  return !target.matches(choices) && inputMode(target) !== "view";
}

/** Large type for an audience (base.css), and a laser pointer: its buttons are in the status bar. Escape ends it, unless something else uses the key. */
export function Presenter() {
  const isOn = useShell((state) => state.isPresenting);
  return isOn ? <Presentation /> : null;
}

function Presentation() {
  const app = useApp();
  const hasLaser = useShell((state) => state.hasLaser);
  const [isBlank, setBlank] = useState(false);
  useLargeView();
  useEscape(() => (isBlank ? setBlank(false) : app.shell.setState({ isPresenting: false })));
  useClicker((key) => {
    // Any other key shows the view again.
    setBlank(key === "blank" && !isBlank);
    if (key === "next") app.replay.move(1);
    if (key === "back") app.replay.move(-1);
    if (key === "play") app.replay.toggle();
  });
  return (
    <>
      {hasLaser && <Laser />}
      {isBlank && (
        <div
          role="status"
          aria-label={texts.blank}
          className={styles["blank"]}
          data-testid="presenter-blank"
        />
      )}
    </>
  );
}

/** Large type in the page (base.css), and wide lines and large dots in its views. */
function useLargeView(): void {
  const app = useApp();
  useEffect(() => {
    const { dataset } = document.documentElement;
    const enlarge = (factor: number): void => {
      enlarging.value = factor;
      app.viewer.getState().viewer?.requestFrame();
    };
    dataset["presenter"] = "";
    enlarge(presentedScale);
    return () => {
      delete dataset["presenter"];
      app.shell.setState({ hasLaser: false });
      enlarge(1);
    };
  }, [app]);
}

/** Calls a function for the keys that the clickers of presenters send, unless they are typed into a field or a dialog. */
function useClicker(onKey: (key: ClickerKey) => void): void {
  const app = useApp();
  const latest = useRef(onKey);
  useEffect(() => void (latest.current = onKey));
  useEffect(() => {
    const life = new AbortController();
    const press = (event: KeyboardEvent): void => {
      const { key, ctrlKey, altKey, metaKey, shiftKey } = event;
      const meaning = clickerKeys.get(key);
      // Without a front, arrow keys orbit.
      if (key.startsWith("Arrow") && !app.replay.state.getState().isShown) return;
      if (!meaning || ctrlKey || altKey || metaKey || (shiftKey && key !== "F5")) return;
      if (hasDialog() || isPaletteOpen() || isTaken(event)) return;
      event.preventDefault();
      event.stopPropagation();
      latest.current(meaning);
    };
    // Before the hotkeys, some of which are the same keys, and before a panel scrolls.
    window.addEventListener("keydown", press, { capture: true, signal: life.signal });
    return () => life.abort();
  }, [app]);
}

/** Calls a function when Escape is pressed and nothing else uses it: no menu, dialog, field or command. */
function useEscape(onEscape: () => void): void {
  const latest = useRef(onEscape);
  useEffect(() => void (latest.current = onEscape));
  useEffect(() => {
    const life = new AbortController();
    let isFree = false;
    // Before anything else: a menu that Escape closes is gone when the event has reached the window.
    const note = ({ target }: KeyboardEvent): void => {
      const isChoice = target instanceof Element && target.matches(choices);
      isFree = !hasDialog() && (isChoice || inputMode(target) === "view");
    };
    const end = (event: KeyboardEvent): void => {
      if (event.key !== "Escape" || event.defaultPrevented || !isFree || isPaletteOpen()) return;
      event.preventDefault();
      latest.current();
    };
    window.addEventListener("keydown", note, { capture: true, signal: life.signal });
    window.addEventListener("keydown", end, { signal: life.signal });
    return () => life.abort();
  }, []);
}

/** A red dot at the pointer, above everything else. It takes no clicks. */
function Laser() {
  const dot = useRef<HTMLDivElement>(null);
  useEffect(() => {
    const life = new AbortController();
    const options = { capture: true, passive: true, signal: life.signal };
    const follow = ({ clientX, clientY }: PointerEvent): void => {
      if (!dot.current) return;
      dot.current.hidden = false;
      dot.current.style.translate = `${clientX}px ${clientY}px`;
    };
    const hide = (): void => {
      if (dot.current) dot.current.hidden = true;
    };
    for (const name of ["pointermove", "pointerdown"] as const)
      window.addEventListener(name, follow, options);
    // Not captured: the pointer leaves the elements of the page all the time.
    document.documentElement.addEventListener("pointerleave", hide, { ...options, capture: false });
    return () => life.abort();
  }, []);
  return <div ref={dot} hidden aria-hidden className={styles["laser"]} data-testid="laser" />;
}
