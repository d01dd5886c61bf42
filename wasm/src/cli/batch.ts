/** Many files by one command: each in a process of its own, so that one failure is one failure. */
import { spawn, type ChildProcess } from "node:child_process";
import { stat } from "node:fs/promises";
import path from "node:path";
import { fileURLToPath } from "node:url";

import { FileProblem, nameless, STANDARD_STREAM } from "./files.js";
import { ExitCode, say } from "./messages.js";
import { BatchBar } from "./progress-bar.js";
import { extensionOf } from "../formats/file-formats.js";
import { plural } from "../base/plural.js";

const GLOB = /[*?[\]{}]/;

/** The files meant, each once: patterns that the shell left alone are expanded, in alphabetical order. */
export async function expandInputs(inputs: readonly string[]): Promise<string[]> {
  const files = await Promise.all(inputs.map(expand));
  const places = new Map<string, string>();
  for (const file of files.flat()) {
    const place = file === STANDARD_STREAM ? file : path.resolve(file);
    if (!places.has(place)) places.set(place, file);
  }
  return [...places.values()];
}

async function expand(input: string): Promise<readonly string[]> {
  if (input === "") throw nameless();
  const isFile = await stat(input).then(
    () => true,
    () => false,
  );
  if (isFile || input === STANDARD_STREAM || !GLOB.test(input)) return [input];
  const { glob } = await import("tinyglobby");
  const { folder, pattern } = splitPattern(input);
  const found = await glob(pattern, { cwd: folder || ".", expandDirectories: false });
  if (found.length === 0) {
    throw new FileProblem(input, "no file matches this pattern", "Check the path and the pattern.");
  }
  return found.map((name) => folder + name).sort();
}

/**
 * The folder that a pattern names in plain words, with a slash at its end if it is not "", and the pattern in it:
 * a folder's name may hold brackets, which mean something in patterns. On Windows a backslash parts folders as a
 * slash does; elsewhere it takes the meaning from the character behind it.
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

/** Stands for the input's name without folder and extension, in the name of an output. */
const NAME = "{name}";

/** Throws a FileProblem where the name of an output has something in braces that stands for nothing. */
export function checkPlaceholders(output: string, known: readonly string[] = [NAME]): void {
  const unknown = output.match(/\{[^{}]*\}/g)?.find((word) => !known.includes(word));
  if (unknown === undefined) return;
  const remedy =
    known.length === 0
      ? "Give a name without braces: there is one report for all inputs."
      : `Give ${known.join(" or ")}, the input's name without folder and extension, or no braces.`;
  throw new FileProblem(output, `${unknown} stands for nothing here`, remedy);
}

/** Where the output of one of many inputs goes. Throws a FileProblem where the name cannot tell them apart. */
export function outputFor(input: string, output: string): string {
  if (output.includes(NAME)) return output.replaceAll(NAME, () => nameOf(input));
  throw new FileProblem(
    output,
    "several inputs would go into one output",
    `Put ${NAME} into its name, for example "meshes/${NAME}.vtu".`,
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
  /** What the command said on standard output. */
  readonly stdout: string;
}

/**
 * Runs the tasks, `jobs` at a time. Results and messages come in the order of the tasks: those of one wait until
 * all before it have ended.
 */
export async function runTasks(
  tasks: readonly Task[],
  jobs: number,
  isQuiet: boolean,
): Promise<TaskResult[]> {
  const results: TaskResult[] = [];
  const bar = process.stderr.isTTY && !isQuiet ? new BatchBar(tasks.length) : undefined;
  const messages: string[] = [];
  let next = 0;
  let told = 0;
  const tellInOrder = () => {
    for (let said = messages[told]; said !== undefined; said = messages[++told]) {
      if (said === "") continue;
      if (bar === undefined) process.stderr.write(said);
      else bar.say(said);
    }
  };
  const children = new Set<ChildProcess>();
  let isStopped = false;
  // Of a terminal all hear the first: told by the other signal, none hears one twice, which would end it at once.
  const stopBy = (other: NodeJS.Signals) => () => {
    isStopped = true;
    for (const child of children) child.kill(other);
  };
  const [onInterrupt, onEnd] = [stopBy("SIGTERM"), stopBy("SIGINT")];
  process.once("SIGINT", onInterrupt).once("SIGTERM", onEnd);
  const work = async () => {
    for (let at = next++; at < tasks.length && !isStopped; at = next++) {
      const task = tasks[at];
      if (task === undefined) return;
      const { stderr, ...result } = await runTask(task, children);
      results[at] = result;
      messages[at] = stderr;
      bar?.advance();
      tellInOrder();
    }
  };
  await Promise.all(Array.from({ length: Math.min(jobs, tasks.length) }, work));
  process.off("SIGINT", onInterrupt).off("SIGTERM", onEnd);
  bar?.stop();
  // What was not begun was not completed.
  const all = tasks.map(
    ({ input }, at) => results[at] ?? { input, exitCode: ExitCode.notCompleted, stdout: "" },
  );
  if (!isQuiet) say(summaryOf(all));
  return all;
}

/** As the worst of them. */
export function exitCodeOf(results: readonly TaskResult[]): number {
  return Math.max(ExitCode.meshed, ...results.map(({ exitCode }) => exitCode));
}

function summaryOf(results: readonly TaskResult[]): string {
  const count = (code: number) => results.filter(({ exitCode }) => exitCode === code).length;
  const bad = results.length - count(ExitCode.meshed) - count(ExitCode.notCompleted);
  return `${plural(results.length, "file")}: ${count(ExitCode.meshed)} done, ${count(ExitCode.notCompleted)} not completed, ${bad} bad`;
}

const PROGRAM = fileURLToPath(new URL("../../bin/tetrafront.mjs", import.meta.url));

function runTask(
  { input, args }: Task,
  children: Set<ChildProcess>,
): Promise<TaskResult & { readonly stderr: string }> {
  return new Promise((resolve) => {
    const child = spawn(process.execPath, [PROGRAM, ...args], { stdio: ["ignore", "pipe", "pipe"] });
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
      end(ExitCode.notCompleted, `tetrafront: error: ${input}: its process was ended by ${signal ?? "?"}.\n`);
    });
  });
}

function textOf(pieces: readonly Buffer[]): string {
  return Buffer.concat(pieces).toString("utf8");
}
