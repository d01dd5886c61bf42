/** Runs a command on many files, each in its own process, so that a failure affects one file only. */
import { spawn, type ChildProcess } from "node:child_process";
import { stat } from "node:fs/promises";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { plural } from "../base/plural.js";
import { extensionOf } from "../formats/file-formats.js";
import { emptyName, FileError, STANDARD_STREAM } from "./files.js";
import { ExitCode, print } from "./messages.js";
import { BatchBar } from "./progress-bar.js";
import { endsBy, type EndingSignal, IN_BATCH, offEndingSignals, onEndingSignals } from "./signals.js";
import { enterStage, setBarShown, SILENT } from "./stages.js";

const GLOB = /[*?[\]{}]/;

/**
 * Returns the input files without repetition. Expands patterns that the shell left unexpanded, in alphabetical
 * order.
 */
export async function expandInputs(inputs: readonly string[]): Promise<string[]> {
  const files = await Promise.all(inputs.map(expand));
  const byPath = new Map<string, string>();
  for (const file of files.flat()) {
    const fullPath = file === STANDARD_STREAM ? file : path.resolve(file);
    if (!byPath.has(fullPath)) byPath.set(fullPath, file);
  }
  return [...byPath.values()];
}

async function expand(input: string): Promise<readonly string[]> {
  if (input === "") throw emptyName();
  const isFile = await stat(input).then(
    () => true,
    () => false,
  );
  if (isFile || input === STANDARD_STREAM || !GLOB.test(input)) return [input];
  const { glob } = await import("tinyglobby");
  const { folder, pattern } = splitPattern(input);
  const found = await glob(pattern, { cwd: folder || ".", expandDirectories: false });
  if (found.length === 0) {
    throw new FileError(input, "no file matches this pattern", "Check the path and the pattern.");
  }
  return found.map((name) => folder + name).sort();
}

/**
 * Splits a pattern into its literal folder, with a slash at its end unless it is empty, and the rest: the name of a
 * folder may contain brackets, which have a meaning in patterns. On Windows, a backslash separates folders like a
 * slash; elsewhere it escapes the next character.
 */
export function splitPattern(
  input: string,
  isWindows = process.platform === "win32",
): { readonly folder: string; readonly pattern: string } {
  const steps = (isWindows ? input.replaceAll("\\", "/") : input).split("/");
  const first = steps.findIndex((step) => GLOB.test(step) || (!isWindows && step.includes("\\")));
  const folder = steps.slice(0, first).map((step) => `${step}/`);
  return { folder: folder.join(""), pattern: steps.slice(first).join("/") };
}

/** Placeholder in the name of an output for the input's name without folder and extension. */
const NAME = "{name}";

/** Throws a FileError if the name of an output contains an unknown placeholder in braces. */
export function checkPlaceholders(output: string, known: readonly string[] = [NAME]): void {
  const unknown = output.match(/\{[^{}]*\}/g)?.find((word) => !known.includes(word));
  if (unknown === undefined) return;
  const remedy =
    known.length === 0
      ? "Use a name without braces: there is one report for all inputs."
      : `Use ${known.join(" or ")}, the name of the input without folder and extension, or no braces.`;
  throw new FileError(output, `unknown placeholder ${unknown}`, remedy);
}

/** Returns the output of one of many inputs. Throws a FileError if all inputs would have the same output. */
export function outputFor(input: string, output: string): string {
  if (output.includes(NAME)) return output.replaceAll(NAME, () => nameOf(input));
  throw new FileError(
    output,
    "several inputs would have the same output",
    `Add ${NAME} to its name, for example "meshes/${NAME}.vtu".`,
  );
}

function nameOf(file: string): string {
  const name = path.basename(file);
  return name.slice(0, name.length - extensionOf(name).length) || name;
}

export interface Task {
  readonly input: string;
  readonly args: readonly string[];
}

export interface TaskResult {
  readonly input: string;
  readonly exitCode: number;
  /** What the command wrote to standard output. */
  readonly stdout: string;
}

/**
 * Runs the tasks, `jobs` at a time. Results and messages appear in the order of the tasks: those of a task wait
 * until all earlier tasks have ended.
 */
export async function runTasks(
  tasks: readonly Task[],
  jobs: number,
  isQuiet: boolean,
): Promise<TaskResult[]> {
  const results: TaskResult[] = [];
  const bar = process.stderr.isTTY && !isQuiet ? new BatchBar(tasks.length) : undefined;
  setBarShown(bar !== undefined);
  const messages: string[] = [];
  let next = 0;
  let printed = 0;
  let finished = 0;
  const printInOrder = () => {
    for (let message = messages[printed]; message !== undefined; message = messages[++printed]) {
      if (message === "") continue;
      if (bar === undefined) process.stderr.write(message);
      else bar.print(message);
    }
  };
  const children = new Set<ChildProcess>();
  let isStopped = false;
  // A terminal sends the first signal to all processes. Send the children the other signal, because the same signal
  // received twice would end them immediately.
  const onSignal = (signal: EndingSignal) => {
    process.off(signal, onSignal);
    isStopped = true;
    endsBy(signal);
    for (const child of children) child.kill(signal === "SIGTERM" ? "SIGINT" : "SIGTERM");
  };
  onEndingSignals(onSignal);
  enterStage(`0 of ${plural(tasks.length, "file")} finished`);
  const work = async () => {
    for (let at = next++; at < tasks.length && !isStopped; at = next++) {
      const task = tasks[at];
      if (task === undefined) return;
      const { stderr, ...result } = await runTask(task, children);
      results[at] = result;
      messages[at] = stderr;
      bar?.advance();
      finished++;
      enterStage(`${finished} of ${plural(tasks.length, "file")} finished`);
      printInOrder();
    }
  };
  await Promise.all(Array.from({ length: Math.min(jobs, tasks.length) }, work));
  offEndingSignals(onSignal);
  bar?.stop();
  // Tasks that were not started count as not completed.
  const all = tasks.map(
    ({ input }, at) => results[at] ?? { input, exitCode: ExitCode.notCompleted, stdout: "" },
  );
  if (!isQuiet) print(summaryOf(all));
  return all;
}

/** Returns the highest exit code. */
export function exitCodeOf(results: readonly TaskResult[]): number {
  return Math.max(ExitCode.meshed, ...results.map(({ exitCode }) => exitCode));
}

function summaryOf(results: readonly TaskResult[]): string {
  const count = (code: number) => results.filter(({ exitCode }) => exitCode === code).length;
  const invalid = results.length - count(ExitCode.meshed) - count(ExitCode.notCompleted);
  return `${plural(results.length, "file")}: ${count(ExitCode.meshed)} done, ${count(ExitCode.notCompleted)} not completed, ${invalid} invalid`;
}

const PROGRAM = fileURLToPath(new URL("../../bin/tetrafront.mjs", import.meta.url));

function runTask(
  { input, args }: Task,
  children: Set<ChildProcess>,
): Promise<TaskResult & { readonly stderr: string }> {
  return new Promise((resolve) => {
    const child = spawn(process.execPath, [PROGRAM, ...args], {
      stdio: ["ignore", "pipe", "pipe"],
      env: { ...process.env, [SILENT]: "1", [IN_BATCH]: "1" },
    });
    children.add(child);
    child.on("close", () => children.delete(child));
    const stdout: Buffer[] = [];
    const stderr: Buffer[] = [];
    child.stdout.on("data", (piece: Buffer) => stdout.push(piece));
    child.stderr.on("data", (piece: Buffer) => stderr.push(piece));
    const end = (exitCode: number, more = "") =>
      resolve({ input, exitCode, stdout: textOf(stdout), stderr: textOf(stderr) + more });
    child.on("error", (failure) =>
      end(ExitCode.notCompleted, `tetrafront: error: ${input}: ${failure.message}\n`),
    );
    child.on("close", (code, signal) => {
      if (code !== null) return end(code);
      end(
        ExitCode.notCompleted,
        `tetrafront: error: ${input}: its process was ended by ${signal ?? "an unknown signal"}.\n`,
      );
    });
  });
}

function textOf(pieces: readonly Buffer[]): string {
  return Buffer.concat(pieces).toString("utf8");
}
