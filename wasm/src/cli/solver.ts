/** Runs a solver's command: its words with the files' names, its output, its failure, and its end if the user cancels. */
import { spawn } from "node:child_process";
import { createWriteStream } from "node:fs";
import { rm, stat } from "node:fs/promises";
import { cancelledError } from "../diagnostics/mesher-error.js";
import { packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import { SolverFailure } from "./messages.js";

/** What the words in braces of a command stand for. */
export interface SolverFiles {
  /** File with the mesh, which the solver reads. */
  readonly mesh: string;
  /** File with the solution, which the solver writes. */
  readonly solution: string;
  /** File that receives the solver's output. */
  readonly log: string;
  readonly cycle: number;
}

/** Number of the last lines of output in a message, and their longest length. */
const LAST_LINES = 8;
const LINE_LENGTH = 200;
/** Bytes of the end of the output that are kept. */
const KEPT_BYTES = 1 << 14;
/** Time from the request to end until the solver is killed, in milliseconds. */
const GRACE_MS = 500;

/**
 * Runs the command in a shell. {mesh}, {solution} and {cycle} in it are replaced; if it has neither of the first two, both names
 * follow it. Throws a SolverFailure if the command fails or writes no solution, and a `MesherError` if the signal is aborted.
 */
export async function runSolver(command: string, files: SolverFiles, signal: AbortSignal): Promise<void> {
  assertNotAborted(signal);
  await rm(files.solution, { force: true });
  const end = await ended(commandFor(command, files), files.log, signal);
  assertNotAborted(signal);
  const { reason, output } = end;
  const where = `in cycle ${files.cycle}`;
  if (reason !== undefined)
    throw failure(`the solver failed ${where} ${reason}: ${command}${lastLines(output)}`, files);
  const written = await stat(files.solution).catch(() => undefined);
  if (written?.isFile() === true) return;
  throw failure(
    `the solver wrote no solution ${where}: ${command} ended without an error, but there is no file ${files.solution}${lastLines(output)}`,
    files,
  );
}

function assertNotAborted(signal: AbortSignal): void {
  if (signal.aborted) throw cancelledError(signal);
}

/** Returns the command with the names of the files. */
export function commandFor(command: string, { mesh, solution, cycle }: SolverFiles): string {
  const values: Readonly<Record<string, string>> = {
    "{mesh}": quoted(mesh),
    "{solution}": quoted(solution),
    "{cycle}": String(cycle),
  };
  const replaced = command.replace(/\{(?:mesh|solution|cycle)\}/g, (word) => values[word] ?? word);
  return /\{(?:mesh|solution)\}/.test(command) ? replaced : `${replaced} ${quoted(mesh)} ${quoted(solution)}`;
}

/** Returns a name as one word of the shell. */
function quoted(name: string): string {
  if (process.platform === "win32") return `"${name}"`;
  return /^[\w./-]+$/.test(name) ? name : `'${name.replaceAll("'", "'\\''")}'`;
}

interface SolverEnd {
  /** How it failed; undefined if it did not. */
  readonly reason: string | undefined;
  /** End of its output. */
  readonly output: string;
}

function ended(command: string, log: string, signal: AbortSignal): Promise<SolverEnd> {
  return new Promise((resolve, reject) => {
    // In a group of its own, the solver and all that it has started end together.
    const hasGroup = process.platform !== "win32";
    const child = spawn(command, { shell: true, detached: hasGroup, stdio: ["ignore", "pipe", "pipe"] });
    const file = createWriteStream(log);
    file.on("error", () => undefined);
    let output = "";
    const onOutput = (piece: Buffer): void => {
      file.write(piece);
      output = (output + piece.toString()).slice(-KEPT_BYTES);
    };
    child.stdout.on("data", onOutput);
    child.stderr.on("data", onOutput);
    const send = (name: NodeJS.Signals): void => {
      try {
        if (hasGroup && child.pid !== undefined) process.kill(-child.pid, name);
        else child.kill(name);
      } catch {
        // It has ended.
      }
    };
    let timer: ReturnType<typeof setTimeout> | undefined;
    const onAbort = (): void => {
      send("SIGTERM");
      timer = setTimeout(() => send("SIGKILL"), GRACE_MS);
    };
    signal.addEventListener("abort", onAbort, { once: true });
    const finish = (): void => {
      clearTimeout(timer);
      signal.removeEventListener("abort", onAbort);
      file.end();
    };
    child.on("error", (problem) => {
      finish();
      reject(problem);
    });
    child.on("close", (code, killedBy) => {
      finish();
      const reason =
        code === 0 ? undefined : code === null ? `by ${killedBy ?? "a signal"}` : `with exit code ${code}`;
      resolve({ reason, output });
    });
  });
}

function lastLines(output: string): string {
  const lines = output
    .split(/\r?\n/)
    .filter((line) => line.trim() !== "")
    .slice(-LAST_LINES);
  if (lines.length === 0) return "; it printed nothing";
  return `; its last lines: ${lines.map((line) => line.slice(0, LINE_LENGTH)).join(" | ")}`;
}

function failure(message: string, { log }: SolverFiles): SolverFailure {
  const remedy = `Correct the solver, then continue with --resume; all of its output is in ${log}.`;
  return new SolverFailure([packageDiagnostic("solver-failed", message, remedy)]);
}
