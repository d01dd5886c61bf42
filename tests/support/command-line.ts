import { fork, spawn, type ChildProcess } from "node:child_process";
import { fileURLToPath } from "node:url";

const program = fileURLToPath(new URL("../../wasm/bin/tetrafront.mjs", import.meta.url));

export interface CommandResult {
  /** Null if a signal ended the program. */
  readonly code: number | null;
  /** The signal that ended a program in a process of its own. */
  readonly signal?: NodeJS.Signals | null;
  readonly stdout: string;
  readonly stderr: string;
}

interface RunOptions {
  /** Called with the process after its start, for example to interrupt it. */
  readonly started?: (process: ChildProcess) => void;
  /** Content of standard input. */
  readonly input?: string | Uint8Array;
  /** Variables added to the current environment. */
  readonly env?: Readonly<Record<string, string>>;
}

/**
 * Runs `tetrafront` in a folder: in a process of its own if there are options, otherwise in one that runs all such
 * commands of a test file.
 */
export async function tetrafront(
  folder: string,
  args: readonly string[],
  options?: RunOptions,
): Promise<CommandResult> {
  if (options !== undefined) return inOwnProcess(folder, args, options);
  const result = last.then(() => inHost(folder, args));
  last = result.catch(() => undefined);
  return result;
}

/** Settles when the last command in the host has ended. */
let last: Promise<unknown> = Promise.resolve();
let host: ChildProcess | undefined;

function startHost(): ChildProcess {
  const child = fork(new URL("./command-line-host.mjs", import.meta.url), {
    // What the command writes comes in messages; standard output must not be a file.
    stdio: ["ignore", "pipe", "inherit", "ipc"],
  });
  child.once("exit", () => (host = undefined));
  return child;
}

function inHost(folder: string, args: readonly string[]): Promise<CommandResult> {
  const child = (host ??= startHost());
  return new Promise((resolve, reject) => {
    const onExit = (code: number | null) => reject(new Error(`the host of tetrafront ended with ${code}`));
    child.once("exit", onExit).once("message", (result) => {
      child.off("exit", onExit);
      resolve(result as CommandResult);
    });
    child.send({ folder, args });
  });
}

function inOwnProcess(
  folder: string,
  args: readonly string[],
  { started, input, env }: RunOptions,
): Promise<CommandResult> {
  return new Promise((resolve, reject) => {
    const child = spawn(process.execPath, [program, ...args], {
      cwd: folder,
      env: { ...process.env, ...env },
      stdio: ["pipe", "pipe", "pipe"],
    });
    let stdout = "";
    let stderr = "";
    child.stdout.on("data", (chunk: Buffer) => (stdout += chunk.toString()));
    child.stderr.on("data", (chunk: Buffer) => (stderr += chunk.toString()));
    child.on("error", reject);
    child.on("close", (code, signal) => resolve({ code, signal, stdout, stderr }));
    // A program that stops reading its input closes the pipe.
    child.stdin.on("error", () => undefined).end(input);
    started?.(child);
  });
}

/**
 * Returns an environment in which the program, or its parent, gets a signal as soon as its mesh has tetrahedra, or as it
 * has reported this fraction of its work.
 */
export function signalAtProgress(
  signal: NodeJS.Signals,
  target: "program" | "parent",
  fraction?: number,
): Record<string, string> {
  const hook = new URL("./signal-at-progress.mjs", import.meta.url).href;
  return {
    NODE_OPTIONS: `--import "${hook}"`,
    TETRAFRONT_TEST_SIGNAL: signal,
    TETRAFRONT_TEST_TARGET: target,
    ...(fraction !== undefined && { TETRAFRONT_TEST_FRACTION: String(fraction) }),
  };
}

/** Returns an environment in which the program gets a signal while it waits for a worker that never answers again. */
export function signalInLongCall(signal: NodeJS.Signals): Record<string, string> {
  const hook = new URL("./silent-after-signal.mjs", import.meta.url).href;
  return { NODE_OPTIONS: `--import "${hook}"`, TETRAFRONT_TEST_SIGNAL: signal };
}
