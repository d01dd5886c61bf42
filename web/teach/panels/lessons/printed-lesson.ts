/** A lesson on paper: its text, the view as it is, its figures and its tasks, without the controls of the page. */
import { useEffect, type RefObject } from "react";
import type { App } from "../../../app/app";
import { playerOf } from "../../commands/player-of";
import { frontSizeAt, phaseAt } from "../../player/phases";
import { playerStrings } from "../../strings/player";
import { lessonStrings as texts } from "../../strings/lessons";
import { viewerColors } from "../../../ui/theme/theme";
import styles from "./print.module.css";

const schemeAttribute = "data-mantine-color-scheme";
/** What has no use on paper. */
const controls = "nav, button, [data-unprinted]";
/** Where the reader ticks or writes an answer. */
const box = "☐";
const line = "________";

/** Prints the lesson instead of the page, as long as it is open, however printing begins. */
export function usePrintedLesson(app: App, heading: RefObject<HTMLElement | null>): void {
  useEffect(() => {
    let undo: (() => void) | null = null;
    const begin = (): void => {
      const page = heading.current?.parentElement;
      if (page) undo ??= addSheet(app, page);
    };
    const end = (): void => {
      undo?.();
      undo = null;
    };
    window.addEventListener("beforeprint", begin);
    window.addEventListener("afterprint", end);
    return () => {
      end();
      window.removeEventListener("beforeprint", begin);
      window.removeEventListener("afterprint", end);
    };
  }, [app, heading]);
}

/** Adds the sheet, which replaces the page when it is printed, in the colours of the light theme. */
function addSheet(app: App, page: HTMLElement): () => void {
  const { documentElement: root, body } = document;
  const scheme = root.getAttribute(schemeAttribute);
  root.setAttribute(schemeAttribute, "light");
  const sheet = document.createElement("div");
  sheet.className = styles["sheet"] ?? "";
  sheet.dataset["testid"] = "printed-lesson";
  sheet.setAttribute("data-print-sheet", "");
  const copy = page.cloneNode(true);
  if (copy instanceof HTMLElement) {
    // The buttons in a table are names of its rows.
    for (const button of copy.querySelectorAll("table button")) button.replaceWith(button.textContent);
    for (const control of copy.querySelectorAll(controls)) control.remove();
    for (const radio of copy.querySelectorAll(".mantine-Radio-inner")) radio.replaceWith(box);
    for (const field of copy.querySelectorAll("input")) field.replaceWith(line);
    sheet.append(...copy.childNodes);
  }
  const picture = pictureOf(app, scheme);
  if (picture) sheet.querySelector("p")?.after(picture);
  const address = new URL(window.location.href);
  address.searchParams.delete("test");
  sheet.append(Object.assign(document.createElement("p"), { textContent: texts.printed(address.href) }));
  body.append(sheet);
  return () => {
    sheet.remove();
    if (scheme !== null) root.setAttribute(schemeAttribute, scheme);
  };
}

/** The view with a caption; null without a view or a front. */
function pictureOf(app: App, scheme: string | null): HTMLElement | null {
  const { viewer } = app.viewer.getState();
  const { trace, step } = playerOf(app).state.getState();
  const canvas = document.createElement("canvas");
  const context = canvas.getContext("2d");
  if (!viewer || !trace || !context) return null;
  // The sheet has the colours of the light theme; the view keeps those of the page.
  viewer.setColors(viewerColors.light);
  viewer.drawOn(context, "#ffffff");
  viewer.setColors(viewerColors[scheme === "light" ? "light" : "dark"]);
  const { phase, from, to } = phaseAt(trace, step);
  const caption = document.createElement("figcaption");
  caption.textContent = playerStrings.scrubText(phase, step - from, to - from, frontSizeAt(trace, step));
  const figure = document.createElement("figure");
  figure.append(canvas, caption);
  return figure;
}
