import { type ChildProcess, fork } from "node:child_process";
import { fileURLToPath } from "node:url";
import { Worker } from "node:worker_threads";
import type { CadHost, CadWorker, CadWorkerEvents } from "./cad-host.js";
import { USAGE_PIPE } from "./cad-process.js";
import { crashOf, startFailure } from "./crash.js";
import type { CadCrash, CadProgress, CadReply, CadRequest } from "./protocol.js";

/**
 * Compiles functions of a module once and fast. Most of the library's run a few times only: with optimized code, a part of 292 kB took
 * 2.5 s of processor time to be read, without it 0.7 s. The option holds for a whole process, and our engine needs optimized code.
 */
const COMPILER = "--liftoff-only";

/** Signals, and the exit code of an abort, with which a process ends that has no memory left: its own, or that of the system. */
const OUT_OF_MEMORY: ReadonlySet<unknown> = new Set(["SIGKILL", "SIGABRT", "SIGTRAP", 134]);

/** The process ends while it is sent a request: its end is reported then. */
const CHANNEL_CLOSED: ReadonlySet<unknown> = new Set(["EPIPE", "ECONNRESET", "ERR_IPC_CHANNEL_CLOSED"]);

export const cadHost: CadHost = {
  remedyFor: (format) =>
    `Install the optional package that reads ${format === "iges" ? "IGES" : "STEP and BREP"} files: npm install ${format === "iges" ? "occt-import-js@0.0.23" : "replicad-opencascadejs@1.1.0"}`,
  start: (events) => (hasProcesses() ? startedProcess(events) : startedThread(events)),
};

/** Other programs that run the package do not start Node as a process, or have no option of this name. */
function hasProcesses(): boolean {
  const { electron, bun, deno } = process.versions;
  return [electron, bun, deno].every((version) => version === undefined);
}

/**
 * Starts a process, and a thread if the process ends before its first message: it may not be allowed, Node may refuse its option, or
 * a bundle may not have its script. A process that was ended for lack of memory has no substitute, since a thread would end this one.
 */
function startedProcess(events: CadWorkerEvents): CadWorker {
  let child: ChildProcess | undefined;
  let thread: CadWorker | undefined;
  let request: CadRequest | undefined;
  let state: "starting" | "answers" | "ended" = "starting";
  let processorSeconds = 0;

  const replace = (): void => {
    if (child !== undefined) end(child);
    child = undefined;
    state = "ended";
    thread = startedThread(events);
    if (request !== undefined) thread.post(request);
  };
  const onEnd = (crash: CadCrash): void => {
    if (state === "ended") return;
    if (state === "answers" || crash.kind === "out-of-memory") {
      state = "ended";
      events.onCrash(crash);
      return;
    }
    try {
      replace();
    } catch (failure) {
      events.onCrash(startFailure(failure));
    }
  };
  const onFailure = (failure: Error | null): void => {
    if (failure !== null && !CHANNEL_CLOSED.has((failure as NodeJS.ErrnoException).code))
      onEnd(crashOf(failure));
  };

  try {
    child = forked();
    child.on("message", (reply) => {
      if (state === "ended") return;
      state = "answers";
      events.onReply(reply as CadReply | CadProgress);
    });
    child.on("error", onFailure);
    child.on("exit", (code, signal) => onEnd(endOf(signal ?? code)));
    const usage = child.stdio[USAGE_PIPE];
    usage?.on("data", ({ length }: Buffer) => (processorSeconds += length));
    // Without reports, the limit is reached later.
    usage?.on("error", () => undefined);
  } catch {
    replace();
  }
  return {
    post: (posted) => {
      request = posted;
      if (thread !== undefined) thread.post(posted);
      // A process without a channel could not be started, or has ended: an event says so.
      else if (child?.connected === true) child.send(posted, onFailure);
    },
    processorSeconds: () => (thread === undefined ? processorSeconds : undefined),
    terminate: () => {
      state = "ended";
      thread?.terminate();
      if (child !== undefined) end(child);
    },
  };
}

/** Processes that were started and have not ended. */
const children = new Set<ChildProcess>();

const endAll = (): void => children.forEach((child) => child.kill("SIGKILL"));

/**
 * Starts a process that ends with this one: it is killed when this one exits. If this one is killed, the process notices
 * it within a second (`cad-port-node.ts`).
 */
function forked(): ChildProcess {
  const child = fork(fileURLToPath(new URL("./cad-worker.js", import.meta.url)), [], {
    execArgv: [COMPILER],
    serialization: "advanced",
    stdio: ["ignore", "ignore", "ignore", "ipc", "pipe"],
  });
  if (children.size === 0) process.on("exit", endAll);
  children.add(child);
  child.on("exit", () => forget(child));
  child.on("error", () => forget(child));
  return child;
}

function forget(child: ChildProcess): void {
  if (children.delete(child) && children.size === 0) process.off("exit", endAll);
}

function end(child: ChildProcess): void {
  forget(child);
  child.kill("SIGKILL");
}

/** Returns what the end of a process means. */
function endOf(code: number | string | null): CadCrash {
  const message = typeof code === "string" ? `ended by ${code}` : `the worker ended with code ${code}`;
  if (OUT_OF_MEMORY.has(code)) return { kind: "out-of-memory", message };
  return { kind: typeof code === "string" ? "ended" : "failed", message };
}

function startedThread(events: CadWorkerEvents): CadWorker {
  // Bundlers recognize the worker by exactly this expression.
  const worker = new Worker(new URL("./cad-worker.js", import.meta.url), {
    name: "tetrafront-cad",
    execArgv: [],
  });
  let isTerminated = false;
  const report = (crash: CadCrash): void => {
    if (!isTerminated) events.onCrash(crash);
  };
  worker.on("message", (reply: CadReply | CadProgress) => events.onReply(reply));
  worker.on("error", (failure: unknown) => report(crashOf(failure)));
  worker.on("exit", (code) => report(endOf(code)));
  return {
    post: (request) => worker.postMessage(request),
    terminate: () => {
      isTerminated = true;
      void worker.terminate();
    },
  };
}
