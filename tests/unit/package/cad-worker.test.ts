/** The worker that reads a CAD file: a process; a thread where no process may be started. */
import type { ChildProcess } from "node:child_process";
import { once } from "node:events";
import { createRequire, syncBuiltinESMExports } from "node:module";

import { readSurface } from "tetrafront";
import { afterEach, beforeEach, describe, expect, test, vi } from "vitest";

import { drilledSolid, stepFile } from "../../support/step-files.js";

const plate = stepFile([drilledSolid("plate", [0, 0, 0], [20, 10, 8], [8, 5], 3)]);

type Processes = { fork: (...arguments_: readonly unknown[]) => ChildProcess };

/** Notes the processes that are started until `restore` is called. */
function notedProcesses() {
  const processes = createRequire(import.meta.url)("node:child_process") as Processes;
  const { fork } = processes;
  const started: ChildProcess[] = [];
  processes.fork = (...rest) => {
    const child = fork(...rest);
    started.push(child);
    return child;
  };
  syncBuiltinESMExports();
  return {
    started,
    restore: () => {
      processes.fork = fork;
      syncBuiltinESMExports();
    },
  };
}

describe("a worker", () => {
  let processes: ReturnType<typeof notedProcesses>;
  beforeEach(() => {
    processes = notedProcesses();
  });
  afterEach(() => processes.restore());

  const begun = async (): Promise<ChildProcess> => {
    await vi.waitFor(() => expect(processes.started).toHaveLength(1));
    const [child] = processes.started;
    if (child === undefined) throw new Error("No process was started");
    return child;
  };

  test.each([
    ["ERR_WORKER_OUT_OF_MEMORY", "too-large-file", /^Export the parts one by one/],
    ["MODULE_NOT_FOUND", "missing-library", /^Install/],
    ["", "malformed-file", /^Export the part again/],
  ])("that fails with the code %s is reported as %s", async (code, expected, remedy) => {
    const reading = readSurface(plate, { fileName: "plate.step" });
    (await begun()).emit("error", Object.assign(new Error("Failed"), { code }));
    const read = await reading;
    const error = read.success ? undefined : read.errors[0];
    expect([error?.code, error?.remedy]).toEqual([expected, expect.stringMatching(remedy)]);
  });

  test("that the system ends for lack of memory is reported", async () => {
    const reading = readSurface(plate, { fileName: "plate.step" });
    (await begun()).kill("SIGKILL");
    const read = await reading;
    expect(read.success ? "" : read.errors[0].code).toBe("too-large-file");
  });

  test("ends when the reading is cancelled", async () => {
    const abort = new AbortController();
    const reading = readSurface(plate, { fileName: "plate.step", signal: abort.signal });
    const ended = once(await begun(), "exit");
    abort.abort();
    await expect(reading).rejects.toMatchObject({ code: "cancelled" });
    await ended;
  });

  test("is not started if the call is cancelled before", async () => {
    const signal = AbortSignal.abort();
    await expect(readSurface(plate, { fileName: "plate.step", signal })).rejects.toMatchObject({
      code: "cancelled",
    });
    await new Promise((resolve) => setImmediate(resolve));
    expect(processes.started).toEqual([]);
  });
});

describe("where no process may be started", () => {
  const refuse = () => {
    throw new Error("Access is denied");
  };
  const processes = createRequire(import.meta.url)("node:child_process") as { fork: unknown };
  const threads = createRequire(import.meta.url)("node:worker_threads") as { Worker: unknown };
  const kept = { fork: processes.fork, Worker: threads.Worker };
  beforeEach(() => {
    processes.fork = refuse;
    syncBuiltinESMExports();
  });
  afterEach(() => {
    processes.fork = kept.fork;
    threads.Worker = kept.Worker;
    syncBuiltinESMExports();
  });

  test("a thread reads the file", async () => {
    expect((await readSurface(plate, { fileName: "plate.step" })).success).toBe(true);
  });

  test("nor a thread, a library is missing", async () => {
    threads.Worker = class {
      constructor() {
        refuse();
      }
    };
    syncBuiltinESMExports();
    const read = await readSurface(plate, { fileName: "plate.step" });
    expect(read.success ? "" : read.errors[0].code).toBe("missing-library");
  });
});
