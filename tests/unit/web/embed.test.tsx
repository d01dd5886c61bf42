import type { Player } from "../../../web/teach/player/player";
import { playerOf } from "../../../web/teach/commands/player-of";
import { replayOf } from "../../../web/teach/commands/replay";
// @vitest-environment happy-dom
/** The page that shows a front in other pages, without WebGL: its player, its keys and its link. */
import { MantineProvider } from "@mantine/core";
import { createRoot, type Root } from "react-dom/client";
import type { Mesher } from "tetrafront";
import { writeProject, type Project } from "tetrafront/project";
import { afterEach, beforeEach, expect, it, vi } from "vitest";
import { App } from "../../../web/app/app";
import {
  copyEmbedCode,
  copyLink,
  sharedFrontOf,
  showShared,
  showSharedIfOpen,
} from "../../../web/teach/commands/step-links";
import { EmbedPage } from "../../../web/teach/embed/embed-page";
import { newDocument } from "../../../web/session/document-store";
import type { SharedFront } from "../../../web/teach/player/shared-front";
import { cubeProject } from "../../support/projects";
import { boxSurface } from "../../support/surfaces";
import { starSurface, starTrace } from "../../support/traces";
import { SilentWorker } from "../../support/silent-worker";

vi.mock("../../../web/viewer/viewer", () => ({
  Viewer: class {
    constructor() {
      throw new Error("There is no WebGL here");
    }
  },
}));

const { bytes } = starTrace({
  ...starSurface(boxSurface(3, [-1, -1, -1], [1, 1, 1])),
  postponeEvery: 6,
  reopenAfter: 20,
});
const busyMesher = Promise.resolve({
  meshProject: () => new Promise(() => undefined),
  previewProject: () => new Promise(() => undefined),
} as unknown as Mesher);
const shared: SharedFront = {
  model: "cube",
  step: 3,
  order: null,
  coloring: "age",
  faces: "inside",
  elements: "recent",
  candidate: null,
  beat: null,
  camera: null,
};

/** A model of the gallery with the name that the trace has. */
const model: Project = { ...cubeProject(), name: "star" };

let app: App;
let host: HTMLElement;
let root: Root;
const button = (testId: string): HTMLElement | null => host.querySelector(`[data-testid="${testId}"]`);
const until = (check: () => void): Promise<void> => vi.waitFor(check, { timeout: 60_000 });

beforeEach(async () => {
  vi.stubGlobal("Worker", SilentWorker);
  vi.stubGlobal("fetch", () => Promise.resolve(new Response(writeProject(model))));
  app = new App(
    {
      first: { document: newDocument(model) },
      mesher: busyMesher,
      previewMesher: busyMesher,
      library: null,
    },
    {
      gallery: {
        opening: "cube",
        models: [{ id: "cube", title: "star", blurb: "", group: "", file: "" }],
      },
      generate: false,
      still: true,
      replayOf,
    },
  );
  host = document.body.appendChild(document.createElement("div"));
  root = createRoot(host);
  root.render(
    <MantineProvider env="test">
      <EmbedPage app={app} shared={shared} />
    </MantineProvider>,
  );
  await until(() => expect(button("embed")).not.toBeNull());
});
afterEach(() => {
  root.unmount();
  host.remove();
  vi.unstubAllGlobals();
});

it("plays a trace with buttons and keys, and links to the app", async () => {
  expect(host.querySelector('[role="status"]')?.textContent).toContain("Recording");
  await playerOf(app).open(bytes);
  playerOf(app).seek(3);
  await until(() => expect(button("player-forward")).not.toBeNull());
  button("player-forward")?.click();
  expect(playerOf(app).state.getState().step).toBe(4);
  button("viewport-canvas")?.dispatchEvent(
    new KeyboardEvent("keydown", { key: ",", code: "Comma", bubbles: true }),
  );
  await until(() => expect(playerOf(app).state.getState().step).toBe(3));
  expect(host.querySelector("a")?.getAttribute("href")).toBe("./?model=cube&step=3");
  expect(host.querySelector('[role="tab"]')).toBeNull();
});

it("has a link for the step of an unchanged example, and for nothing else", async () => {
  expect(await sharedFrontOf(app)).toBeNull();
  await playerOf(app).open(bytes);
  playerOf(app).seek(7);
  playerOf(app).state.setState({ coloring: "layer" });
  expect(await sharedFrontOf(app)).toMatchObject({ model: "cube", step: 7, coloring: "layer", camera: null });
  const written: string[] = [];
  vi.stubGlobal("navigator", {
    clipboard: { writeText: (text: string) => Promise.resolve(written.push(text)) },
  });
  await copyLink(app);
  expect(written).toEqual([expect.stringMatching(/\?model=cube&step=7&color=layer$/)]);
  app.documents.edit({ label: "Change", replace: { name: "Mine" } });
  expect(await sharedFrontOf(app)).toBeNull();
  // A changed model is in a link of its own, which a dialog offers; a frame shows unchanged examples only.
  await copyLink(app);
  expect(written).toHaveLength(1);
  expect(app.shell.getState().dialog).toBe("share");
  await copyEmbedCode(app);
  expect(app.shell.getState().message?.lines.join()).toContain("unchanged examples");
});

it("has no link for another model with the title of an example", async () => {
  const sphere = { ...model, meshing: { ...model.meshing, size: 0.123 } };
  app.showProject(sphere);
  await playerOf(app).open(bytes);
  expect(await sharedFrontOf(app)).toBeNull();
  // The order of a front is a part of its address.
  app.showProject({ ...model, meshing: { ...model.meshing, order: "first-in" } });
  await playerOf(app).open(bytes);
  expect(await sharedFrontOf(app)).toMatchObject({ model: "cube", order: null });
  // A trace of another model, from a file.
  app.showProject(cubeProject());
  await playerOf(app).open(bytes);
  expect(await sharedFrontOf(app)).toBeNull();
});

it("says why there is no code if the example cannot be loaded", async () => {
  await playerOf(app).open(bytes);
  vi.stubGlobal("fetch", () => Promise.reject(new Error("There is no connection")));
  await copyEmbedCode(app);
  expect(app.shell.getState().message?.lines.join()).toContain("no connection");
});

it("shows the step of an address only if its example is open and unchanged", async () => {
  const record = vi.spyOn(playerOf(app), "record").mockResolvedValue(null);
  const cancel = vi.spyOn(app.run, "cancel");
  app.showProject({ ...cubeProject(), name: "Mine" });
  await showSharedIfOpen(app, shared);
  app.showProject({ ...model, meshing: { ...model.meshing, size: 0.123 } });
  await showSharedIfOpen(app, shared);
  app.showProject(model);
  await showSharedIfOpen(app, { ...shared, model: "other" });
  app.documents.edit({ label: "Change", replace: { name: "Mine" } });
  await showSharedIfOpen(app, shared);
  expect(record).not.toHaveBeenCalled();
  expect(app.shell.getState().bottomTab).not.toBe("front");
  app.documents.undo();
  app.showProject(model);
  cancel.mockClear();
  await showSharedIfOpen(app, { ...shared, order: "random" });
  expect(cancel).toHaveBeenCalledTimes(1);
  expect(record).toHaveBeenCalledWith({ order: "random" });
});

it("says that a step or a candidate of an address does not exist", async () => {
  await playerOf(app).open(bytes);
  const { trace } = playerOf(app).state.getState();
  if (!trace) throw new Error("The trace was not opened");
  const recorded = { kind: "recorded", trace } as Awaited<ReturnType<Player["record"]>>;
  vi.spyOn(playerOf(app), "record").mockResolvedValue(recorded);
  const reported = async (address: Partial<SharedFront>): Promise<string> => {
    app.shell.setState({ notices: [] });
    await showShared(app, { ...shared, ...address });
    return app.shell
      .getState()
      .notices.map(({ text }) => text)
      .join();
  };
  const last = trace.stepCount;
  expect(await reported({ step: last, candidate: null })).toBe("");
  expect(await reported({ step: last + 1 })).toBe(
    `The front has no step ${last + 1}: its states are 0 to ${last}. State ${last} is shown.`,
  );
  expect(await reported({ step: 3, candidate: 99 })).toContain("Step 3 has no candidate 99");
  expect(playerOf(app).state.getState()).toMatchObject({ step: 3, candidate: null });
  // The page has no other place for it.
  await until(() => expect(button("notice-address")?.textContent).toContain("no candidate 99"));
});
