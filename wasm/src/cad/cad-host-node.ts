import { fork } from "node:child_process";
import { fileURLToPath } from "node:url";
import { Worker } from "node:worker_threads";
import type { CadHost, CadWorker, CadWorkerEvents } from "./cad-host.js";
import { crashOf } from "./crash.js";
import type { CadProgress, CadReply } from "./protocol.js";

/**
 * Compiles functions of a module once and fast. Most of the library's run a few times only: with optimized code, a part of 292 kB took
 * 2.5 s of processor time to be read, without it 0.7 s. The option holds for a whole process, and our engine needs optimized code.
 */
const COMPILER = "--liftoff-only";

export const cadHost: CadHost = {
  remedyFor: (format) =>
    `Install the optional package that reads ${format === "iges" ? "IGES" : "STEP and BREP"} files: npm install ${format === "iges" ? "occt-import-js@0.0.23" : "replicad-opencascadejs@1.1.0"}`,
  start: (events) => startedProcess(events) ?? startedThread(events),
};

const script = new URL("./cad-worker.js", import.meta.url);

/** Returns undefined where no process may be started, or where other programs than Node would be. */
function startedProcess(events: CadWorkerEvents): CadWorker | undefined {
  const { electron, bun, deno } = process.versions;
  if ([electron, bun, deno].some((version) => version !== undefined)) return undefined;
  try {
    const child = fork(fileURLToPath(script), [], {
      execArgv: [COMPILER],
      serialization: "advanced",
      stdio: ["ignore", "ignore", "ignore", "ipc"],
    });
    const ends = endings(events);
    child.on("message", (reply) => events.onReply(reply as CadReply | CadProgress));
    child.on("error", ends.onError);
    child.on("exit", (code, signal) => ends.onExit(signal ?? code));
    return {
      post: (request) => child.send(request),
      terminate: () => {
        ends.expect();
        child.kill("SIGKILL");
      },
    };
  } catch {
    return undefined;
  }
}

function startedThread(events: CadWorkerEvents): CadWorker {
  const worker = new Worker(script, { name: "tetrafront-cad", execArgv: [] });
  const ends = endings(events);
  worker.on("message", (reply: CadReply | CadProgress) => events.onReply(reply));
  worker.on("error", ends.onError);
  worker.on("exit", ends.onExit);
  return {
    post: (request) => worker.postMessage(request),
    terminate: () => {
      ends.expect();
      void worker.terminate();
    },
  };
}

/** Reports a failure, and an end that was not expected. */
function endings(events: CadWorkerEvents) {
  let isExpected = false;
  return {
    expect: () => {
      isExpected = true;
    },
    onError: (failure: unknown) => events.onCrash(crashOf(failure)),
    onExit: (code: number | string | null) => {
      if (isExpected) return;
      // A process ends by a signal if it has no memory left: its own, or that of the system.
      const kind = typeof code === "string" ? "out-of-memory" : "failed";
      events.onCrash({ kind, message: `the worker ended with code ${code}` });
    },
  };
}
