import { openLessonOf } from "../../../web/teach/commands/open-lesson";
import { playerOf } from "../../../web/teach/commands/player-of";
import { replayOf } from "../../../web/teach/commands/replay";
/** The runs of a lesson: always of its own model. */
import { readFileSync } from "node:fs";
import type { MeshReport, Mesher } from "tetrafront";
import { writeProject, type Project } from "tetrafront/project";
import { readTrace } from "tetrafront/trace";
import { afterEach, beforeEach, expect, it, vi } from "vitest";
import { App } from "../../../web/app/app";
import {
  closeLesson,
  compareRun,
  lessonRuns,
  openLesson,
  openLessonNumber,
  showLessonModel,
  showStep,
} from "../../../web/teach/commands/lesson-actions";
import { commandNamed, commandOfKey, runCommand } from "../../../web/commands/registry";
import { moveEntity, renameProject } from "../../../web/document/edits";
import type { Lesson } from "../../../web/teach/lessons/lesson";
import { showOwnRun } from "../../../web/teach/lessons/own-run";
import { newDocument } from "../../../web/session/document-store";
import { cubeProject } from "../../support/projects";
import { boxSurface } from "../../support/surfaces";
import { starSurface, starTrace } from "../../support/traces";
import { SilentWorker } from "../../support/silent-worker";

const { bytes } = starTrace(starSurface(boxSurface(2, [-1, -1, -1], [1, 1, 1])));
const idleMesher = Promise.resolve({
  meshProject: () => new Promise(() => undefined),
  previewProject: () => new Promise(() => undefined),
} as unknown as Mesher);

const lesson: Lesson = {
  id: "order",
  title: "The order",
  model: "cube",
  order: "layered",
  step: 1,
  coloring: "age",
  figure: [],
  paper: "3",
  tasks: [{ kind: "compare", ask: "Compare.", order: "first-in" }],
  text: "A text.",
};
const cube: Project = { ...cubeProject(), name: "Cube" };

let app: App;
/** Names and first points of the models that were recorded. */
let recorded: { readonly name: string; readonly x: number | undefined }[];

beforeEach(() => {
  vi.stubGlobal("Worker", SilentWorker);
  vi.stubGlobal("document", { baseURI: "https://example.org/" });
  vi.stubGlobal("fetch", () => Promise.resolve(new Response(writeProject(cube))));
  app = new App(
    {
      first: { document: newDocument({ ...cubeProject(), name: "Mine" }) },
      mesher: idleMesher,
      previewMesher: idleMesher,
      library: null,
    },
    {
      gallery: {
        opening: "cube",
        models: [{ id: "cube", title: "Cube", blurb: "", group: "", file: "cube.json" }],
      },
      generate: false,
      still: true,
      replayOf,
    },
  );
  recorded = [];
  vi.spyOn(playerOf(app), "record").mockImplementation(() => {
    const { name, points } = app.documents.project;
    recorded.push({ name, x: points[0]?.position[0] });
    const trace = readTrace(bytes);
    if (!trace.success) throw new Error(trace.errors[0].message);
    playerOf(app).show(trace.value, bytes);
    return Promise.resolve({
      kind: "recorded",
      trace: trace.value,
      file: bytes,
      report: {} as unknown as MeshReport,
      isStopped: false,
    });
  });
});
it("runs the model in the orders of an address, and shows the lesson's own run", async () => {
  await showLessonModel(app, lesson, ["random", "layered", "first-in"]);
  const { runs } = lessonRuns(app).getState();
  expect(runs.map(({ order }) => order)).toEqual(["layered", "random", "first-in"]);
  expect(playerOf(app).state.getState().trace).toBe(runs[0]?.trace);
  expect(openLessonOf(app).getState().runs).toEqual(["random", "first-in"]);
  await compareRun(app, "smallest-first");
  expect(openLessonOf(app).getState().runs).toEqual(["random", "first-in", "smallest-first"]);
  await showLessonModel(app, lesson);
  expect(openLessonOf(app).getState().runs).toEqual([]);
});

it("keeps the model of a lesson as the reader has changed it when the page is loaded again", async () => {
  vi.stubGlobal("fetch", (address: URL) =>
    Promise.resolve(
      new Response(
        /index\.json$/.test(String(address))
          ? JSON.stringify(["order.md"])
          : /\.md$/.test(String(address))
            ? readFileSync("public/lessons/front.md", "utf8")
            : writeProject(cube),
      ),
    ),
  );
  const address = { number: 1, runs: [], step: null };
  await openLessonNumber(app, address);
  closeLesson(app);
  app.documents.edit(renameProject("Changed"));
  const changed = app.documents.state.getState();
  expect(changed.lesson).toBe(1);
  // As the page begins after it was loaded again.
  await app.showAgain(changed);
  await openLessonNumber(app, address);
  expect(app.documents.project.name).toBe("Changed");
  expect(app.documents.state.getState().id).toBe(changed.id);
  expect(openLessonOf(app).getState().number).toBe(1);
  expect(lessonRuns(app).getState().isPreparing).toBe(false);
  // The page of the lesson brings its own model back.
  const { lesson: opened } = lessonRuns(app).getState();
  if (opened) await showLessonModel(app, opened);
  expect(app.documents.project.name).not.toBe("Changed");
  // The model of another lesson is opened over one that was not changed.
  app.documents.show({ ...newDocument({ ...cubeProject(), name: "Other" }), lesson: 1 });
  await openLessonNumber(app, address);
  expect(app.documents.project.name).toBe("Cube");
});

it("says how many steps the front has if an address names another one", async () => {
  await showLessonModel(app, lesson);
  const { stepCount = 0 } = playerOf(app).state.getState().trace ?? {};
  const notices = (): readonly string[] => app.shell.getState().notices.map(({ text }) => text);
  showStep(app, 2);
  expect(playerOf(app).state.getState().step).toBe(2);
  expect(notices()).toEqual([]);
  showStep(app, 99_999);
  expect(playerOf(app).state.getState().step).toBe(stepCount);
  expect(notices()).toEqual([
    expect.stringMatching(new RegExp(`no step 99999: its states are .* to ${stepCount}`)),
  ]);
});

it("shows the lesson's own run again after another one", async () => {
  await showLessonModel(app, lesson);
  await compareRun(app, "random");
  const { runs } = lessonRuns(app).getState();
  const [own, random] = runs;
  const shown = () => playerOf(app).state.getState().trace;
  expect(shown()).toBe(random?.trace);
  showOwnRun(playerOf(app), runs);
  expect(shown()).toBe(own?.trace);
  // What is not a run of the lesson stays.
  if (random) playerOf(app).show(random.trace, random.file);
  showOwnRun(playerOf(app), runs.slice(0, 1));
  expect(shown()).toBe(random?.trace);
});

/** Lets the user stop the recordings after this many. `hasFront`: not before the front has begun. */
function stopAfter(count: number, hasFront = true): void {
  const player = vi.mocked(playerOf(app));
  const whole = player.record.getMockImplementation();
  player.record.mockImplementation(async (choices) => {
    const made = (await whole?.(choices)) ?? null;
    if (count-- > 0 || made?.kind !== "recorded") return made;
    if (hasFront) return { ...made, isStopped: true };
    player.close();
    return { kind: "failed", reasons: [], isStopped: true };
  });
}

it.each([true, false])("does not compare a run that was stopped (in the front: %s)", async (hasFront) => {
  await showLessonModel(app, lesson);
  await compareRun(app, "random");
  playerOf(app).seek(3);
  const { runs } = lessonRuns(app).getState();
  stopAfter(0, hasFront);
  expect(await compareRun(app, "first-in")).toBe(false);
  expect(lessonRuns(app).getState().runs).toEqual(runs);
  expect(openLessonOf(app).getState().runs).toEqual(["random"]);
  const { trace, step } = playerOf(app).state.getState();
  expect(trace).toBe(runs[1]?.trace);
  expect(step).toBe(3);
});

it("shows no front if the lesson's own run was stopped", async () => {
  stopAfter(0);
  await showLessonModel(app, lesson, ["random"]);
  expect(lessonRuns(app).getState()).toMatchObject({ runs: [], isPreparing: false });
  expect(openLessonOf(app).getState().runs).toEqual([]);
  expect(playerOf(app).state.getState().trace).toBeNull();
});

it("keeps the runs of an address before the one that was stopped", async () => {
  // The lesson's own run, and one by other rules.
  stopAfter(2);
  await showLessonModel(app, lesson, ["random", "first-in", "strict"]);
  const { runs, isPreparing } = lessonRuns(app).getState();
  expect(runs.map(({ name }) => name)).toEqual(["", "random"]);
  expect(isPreparing).toBe(false);
  expect(openLessonOf(app).getState().runs).toEqual(["random"]);
  expect(playerOf(app).state.getState()).toMatchObject({ trace: runs[0]?.trace, step: lesson.step });
});

it("does not end the opening of a lesson because it was opened before", async () => {
  const whole = vi.mocked(playerOf(app)).record.getMockImplementation();
  let endFirst = (): void => undefined;
  vi.mocked(playerOf(app)).record.mockImplementationOnce(
    () => new Promise((resolve) => (endFirst = () => resolve(null))),
  );
  const first = showLessonModel(app, lesson, ["random"]);
  await vi.waitFor(() => expect(vi.mocked(playerOf(app)).record.mock.calls).toHaveLength(1));
  let endSecond = (): void => undefined;
  vi.mocked(playerOf(app)).record.mockImplementationOnce(async (choices) => {
    await new Promise<void>((resolve) => (endSecond = resolve));
    return (await whole?.(choices)) ?? null;
  });
  const second = showLessonModel(app, lesson, ["random"]);
  await vi.waitFor(() => expect(vi.mocked(playerOf(app)).record.mock.calls).toHaveLength(2));
  // The player has ended the first recording, because another model is open.
  endFirst();
  await first;
  expect(lessonRuns(app).getState().isPreparing).toBe(true);
  expect(openLessonOf(app).getState().runs).toEqual(["random"]);
  endSecond();
  await second;
  expect(lessonRuns(app).getState()).toMatchObject({ isPreparing: false });
  expect(
    lessonRuns(app)
      .getState()
      .runs.map(({ name }) => name),
  ).toEqual(["", "random"]);
});

it("runs no model that was changed while another run was recorded", async () => {
  await showLessonModel(app, lesson);
  const whole = vi.mocked(playerOf(app)).record.getMockImplementation();
  vi.mocked(playerOf(app)).record.mockImplementationOnce(async (choices) => {
    const made = (await whole?.(choices)) ?? null;
    app.documents.edit(moveEntity("point", 1, 0, -2));
    return made;
  });
  expect(await compareRun(app, "random")).toBe(false);
  expect(recorded).toHaveLength(2);
  expect(
    lessonRuns(app)
      .getState()
      .runs.map(({ name }) => name),
  ).toEqual([""]);
  expect(openLessonOf(app).getState().runs).toEqual([]);
});

it("runs the model by other rules, which the address names", async () => {
  const name = "random+strict+unfiltered+tolerance-0.5+linear";
  await showLessonModel(app, lesson, [name]);
  expect(vi.mocked(playerOf(app)).record.mock.lastCall?.[0]).toEqual({
    order: "random",
    filters: false,
    experiment: { relaxation: false, tolerance: 0.5, search: "linear" },
  });
  expect(openLessonOf(app).getState().runs).toEqual([name]);
  expect(await compareRun(app, "strict+backwards")).toBe(false);
});

it("does not edit the model of the open lesson, and offers to do so", async () => {
  await openLesson(app, lesson, 1);
  app.view.selectAll([{ kind: "point", id: 1 }]);
  runCommand(app, commandNamed("delete"));
  const gesture = app.documents.begin("Move");
  gesture.update({ change: moveEntity("point", 1, 0, -2).change });
  gesture.commit();
  expect(app.documents.project).toEqual(expect.objectContaining({ points: cube.points }));
  const armed = ["P", "L", "A", "N", "D", "G"].map((key) => commandOfKey({ key, shiftKey: false }));
  for (const command of armed) {
    expect(command?.needs(app)).toMatch(/lesson/);
    if (command) runCommand(app, command);
    expect(app.view.state.getState().tool).toBe("select");
  }
  const notice = app.shell.getState().notices.find(({ key }) => key === "locked");
  notice?.action.run();
  expect(commandNamed("tool-point").enabled(app)).toBe(true);
  app.documents.edit(moveEntity("point", 1, 0, -2));
  expect(app.documents.project.points[0]?.position[0]).toBe(-2);
});

it("edits any other document while a lesson is open, and the same model without the lesson", async () => {
  await openLesson(app, lesson, 1);
  closeLesson(app);
  app.documents.edit(moveEntity("point", 1, 0, -2));
  expect(app.documents.project.points[0]?.position[0]).toBe(-2);
  await openLesson(app, lesson, 1);
  app.showProject({ ...cubeProject(), name: "Mine" });
  app.documents.edit(moveEntity("point", 1, 0, -3));
  expect(app.documents.project.points[0]?.position[0]).toBe(-3);
});

afterEach(() => {
  vi.restoreAllMocks();
  vi.unstubAllGlobals();
});

const orders = (): readonly string[] =>
  lessonRuns(app)
    .getState()
    .runs.map(({ order }) => order);
const own = { name: "Cube", x: cube.points[0]?.position[0] };

it("are compared without opening the model again", async () => {
  await showLessonModel(app, lesson);
  const { id } = app.documents.state.getState();
  expect(await compareRun(app, "first-in")).toBe(true);
  expect(app.documents.state.getState().id).toBe(id);
  expect(recorded).toEqual([own, own]);
  expect(orders()).toEqual(["layered", "first-in"]);
});

it("are of the lesson's model if another document was opened", async () => {
  await showLessonModel(app, lesson);
  app.showProject({ ...cubeProject(), name: "Mine" });
  expect(await compareRun(app, "first-in")).toBe(true);
  expect(recorded).toEqual([own, own, own]);
  expect(app.documents.project.name).toBe("Cube");
  expect(orders()).toEqual(["layered", "first-in"]);
});

it("are of the lesson's model if it was changed", async () => {
  await showLessonModel(app, lesson);
  app.documents.edit(moveEntity("point", 1, 0, -2));
  expect(await compareRun(app, "first-in")).toBe(true);
  expect(recorded).toEqual([own, own, own]);
});

it("are not compared if the lesson's model cannot be opened", async () => {
  await showLessonModel(app, lesson);
  app.showProject({ ...cubeProject(), name: "Mine" });
  vi.stubGlobal("fetch", () => Promise.reject(new Error("There is no connection")));
  expect(await compareRun(app, "first-in")).toBe(false);
  expect(recorded).toEqual([own]);
  expect(app.shell.getState().message?.lines.join()).toContain("no connection");
});
