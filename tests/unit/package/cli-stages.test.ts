/** What a command says in a log while it works, and how it ends if it is asked to. */
import { writeFileSync } from "node:fs";
import path from "node:path";

import type { Mesher } from "tetrafront";
import { afterEach, beforeEach, describe, expect, test, vi } from "vitest";

import { withRun } from "../../../wasm/src/cli/run.js";
import { enterPhase, enterStage, setBarShown, startStageLines } from "../../../wasm/src/cli/stages.js";
import { progressAt } from "../../support/progress.js";
import { signalInLongCall, tetrafront } from "../../support/command-line.js";
import { stlBinary } from "../../support/surface-files.js";
import { sphereSurface } from "../../support/surfaces.js";
import { temporaryFolder } from "../../support/temporary-folder.js";

const folder = temporaryFolder();

vi.mock(import("../../../wasm/src/api/mesher.js"), () => ({
  createMesher: () => Promise.resolve({ dispose: () => undefined } as unknown as Mesher),
}));

describe("every ten seconds, a line", () => {
  let lines: string[] = [];
  beforeEach(() => {
    vi.useFakeTimers();
    lines = [];
    vi.spyOn(process.stderr, "write").mockImplementation((text) => {
      lines.push(String(text));
      return true;
    });
  });
  afterEach(() => {
    vi.useRealTimers();
    vi.restoreAllMocks();
    setBarShown(false);
  });

  test("names the stage, the share of the whole that is done, and the time", () => {
    const stop = startStageLines();
    enterStage("reading part.step");
    vi.advanceTimersByTime(9000);
    expect(lines).toEqual([]);
    vi.advanceTimersByTime(1000);
    enterPhase({ phase: "check", fraction: 0.437, elapsedSeconds: 10 }, "remesh");
    vi.advanceTimersByTime(10_000);
    enterPhase({ phase: "volume", fraction: 0.5, elapsedSeconds: 20, meshNumber: 2 }, undefined);
    vi.advanceTimersByTime(10_000);
    stop();
    vi.advanceTimersByTime(60_000);
    expect(lines).toEqual([
      "tetrafront: reading part.step, 10 s so far\n",
      "tetrafront: remeshing the surface, 43 %, 20 s so far, about 15 s left\n",
      "tetrafront: mesh 2: filling the volume, 50 %, 30 s so far, about 30 s left\n",
    ]);
  });

  test("follows the calls of a run; the fraction of the whole never decreases", async () => {
    const stop = startStageLines();
    await withRun(true, (_mesher, controlOf) => {
      for (const step of ["check", "remesh", "run"] as const) {
        const { onProgress } = controlOf(step);
        for (const fraction of [0.1, 0.9]) {
          onProgress?.({ ...progressAt(fraction), phase: step === "run" ? "optimize" : "check" });
          vi.advanceTimersByTime(10_000);
        }
      }
      return Promise.resolve();
    });
    stop();
    const shares = lines.map((line) => Number(/, (\d+) %/.exec(line)?.[1]));
    expect(lines.map((line) => /: (.*?),/.exec(line)?.[1])).toEqual(
      ["checking the surface", "remeshing the surface", "improving the elements"].flatMap((words) => [
        words,
        words,
      ]),
    );
    expect(shares).toEqual(shares.toSorted((a, b) => a - b));
    expect(shares.at(-1)).toBeGreaterThan(90);
  });

  test("gives way to a progress bar", () => {
    const stop = startStageLines();
    setBarShown(true);
    vi.advanceTimersByTime(20_000);
    stop();
    expect(lines).toEqual([]);
  });
});

describe("a signal while the worker is in a long call ends the command by the signal, within about a second:", () => {
  const commands = [
    ["mesh", "ball.stl", "-o", "out.vtu", "--surface", "remesh"],
    ["remesh", "ball.stl", "-o", "out.stl"],
    ["mesh", "ball.stl", "-o", "out.vtu", "--surface", "keep"],
  ];
  const signals = ["SIGTERM", "SIGINT", "SIGHUP"] as const;
  const cases = commands.map((command, i) => [signals[i % 3] ?? "SIGTERM", command] as const);

  test.each(cases)("%s, %j", async (given, command) => {
    writeFileSync(path.join(folder.path, "ball.stl"), stlBinary(sphereSurface(20)));
    let ended = 0;
    const { code, signal, stderr } = await tetrafront(folder.path, command, {
      env: signalInLongCall(given),
      started: (child) => child.on("exit", () => (ended = Date.now())),
    });
    const sent = Number(/signal at (\d+)/.exec(stderr)?.[1]);
    // A run is given up after half a second, and its report is written; other calls end the process.
    if (command.includes("keep")) expect(code).toBe(129);
    else expect(signal).toBe(given);
    expect(ended - sent).toBeGreaterThan(0);
    expect(ended - sent).toBeLessThan(5000);
  });
});
