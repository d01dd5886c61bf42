import { replayOf, teachingSlots } from "../../../web/teach/teach";
// @vitest-environment happy-dom
import { MantineProvider } from "@mantine/core";
import { createRoot, type Root } from "react-dom/client";
import type { Mesher } from "tetrafront";
import { writeProject } from "tetrafront/project";
import { afterEach, beforeEach, expect, it, vi } from "vitest";
import { App } from "../../../web/app/app";
import { commandNamed } from "../../../web/commands/registry";
import { Page } from "../../../web/panels/page/page";
import { listenForPalette } from "../../../web/panels/shared/palette";
import { newDocument } from "../../../web/session/document-store";
import { strings } from "../../../web/strings";
import { cubeProject } from "../../support/projects";
import { SilentWorker } from "../../support/silent-worker";

/**
 * Two apps on one page, as React renders them: a dropped file and a command of the palette reach one app only. Without
 * WebGL, both apps show their panels without a picture.
 */

vi.mock("../../../web/viewer/viewer", () => ({
  Viewer: class {
    constructor() {
      throw new Error("There is no WebGL here");
    }
  },
}));

listenForPalette();

/** A mesher whose previews never end. */
const busyMesher = Promise.resolve({
  previewProject: () => new Promise(() => undefined),
} as unknown as Mesher);

interface PageApp {
  readonly app: App;
  /** The element that the page gives the app. */
  readonly host: HTMLElement;
  readonly root: Root;
}

function open(name: string): PageApp {
  const app = new App(
    {
      first: { document: newDocument({ ...cubeProject(), name }) },
      mesher: busyMesher,
      previewMesher: busyMesher,
      library: null,
    },
    { gallery: { opening: "", models: [] }, generate: false, still: true, replayOf },
  );
  const host = document.body.appendChild(document.createElement("div"));
  const root = createRoot(host);
  root.render(
    <MantineProvider env="test">
      <Page app={app} slots={teachingSlots} />
    </MantineProvider>,
  );
  return { app, host, root };
}

let apps: readonly [PageApp, PageApp];

const projectNames = (): string[] =>
  apps.map(({ app }) => app.documents.state.getState().history.present.project.name);
/** Whether each app shows the edges of the elements. */
const edges = (): boolean[] => apps.map(({ app }) => app.view.state.getState().edges);

/** Waits until a condition of the page holds. Only a hang takes as long as the limit. */
const until = (check: () => void): Promise<void> => vi.waitFor(check, { timeout: 60_000 });

function send(target: EventTarget, event: Event): Event {
  target.dispatchEvent(event);
  return event;
}

/** Works with an app: what the user does next outside both apps belongs to it. */
function use({ host }: PageApp): void {
  send(panelsOf(host), new Event("pointerdown", { bubbles: true }));
}

function panelsOf(host: HTMLElement): HTMLElement {
  const panels = host.querySelector<HTMLElement>('[data-testid="app"]');
  if (!panels) throw new Error("The app is not on the page");
  return panels;
}

/** Returns an event of a file that is dragged over the page. */
function dragged(type: "dragover" | "drop", projectName: string): Event {
  const file = new File([writeProject({ ...cubeProject(), name: projectName })], "dropped.json");
  const event = new Event(type, { bubbles: true, cancelable: true });
  return Object.assign(event, { dataTransfer: { types: ["Files"], files: [file] } });
}

const isInvited = ({ host }: PageApp): boolean => host.textContent.includes(strings.viewport.drop);

beforeEach(async () => {
  vi.stubGlobal("Worker", SilentWorker);
  apps = [open("Left"), open("Right")];
  await until(() => expect(apps.map(({ host }) => panelsOf(host))).toHaveLength(2));
});

afterEach(() => {
  for (const { root, host } of apps) {
    root.unmount();
    host.remove();
  }
  vi.unstubAllGlobals();
});

it("a file opens in the app on which it is dropped", async () => {
  const [, right] = apps;
  const over = send(panelsOf(right.host), dragged("dragover", "Dropped"));
  expect(over.defaultPrevented).toBe(true);
  await until(() => expect(apps.map(isInvited)).toEqual([false, true]));
  send(panelsOf(right.host), dragged("drop", "Dropped"));
  await until(() => expect(projectNames()).toEqual(["Left", "Dropped"]));
  await until(() => expect(apps.map(isInvited)).toEqual([false, false]));
});

it("a file that is dropped beside both apps opens in the app used last", async () => {
  send(document.body, dragged("drop", "First"));
  await until(() => expect(projectNames()).toEqual(["First", "Right"]));
  use(apps[1]);
  send(document.body, dragged("drop", "Second"));
  await until(() => expect(projectNames()).toEqual(["First", "Second"]));
});

it("the palette opens once and runs its commands in the app used last", async () => {
  const [left, right] = apps;
  await runInPalette(right);
  expect(edges()).toEqual([true, false]);
  await runInPalette(left);
  expect(edges()).toEqual([false, false]);
});

/** Works with an app, opens the palette and runs its command that shows or hides the edges. */
async function runInPalette(app: PageApp): Promise<void> {
  use(app);
  send(document.body, new KeyboardEvent("keydown", { key: "k", ctrlKey: true, bubbles: true }));
  await until(() => expect(edgeCommands()).toHaveLength(1));
  edgeCommands()[0]?.click();
  await until(() => expect(edgeCommands()).toEqual([]));
}

/** The entries of open palettes that show or hide the edges. */
const edgeCommands = (): HTMLElement[] =>
  [...document.querySelectorAll<HTMLElement>("[data-action]")].filter((entry) =>
    entry.textContent.startsWith(commandNamed("edges").label(apps[0].app)),
  );
