/** Lessons: what a file may contain, when a task is done, and how the cost of a search is counted. */
import { readFileSync } from "node:fs";
import { describe, expect, it, vi } from "vitest";
import { readTrace, type Trace } from "tetrafront/trace";
import { isRight, isShown, numberIn } from "../../../web/teach/lessons/check-task";
import { finishTask, isFinished, progress, progressIn, restart } from "../../../web/teach/lessons/course";
import { parseLesson, type Lesson, type LessonTask, type TaskOf } from "../../../web/teach/lessons/lesson";
import { frontErrors } from "../../../web/teach/lessons/front-errors";
import { lessonBeside, listOf, loadCourse } from "../../../web/teach/lessons/lesson-files";
import { flatAngle, runMeasures } from "../../../web/teach/lessons/run-measures";
import { searchCost } from "../../../web/teach/lessons/search-cost";
import { boxSurface } from "../../support/surfaces";
import { starSurface, starTrace } from "../../support/traces";

const fields = `title: A title
model: unit-cube
paper: "2"
tasks:
  - kind: step
    ask: Play to the end.
    reach: end`;

const withHead = (head: string, text = "Some text."): string => `---\n${head}\n---\n\n${text}\n`;

function errorsOf(content: string): readonly string[] {
  const parsed = parseLesson("new.md", content);
  return parsed.success ? [] : parsed.errors;
}

function lessonOf(content: string): Lesson {
  const parsed = parseLesson("new.md", content);
  if (!parsed.success) throw new Error(parsed.errors.join("\n"));
  return parsed.lesson;
}

const taskOf = (task: string): LessonTask => {
  const [found] = lessonOf(withHead(`${fields.split("tasks:")[0]}tasks:\n${task}`)).tasks;
  if (!found) throw new Error("no task");
  return found;
};

function readStar(): Trace {
  const { bytes } = starTrace({
    ...starSurface(boxSurface(3, [-1, -1, -1], [1, 1, 1])),
    postponeEvery: 6,
    reopenAfter: 20,
  });
  const read = readTrace(bytes);
  if (!read.success) throw new Error(read.errors[0].message);
  return read.value;
}

describe("a lesson", () => {
  it("has defaults for what it leaves out, and keeps its text", () => {
    expect(lessonOf(withHead(fields, "One.\n\n---\n\nTwo."))).toMatchObject({
      id: "new",
      order: "layered",
      step: 0,
      coloring: "age",
      text: "One.\n\n---\n\nTwo.",
    });
  });

  it("is read with the line ends of Windows and a byte order mark", () => {
    expect(lessonOf(`\uFEFF${withHead(fields).replaceAll("\n", "\r\n")}`).text).toBe("Some text.");
  });

  it.each([
    ["no head", "Only text.", /^new\.md: the head is missing; begin the file/],
    ["an unfinished head", "---\ntitle: A\n", /the head is missing/],
    ["an empty head", withHead("# nothing"), /field "title" is missing; add it/],
    ["a list as head", withHead("- title"), /head|missing/],
    [
      "bad YAML",
      withHead("title: a: b"),
      /line 2 of the head is not YAML: .*Put texts with a colon in quotes/,
    ],
    ["no title", withHead(fields.replace("title: A title\n", "")), /field "title" is missing; add it/],
    ["an empty title", withHead(fields.replace("A title", '""')), /field "title" is empty; write a text/],
    [
      "a number as paper",
      withHead(fields.replace('"2"', "2")),
      /field "paper" must be a text; put it in quotes/,
    ],
    ["a misspelled field", withHead(`${fields}\ncolour: age`), /field "colour" is unknown; correct its name/],
    ["an unknown order", withHead(`${fields}\norder: largest`), /field "order" must be one of: layered, /],
    [
      "a step that is no number",
      withHead(`${fields}\nstep: ten`),
      /field "step" must be a number without a unit/,
    ],
    ["half a step", withHead(`${fields}\nstep: 1.5`), /field "step" must be a whole number/],
    [
      "an unknown figure",
      withHead(`${fields}\nfigure: heap`),
      /field "figure" must be one of: queue, search-cost, or a list/,
    ],
    [
      "no tasks",
      withHead(fields.replace(/tasks:[^]*/, "tasks: []")),
      /field "tasks" needs at least one task/,
    ],
    [
      "an unknown kind of task",
      withHead(fields.replace("kind: step", "kind: draw")),
      /field "tasks\.0\.kind" must be one of: step, color/,
    ],
    [
      "an unknown target",
      withHead(fields.replace("reach: end", "reach: last")),
      /field "tasks\.0\.reach" must be one of: .*end/,
    ],
    ["no text", withHead(fields, ""), /there is no text after the head/],
  ])("with %s is refused with field and remedy", (_, content, message) => {
    const errors = errorsOf(content);
    expect(errors.length).toBeGreaterThan(0);
    expect(errors.join("\n")).toMatch(message);
    for (const error of errors) expect(error).toMatch(/^new\.md: .*\.$/);
  });

  it("names all errors at once", () => {
    expect(
      errorsOf(withHead(`${fields.replace("title: A title\n", "")}\nstep: 0.5\norder: none`)),
    ).toHaveLength(3);
  });

  it("has choices of which one is the answer", () => {
    const choice = (choices: string, answer: string): string =>
      withHead(
        `${fields}\n  - kind: choice\n    ask: Which?\n    choices: ${choices}\n    answer: ${answer}`,
      );
    expect(errorsOf(choice("[a, b]", "b"))).toEqual([]);
    expect(errorsOf(choice("[a, b]", "c")).join()).toMatch(/"tasks\.1\.answer" is not one of the choices/);
    expect(errorsOf(choice("[a]", "a")).join()).toMatch(/"tasks\.1\.choices" needs at least two texts/);
    expect(errorsOf(choice("[a, a]", "a")).join()).toMatch(/"tasks\.1\.choices\.\d" is in the list twice/);
  });
});

describe("a task", () => {
  const trace = readStar();

  it("of the kind step is done at the steps of its kind, and at no others", () => {
    for (const reach of ["postponed", "crosses", "recovery", "new-node"]) {
      const task = taskOf(`  - {kind: step, ask: Go, reach: ${reach}}`);
      const reached = Array.from({ length: trace.stepCount + 1 }, (_, step) =>
        isShown(task, { trace, step, coloring: "age" }),
      );
      expect(reached[0], reach).toBe(false);
      expect(reached, reach).toContain(true);
      reached.forEach((isReached, state) => {
        const step = trace.stepAt(state);
        const verdicts = step?.kind === "advance" ? step.candidates.map(({ verdict }) => verdict) : [];
        const expected = {
          postponed: step?.kind === "advance" && step.outcome === "postponed",
          crosses: verdicts.includes("crosses"),
          recovery: step?.kind === "recovery",
          "new-node": (step?.addedNodes.length ?? 0) > 0,
        }[reach];
        expect(isReached, `${reach} at ${state}`).toBe(expected);
      });
    }
  });

  it("of the kind step is done if a fast player shows a step of its kind together with later ones", () => {
    const task = taskOf("  - {kind: step, ask: Go, reach: recovery}");
    const steps = Array.from({ length: trace.stepCount }, (_, i) => i + 1);
    const recoveries = steps.filter((step) => trace.stepAt(step)?.kind === "recovery");
    for (const step of steps)
      for (const after of [0, step - 3, step - 1].filter((from) => from >= 0)) {
        const expected = recoveries.some((one) => one > after && one <= step);
        expect(isShown(task, { trace, step, coloring: "age", after }), `${after} to ${step}`).toBe(expected);
      }
  });

  it("may ask for the last state, or for a colour", () => {
    const end = taskOf("  - {kind: step, ask: Go, reach: end}");
    expect(isShown(end, { trace, step: trace.stepCount, coloring: "age" })).toBe(true);
    expect(isShown(end, { trace, step: trace.stepCount - 1, coloring: "age" })).toBe(false);
    const color = taskOf("  - {kind: color, ask: Choose, coloring: layer}");
    expect(isShown(color, { trace, step: 0, coloring: "layer" })).toBe(true);
    expect(isShown(color, { trace, step: 0, coloring: "size" })).toBe(false);
    const number = taskOf("  - {kind: number, ask: How many?, answer: 0}");
    expect(isShown(number, { trace, step: 0, coloring: "age" })).toBe(false);
  });

  it("with a number accepts what is within the tolerance", () => {
    const task = taskOf(
      "  - {kind: number, ask: Size?, answer: 0.1002, tolerance: 0.0003}",
    ) as TaskOf<"number">;
    for (const right of ["0.1002", " .1005 ", "0,1", "1.002e-1"])
      expect(isRight(task, right), right).toBe(true);
    for (const wrong of ["0.1006", "", "0.1002 m", "-0.1002", "1002"])
      expect(isRight(task, wrong), wrong).toBe(false);
    const exact = taskOf("  - {kind: number, ask: Faces?, answer: 1162}") as TaskOf<"number">;
    for (const right of ["1162", "1,162", "1 162", "1162.0"]) expect(isRight(exact, right), right).toBe(true);
    for (const wrong of ["1161", "1,162,000", "1.162"]) expect(isRight(exact, wrong), wrong).toBe(false);
  });

  it.each([
    ["12", 12],
    ["-3.5", -3.5],
    ["1,234,567", 1234567],
    ["3,5", 3.5],
    ["1,000", 1000],
    ["0,103", 0.103],
    ["-0,103", -0.103],
    ["1,162", 1162],
    ["1,162.5", 1162.5],
    ["1234,567", 1234.567],
    ["1,15", 1.15],
    ["1,5e-3", 0.0015],
    ["0,103,5", null],
    ["1,15,000", null],
    ["0,103.5", null],
    ["many", null],
    ["1 2 m", null],
    ["", null],
    ["1.2.3", null],
  ])("reads %j as %s", (text, value) => expect(numberIn(text)).toBe(value));
});

describe("the cost of a search", () => {
  it("adds the front and the faces near the base up over the steps", () => {
    const trace = readStar();
    let [linear, near, advances] = [0, 0, 0];
    for (let state = 1; state <= trace.stepCount; state++) {
      const step = trace.stepAt(state);
      if (step?.kind !== "advance") continue;
      linear += trace.frontAt(state - 1).length;
      near += step.nearbyFaces;
      advances++;
    }
    expect(advances).toBeGreaterThan(50);
    const cost = searchCost(trace);
    expect(cost.linear.at(-1)).toBe(linear);
    expect(cost.near.at(-1)).toBe(near);
    expect(cost.elements[0]).toBe(0);
    expect(cost.elements.at(-1)).toBe(trace.steps.elementsMade[trace.stepCount]);
    for (const sums of [cost.linear, cost.near])
      expect(sums.every((sum, i) => i === 0 || sum >= (sums[i - 1] ?? 0))).toBe(true);
    expect(searchCost(trace, 10).linear).toHaveLength(11);
  });
});

describe("the measures of a run", () => {
  it("count the elements at the end, and those that are flat", () => {
    const trace = readStar();
    const measures = runMeasures(trace);
    expect(measures.elements).toBe(trace.elementsAt(trace.stepCount).length);
    expect(measures.crossings).toBe(trace.summary().refused.crosses);
    expect(measures.recoveries).toBe(
      Array.from({ length: trace.stepCount }, (_, i) => trace.stepAt(i + 1)).filter(
        (step) => step?.kind === "recovery",
      ).length,
    );
    // A star from the middle of a cube has no flat elements.
    expect(measures.flat).toBe(0);
    expect(flatAngle).toBe(5);
  });
});

describe("progress", () => {
  it("keeps tasks once, and forgets a lesson", () => {
    const lesson = lessonOf(withHead(`${fields}\n  - {kind: step, ask: Go, reach: crosses}`));
    finishTask(lesson, 1);
    finishTask(lesson, 1);
    expect(progress.getState()[lesson.id]).toEqual([1]);
    expect(isFinished(lesson, progress.getState())).toBe(false);
    finishTask(lesson, 0);
    expect(isFinished(lesson, progress.getState())).toBe(true);
    restart(lesson);
    expect(progress.getState()).toEqual({});
  });

  it("takes only what is progress from the storage", () => {
    expect(progressIn({ front: [0, 2, "a", -1, 0.5], other: 3 })).toEqual({ front: [0, 2] });
    for (const damaged of [null, 3, "x"]) expect(progressIn(damaged)).toEqual({});
  });
});

describe("the list of the lessons", () => {
  it("numbers lessons by their places, whatever is wrong with other files", async () => {
    const files: Readonly<Record<string, string>> = {
      "index.json": '["bad.md", "a.md", "none.md", "b.md"]',
      "a.md": withHead(fields),
      "b.md": withHead(fields),
      "bad.md": "Only text.",
    };
    vi.stubGlobal("document", { baseURI: "https://example.org/" });
    vi.stubGlobal("fetch", (address: URL) => {
      const content = files[address.pathname.replace("/lessons/", "")];
      return Promise.resolve(new Response(content, { status: content === undefined ? 404 : 200 }));
    });
    const course = await loadCourse().finally(() => vi.unstubAllGlobals());
    expect(course.lessons.map((lesson) => lesson?.id)).toEqual([undefined, "a", undefined, "b"]);
    expect(course.errors).toHaveLength(2);
    expect([1, 2, 3, 4].map((number) => lessonBeside(course, number, 1))).toEqual([2, 4, 4, null]);
    expect([1, 2, 3, 4].map((number) => lessonBeside(course, number, -1))).toEqual([null, null, 2, 2]);
  });

  it("names ten files, each of which is a lesson", () => {
    const folder = new URL("../../../public/lessons/", import.meta.url);
    const files = listOf(readFileSync(new URL("index.json", folder), "utf8"));
    expect(files).toHaveLength(10);
    for (const file of files) {
      const parsed = parseLesson(file, readFileSync(new URL(file, folder), "utf8"));
      expect(parsed.success ? [] : parsed.errors, file).toEqual([]);
    }
  });

  it("is refused if it is no list of markdown files", () => {
    for (const content of ["{}", '["a.txt"]', "[1]"]) expect(() => listOf(content)).toThrow(/must be a list/);
  });
});

describe("what the front of a lesson does not have", () => {
  const trace = readStar();
  const errorsOfFront = (change: Partial<Lesson>): readonly string[] =>
    frontErrors({ ...lessonOf(withHead(fields)), ...change }, trace);
  const reach = (kind: TaskOf<"step">["reach"]) => ({
    tasks: [taskOf(`  - kind: step\n    ask: Go.\n    reach: ${kind}`)],
  });

  it("is named: a step beyond its states, with those that it has", () => {
    expect(errorsOfFront({ step: 0 })).toEqual([]);
    expect(errorsOfFront({ step: trace.stepCount })).toEqual([]);
    for (const step of [-1, trace.stepCount + 1, 99_999]) {
      const [error] = errorsOfFront({ step });
      expect(error).toContain('new.md: field "step"');
      expect(error).toContain(`from 0 to ${trace.stepCount}`);
      expect(error).toContain(`is ${step}`);
    }
  });

  it("is named: a task that no step completes, with the kinds that there are", () => {
    expect(errorsOfFront(reach("postponed"))).toEqual([]);
    expect(errorsOfFront(reach("end"))).toEqual([]);
    const [error] = errorsOfFront(reach("patch"));
    expect(error).toContain('field "tasks.0.reach" is "patch"');
    expect(error).toContain("postponed");
  });
});
