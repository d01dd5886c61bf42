/** Runs a command on its inputs: one in this process, several in processes of their own. */
import { availableParallelism } from "node:os";
import type { Command } from "commander";
import { DEFAULT_THREADS } from "../base/limits.js";
import { invalidOption } from "../diagnostics/package-diagnostic.js";
import {
  checkPlaceholders,
  exitCodeOf,
  expandInputs,
  outputFor,
  runTasks,
  type TaskResult,
} from "./batch.js";
import { FileError, STANDARD_STREAM, writeOutput } from "./files.js";
import { numberIn } from "./input.js";
import { InvalidInput, reportFailure } from "./messages.js";
import { checkNoOverwrite, inputFiles, outputFiles } from "./paths.js";

/** Options of the commands that take many inputs. */
interface BatchOptions {
  readonly from?: string;
  readonly to?: string;
  readonly format?: string;
  readonly jobs?: string;
  readonly output?: string;
  readonly report?: string;
  readonly json?: boolean;
  readonly quiet?: boolean;
  /** Whether all inputs are one model. */
  readonly join?: boolean;
  /** All inputs, if they are joined. */
  readonly joined?: readonly string[];
}

/** Calls `one` with the only input, or runs the command once per input; resolves with the exit code. */
export async function forEachInput<Options extends BatchOptions>(
  inputs: readonly string[],
  command: Command,
  one: (input: string, options: Options) => Promise<number>,
): Promise<number> {
  const options = withStreamFormat<Options>(inputs, command.opts());
  try {
    const jobs = jobsOf(options.jobs);
    if (options.output !== undefined) checkPlaceholders(options.output);
    if (options.report !== undefined) checkPlaceholders(options.report, []);
    const files = await expandInputs(inputs);
    const [only] = files;
    if (files.length > 1 && files.includes(STANDARD_STREAM)) {
      throw new FileError(
        "-",
        "standard input cannot be combined with other inputs",
        "Use it as the only input.",
      );
    }
    if (options.join === true && files.length > 1 && only !== undefined) {
      const { output } = options;
      if (output?.includes("{name}") === true)
        throw new FileError(output, "joined inputs have one output", "Omit {name}.");
      return await one(only, { ...options, joined: files });
    }
    if (files.length === 1 && only !== undefined) {
      const { output } = options;
      return await one(
        only,
        output?.includes("{name}") === true ? withOutput(options, only, output) : options,
      );
    }
    return await batch(files, command, options, jobs);
  } catch (failure) {
    return reportFailure(failure, inputs[0] ?? "");
  }
}

function withStreamFormat<Options extends BatchOptions>(
  inputs: readonly string[],
  options: Options,
): Options {
  const { format, from, to, output } = options;
  if (format === undefined) return options;
  const isInput = inputs[0] === STANDARD_STREAM;
  return {
    ...options,
    ...(isInput ? { from: from ?? format } : {}),
    ...(output === STANDARD_STREAM || !isInput ? { to: to ?? format } : {}),
  };
}

function withOutput<Options extends BatchOptions>(options: Options, input: string, output: string): Options {
  return { ...options, output: outputFor(input, output) };
}

async function batch(
  files: readonly string[],
  command: Command,
  options: BatchOptions,
  jobs: number,
): Promise<number> {
  const { output, report, from, to } = options;
  const outputs = output === undefined ? [] : files.map((file) => outputFor(file, output));
  await checkNoOverwrite(
    files.flatMap((file) => inputFiles(file, from, `the input ${file}`)),
    [
      ...outputs.flatMap((file, i) => outputFiles(file, to, `the output of ${files[i]}`)),
      ...(report === undefined ? [] : [{ words: "the report", file: report }]),
    ],
  );
  const threads = sharedThreads(command, Math.min(jobs, files.length));
  const tasks = files.map((input, i) => ({
    input,
    args: [
      command.name(),
      ...givenOptions(command, outputs[i]),
      ...threads,
      ...(report === undefined ? [] : ["--report", "-"]),
      "--",
      input,
    ],
  }));
  const results = await runTasks(tasks, jobs, options.quiet === true);
  const isJson = report !== undefined || options.json === true;
  const text = isJson
    ? `[\n${results.flatMap(jsonOf).join(",\n")}\n]\n`
    : results.map(({ stdout }) => stdout).join("");
  if (report !== undefined || text !== "") await writeOutput(report ?? "-", text);
  return exitCodeOf(results);
}

function jsonOf({ stdout }: TaskResult): string[] {
  return stdout.trim() === "" ? [] : [stdout.trim()];
}

function jobsOf(text: string | undefined): number {
  const jobs = text === undefined ? availableParallelism() : numberIn(text);
  if (Number.isInteger(jobs) && Number(jobs) >= 1) return Number(jobs);
  const wrong = invalidOption(
    "--jobs",
    `the number of jobs is "${text}"`,
    "Use a whole number of at least 1.",
  );
  throw new InvalidInput("command line", [wrong]);
}

/** Returns the option that divides the threads of the machine among jobs at once, if the command has it and it is not given. */
function sharedThreads(command: Command, jobs: number): string[] {
  const isOpen = command.options.some(
    (option) =>
      option.attributeName() === "threads" && command.getOptionValue(option.attributeName()) === undefined,
  );
  const share = Math.min(DEFAULT_THREADS, Math.max(1, Math.floor(availableParallelism() / jobs)));
  return isOpen && jobs > 1 ? ["--threads", `${share}`] : [];
}

/** Returns the options as given, without those of the batch, and with this output. */
function givenOptions(command: Command, output: string | undefined): string[] {
  const own = new Set(["jobs", "report"]);
  return command.options.flatMap((option) => {
    const name = option.attributeName();
    const value = command.getOptionValue(name) as GivenValue;
    const { long } = option;
    if (own.has(name) || value === undefined || long == null) return [];
    // --no-x sets x to false, --x to true.
    if (typeof value === "boolean") return value === option.negate ? [] : [long];
    if (typeof value !== "string") return value.flatMap((one) => [long, one]);
    return [long, name === "output" ? (output ?? value) : value];
  });
}

/** Every option here is a word, a repeatable word or a flag. */
type GivenValue = string | readonly string[] | boolean | undefined;
