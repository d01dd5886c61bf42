import { playerOf } from "../../../web/teach/commands/player-of";
import { replayOf } from "../../../web/teach/commands/replay";
// @vitest-environment happy-dom
/** Films of the front: one at a time, and the player pauses however a film ends. */
import type { Mesher } from "tetrafront";
import { afterEach, beforeEach, expect, it, vi } from "vitest";
import { App } from "../../../web/app/app";
import { saveAnimation } from "../../../web/teach/commands/step-pictures";
import { newDocument } from "../../../web/session/document-store";
import type { Viewer } from "../../../web/viewer/viewer";
import { cubeProject } from "../../support/projects";
import { boxSurface } from "../../support/surfaces";
import { starSurface, starTrace } from "../../support/traces";

const { bytes } = starTrace(starSurface(boxSurface(2, [-1, -1, -1], [1, 1, 1])));
const idleMesher = Promise.resolve({} as unknown as Mesher);

const stopTrack = vi.fn();
const made = vi.fn();
let isRefused = false;

/** A recorder that records nothing. */
class Recorder extends EventTarget {
  static isTypeSupported = (): boolean => true;
  state = "inactive";
  constructor() {
    super();
    made();
    if (isRefused) throw new Error("The browser has no encoder");
  }
  start(): void {
    this.state = "recording";
  }
  stop(): void {
    this.state = "inactive";
    this.dispatchEvent(new Event("stop"));
  }
}

let app: App;

beforeEach(async () => {
  vi.stubGlobal(
    "Worker",
    class {
      postMessage(): void {}
    },
  );
  vi.stubGlobal("MediaRecorder", Recorder);
  vi.stubGlobal("requestAnimationFrame", () => 0);
  const paper = document.createElement("canvas");
  Object.assign(paper, {
    getContext: () => ({}),
    captureStream: () => ({ getTracks: () => [{ stop: stopTrack }] }),
  });
  vi.spyOn(document, "createElement").mockReturnValue(paper);
  stopTrack.mockClear();
  made.mockClear();
  isRefused = false;
  app = new App(
    {
      first: { document: newDocument(cubeProject()) },
      mesher: idleMesher,
      previewMesher: idleMesher,
      library: null,
    },
    { gallery: { opening: "", models: [] }, generate: false, still: true, replayOf },
  );
  await playerOf(app).open(bytes);
  playerOf(app).seek(2);
});
afterEach(() => {
  vi.restoreAllMocks();
  vi.unstubAllGlobals();
});

const draws = (drawOn: () => void): void => {
  app.viewer.setState({ viewer: { drawOn } as unknown as Viewer });
};

/** Expects that nothing of a film is left. */
function expectEnded(): void {
  expect(stopTrack).toHaveBeenCalledTimes(1);
  expect(playerOf(app).state.getState()).toMatchObject({ isPlaying: false, step: 2 });
  expect(app.shell.getState().notices).toEqual([]);
}

it("pauses the player and ends the stream if the browser refuses to record", async () => {
  draws(() => undefined);
  isRefused = true;
  await saveAnimation(app);
  expect(app.shell.getState().message?.lines.join()).toContain("no encoder");
  expectEnded();
});

it("pauses the player and ends the stream if a picture fails", async () => {
  draws(() => {
    throw new Error("The context is lost");
  });
  await saveAnimation(app);
  expect(app.shell.getState().message?.lines.join()).toContain("context is lost");
  expectEnded();
});

it("records one film at a time", async () => {
  const drawOn = vi.fn();
  draws(drawOn);
  const first = saveAnimation(app);
  await vi.waitFor(() => expect(drawOn).toHaveBeenCalled());
  await saveAnimation(app);
  expect(made).toHaveBeenCalledTimes(1);
  expect(playerOf(app).state.getState().isPlaying).toBe(true);
  // The film is not saved if its front was closed.
  playerOf(app).close();
  await first;
  expect(made).toHaveBeenCalledTimes(1);
  expect(stopTrack).toHaveBeenCalledTimes(1);
  expect(playerOf(app).state.getState().isPlaying).toBe(false);
});

it("lasts ten seconds and ends with the last step, however long its pictures take", async () => {
  let now = 0;
  vi.spyOn(performance, "now").mockImplementation(() => now);
  vi.spyOn(URL, "createObjectURL").mockReturnValue("blob:film");
  const steps: number[] = [];
  draws(() => {
    steps.push(playerOf(app).state.getState().step);
    now += 3000;
  });
  await saveAnimation(app);
  const last = playerOf(app).state.getState().trace?.stepCount ?? 0;
  // The film begins when the first picture is there: the clock stands still between pictures, so the second is the same.
  expect(steps).toEqual([0, 0, 0.3, 0.6, 0.9, 1].map((share) => Math.round(share * last)));
  expectEnded();
});
