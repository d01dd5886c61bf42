/** The worker that reads a CAD file: a process; a thread where no process may be started. */
import { spawn, type ChildProcess } from "node:child_process";
import { once } from "node:events";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire, syncBuiltinESMExports } from "node:module";
import { tmpdir } from "node:os";
import path from "node:path";
import type { Worker } from "node:worker_threads";

import { readSurface } from "tetrafront";
import { afterAll, afterEach, beforeEach, describe, expect, test, vi } from "vitest";

import { drilledSolid, stepFile } from "../../support/step-files.js";

/** A busy machine starts processes slowly. */
const PATIENCE = { timeout: 60_000, interval: 50 };

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

const read = () => readSurface(plate, { fileName: "plate.step" });

async function errorOf(reading: ReturnType<typeof read>) {
  const { success, ...rest } = await reading;
  return success || !("errors" in rest) ? undefined : rest.errors[0];
}

const folder = mkdtempSync(path.join(tmpdir(), "tetrafront-cad-worker-"));
afterAll(() => rmSync(folder, { recursive: true }));

/** Writes a script that runs in a process before the worker. `send` sends a message, `pidFile` is where it may write its number. */
function preload(name: string, script: string): { readonly NODE_OPTIONS: string; readonly pidFile: string } {
  const file = path.join(folder, `${name}.cjs`);
  const pidFile = path.join(folder, `${name}.pid`);
  const start = `const pidFile = ${JSON.stringify(pidFile)}; const send = process.send?.bind(process);`;
  // Other Node processes of the test have no channel.
  writeFileSync(file, `${start} if (send) { ${script} }`);
  return { NODE_OPTIONS: `--require ${file}`, pidFile };
}

/** The worker stays busy, as with some damaged files, after it has said that the library is loaded. */
const BUSY = `
  process.send = (message) => {
    send(message);
    require("node:fs").writeFileSync(pidFile, String(process.pid));
    for (;;);
  };`;

function isRunning(pid: number): boolean {
  try {
    return process.kill(pid, 0);
  } catch {
    return false;
  }
}

/** Resolves with the number of a process that has written it to a file. */
async function pidIn(file: string): Promise<number> {
  await vi.waitFor(() => expect(Number(readFileSync(file, "utf8"))).toBeGreaterThan(0), PATIENCE);
  return Number(readFileSync(file, "utf8"));
}

describe("a process", () => {
  let processes: ReturnType<typeof notedProcesses>;
  const { execPath } = process;
  beforeEach(() => {
    processes = notedProcesses();
  });
  afterEach(() => {
    processes.restore();
    process.execPath = execPath;
    vi.unstubAllEnvs();
  });

  const begun = async (): Promise<ChildProcess> => {
    await vi.waitFor(() => expect(processes.started).toHaveLength(1));
    const [child] = processes.started;
    if (child === undefined) throw new Error("No process was started");
    return child;
  };

  test.each([
    ["does not exist", undefined],
    ["does not know an option", "exit 9"],
    ["is ended at once", "kill -TERM $$"],
  ])("is replaced by a thread if its program %s", async (name, command) => {
    process.execPath = path.join(folder, name.replaceAll(" ", "-"));
    if (command !== undefined) writeFileSync(process.execPath, `#!/bin/sh\n${command}\n`, { mode: 0o755 });
    expect((await read()).success).toBe(true);
    expect(processes.started).toHaveLength(1);
    expect(processes.started[0]?.connected).toBe(false);
  });

  test("reports its uncaught error, with its code", async () => {
    const { NODE_OPTIONS } = preload(
      "uncaught",
      `process.send = (message) => {
        if (message.kind !== "read") return send(message);
        setImmediate(() => { throw Object.assign(new Error("Failed"), { code: "ERR_WORKER_OUT_OF_MEMORY" }) });
      };`,
    );
    vi.stubEnv("NODE_OPTIONS", NODE_OPTIONS);
    expect(await errorOf(read())).toMatchObject({
      code: "too-large-file",
      message: expect.stringMatching(/Failed$/) as unknown,
    });
  });

  test.each([
    ["SIGABRT", "too-large-file", /ended by SIGABRT$/],
    ["SIGTERM", "malformed-file", /^the process that reads the STEP file was ended by SIGTERM$/],
  ] as const)("that %s ends while it reads is reported as %s", async (signal, code, message) => {
    const { NODE_OPTIONS, pidFile } = preload(signal, BUSY);
    vi.stubEnv("NODE_OPTIONS", NODE_OPTIONS);
    const reading = read();
    process.kill(await pidIn(pidFile), signal);
    expect(await errorOf(reading)).toMatchObject({
      code,
      message: expect.stringMatching(message) as unknown,
    });
  });

  test("that the system ends for lack of memory is reported, also before its first message", async () => {
    const reading = read();
    (await begun()).kill("SIGKILL");
    expect((await errorOf(reading))?.code).toBe("too-large-file");
  });

  test("ends when the reading is cancelled", async () => {
    const abort = new AbortController();
    const reading = readSurface(plate, { fileName: "plate.step", signal: abort.signal });
    const ended = once(await begun(), "exit");
    abort.abort();
    await expect(reading).rejects.toMatchObject({ code: "cancelled" });
    await ended;
    expect(processes.started).toHaveLength(1);
  });

  test("is not started if the call is cancelled before", async () => {
    const signal = AbortSignal.abort();
    await expect(readSurface(plate, { fileName: "plate.step", signal })).rejects.toMatchObject({
      code: "cancelled",
    });
    await new Promise((resolve) => setImmediate(resolve));
    expect(processes.started).toEqual([]);
  });

  test.each(["killed", "ended by itself"])("that is busy ends when its creator is %s", async (how) => {
    const { NODE_OPTIONS, pidFile } = preload(how.replaceAll(" ", "-"), BUSY);
    const file = path.join(folder, "plate.step");
    writeFileSync(file, plate);
    const script = `
      import { readFileSync } from "node:fs";
      import { readSurface } from ${JSON.stringify(import.meta.resolve("tetrafront"))};
      process.stdin.once("data", () => process.exit());
      await readSurface(readFileSync(${JSON.stringify(file)}), { fileName: "plate.step" });`;
    const creator = spawn(execPath, ["--input-type=module", "-e", script], {
      env: { ...process.env, NODE_OPTIONS },
      stdio: ["pipe", "ignore", "inherit"],
    });
    const pid = await pidIn(pidFile);
    if (how === "killed") creator.kill("SIGKILL");
    else creator.stdin.write("end\n");
    await vi.waitFor(() => expect(isRunning(pid)).toBe(false), PATIENCE);
  });
});

describe("where no process may be started", () => {
  const refuse = () => {
    throw new Error("Access is denied");
  };
  const processes = createRequire(import.meta.url)("node:child_process") as { fork: unknown };
  const threads = createRequire(import.meta.url)("node:worker_threads") as { Worker: typeof Worker };
  const kept = { fork: processes.fork, Worker: threads.Worker };
  const startThreadsAs = (thread: unknown): void => {
    threads.Worker = thread as typeof Worker;
    syncBuiltinESMExports();
  };
  const started: Worker[] = [];
  beforeEach(() => {
    processes.fork = refuse;
    started.length = 0;
    startThreadsAs(
      class extends kept.Worker {
        constructor(...rest: ConstructorParameters<typeof Worker>) {
          super(...rest);
          if (rest[1]?.name === "tetrafront-cad") started.push(this);
        }
      },
    );
  });
  afterEach(() => {
    processes.fork = kept.fork;
    startThreadsAs(kept.Worker);
  });

  const begun = async (): Promise<Worker> => {
    await vi.waitFor(() => expect(started).toHaveLength(1));
    const [thread] = started;
    if (thread === undefined) throw new Error("No thread was started");
    return thread;
  };

  test("a thread reads the file", async () => {
    expect((await read()).success).toBe(true);
    expect(started).toHaveLength(1);
  });

  test.each([
    ["ERR_WORKER_OUT_OF_MEMORY", "too-large-file", /^Export the parts one by one/],
    ["MODULE_NOT_FOUND", "missing-library", /^Install/],
    ["", "malformed-file", /^Export the part again/],
  ])("a thread that fails with the code %s is reported as %s", async (code, expected, remedy) => {
    const reading = read();
    (await begun()).emit("error", Object.assign(new Error("Failed"), { code }));
    const error = await errorOf(reading);
    expect([error?.code, error?.remedy]).toEqual([expected, expect.stringMatching(remedy)]);
  });

  test("nor a thread, a library is missing", async () => {
    startThreadsAs(
      class {
        constructor() {
          refuse();
        }
      },
    );
    expect((await errorOf(read()))?.code).toBe("missing-library");
  });
});
