import { spawn, type ChildProcess } from "node:child_process";
import { fileURLToPath } from "node:url";

const program = fileURLToPath(new URL("../../wasm/bin/tetrafront.mjs", import.meta.url));

export interface CommandResult {
  readonly code: number | null;
  readonly stdout: string;
  readonly stderr: string;
}

interface RunOptions {
  /** Is told of the process, for those who want to interrupt it. */
  readonly started?: (process: ChildProcess) => void;
  /** On standard input. */
  readonly input?: string | Uint8Array;
  /** Beside the environment that there is. */
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
    // Who does not read it all closes the pipe.
    child.stdin.on("error", () => undefined).end(input);
    started?.(child);
  });
}

/** Environment in which a program, or its parent, gets a signal as soon as its mesh has tetrahedra. */
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
