import { spawn, type ChildProcess } from "node:child_process";
import { fileURLToPath } from "node:url";

const program = fileURLToPath(new URL("../../wasm/bin/tetrafront.mjs", import.meta.url));

export interface CommandResult {
  readonly code: number | null;
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

/** Runs `tetrafront` in a folder. */
export function tetrafront(
  folder: string,
  args: readonly string[],
  { started, input, env }: RunOptions = {},
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
    child.on("close", (code) => resolve({ code, stdout, stderr }));
    // A program that stops reading its input closes the pipe.
    child.stdin.on("error", () => undefined).end(input);
    started?.(child);
  });
}

/**
 * Returns an environment in which the program, or its parent, gets a signal as soon as its mesh has
 * tetrahedra.
 */
export function signalAtProgress(
  signal: NodeJS.Signals,
  target: "program" | "parent",
): Record<string, string> {
  const hook = new URL("./signal-at-progress.mjs", import.meta.url).href;
  return {
    NODE_OPTIONS: `--import "${hook}"`,
    TETRAFRONT_TEST_SIGNAL: signal,
    TETRAFRONT_TEST_TARGET: target,
  };
}
