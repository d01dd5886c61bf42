/** The command line: what `tetrafront` understands. What its commands do is in mesh.ts and others. */
import { readFileSync } from "node:fs";

import { availableParallelism } from "node:os";

import { Command, CommanderError, Option } from "commander";

import {
  checkPlaceholders,
  exitCodeOf,
  expandInputs,
  outputFor,
  runTasks,
  type TaskResult,
} from "./batch.js";
import { checkFile, type CheckCommandOptions } from "./check.js";
import { convertFile, type ConvertCommandOptions } from "./convert.js";
import { ClosedPipe, FileProblem, STANDARD_STREAM, writeOutput } from "./files.js";
import { coverFile, proposeForFile, type CoverCommandOptions, type ProposeCommandOptions } from "./grids.js";
import {
  checkHelp,
  convertHelp,
  COVER_HELP,
  INFO_HELP,
  meshHelp,
  PROGRAM_HELP,
  PROPOSE_HELP,
  STATS_HELP,
} from "./help.js";
import { infoOnFile, statsOfFile, type InfoCommandOptions } from "./info.js";
import { numberIn } from "./input.js";
import { meshFile, type MeshCommandOptions } from "./mesh.js";
import { BadInput, ExitCode, toldFailure } from "./messages.js";
import { checkApart, inputFiles, outputFiles } from "./places.js";
import { invalidOption } from "../diagnostics/package-diagnostic.js";
import {
  COVER_SHAPES,
  DEFAULT_COVER_SHAPE,
  DEFAULT_MAX_DIAGNOSTICS,
  DEFAULT_GRADATION,
  DEFAULT_GROWTH,
  DEFAULT_OPTIMIZATION,
  DEFAULT_INNER_SHELLS,
  DEFAULT_ORDER,
  DEFAULT_PROPOSAL,
  INNER_SHELLS,
  FRONT_ORDERS,
  OPTIMIZATIONS,
} from "../api/options.js";

/** Runs the command line; resolves with the exit code. Messages go to stderr. */
export async function main(args: readonly string[]): Promise<number> {
  // Their failures come back to those who write; the events would end the process with a trace.
  for (const stream of [process.stdout, process.stderr]) stream.on("error", () => undefined);
  let exitCode: number = ExitCode.meshed;
  const program = commandLine(args, (code) => (exitCode = code));
  try {
    await program.parseAsync(args, { from: "user" });
    return exitCode;
  } catch (failure) {
    if (failure instanceof CommanderError) return failure.exitCode === 0 ? 0 : ExitCode.badInput;
    if (failure instanceof ClosedPipe) return ExitCode.closedPipe;
    throw failure;
  }
}

function commandLine(args: readonly string[], setExitCode: SetExitCode): Command {
  const program = new Command("tetrafront");
  program
    .description("Fills shapes with tetrahedra by the advancing-front method.")
    .version(packageVersion(), "-V, --version", "print the version")
    .helpOption("-h, --help", "print this help")
    .helpCommand(false)
    .configureOutput({
      outputError: (message, write) => write(`tetrafront: ${oneLine(message, program, args)}\n`),
    })
    .exitOverride();
  addMesh(program, setExitCode);
  addCheck(program, setExitCode);
  addConvert(program, setExitCode);
  addInfo(program, setExitCode);
  addStats(program, setExitCode);
  addCover(program, setExitCode);
  addPropose(program, setExitCode);
  program.addHelpText("after", PROGRAM_HELP);
  return program;
}

type SetExitCode = (code: number) => void;

interface BatchOptions {
  readonly from?: string;
  readonly to?: string;
  readonly format?: string;
  readonly jobs?: string;
  readonly output?: string;
  readonly report?: string;
  readonly json?: boolean;
  readonly quiet?: boolean;
}

const withJobs = (command: Command): Command =>
  command.option("-j, --jobs <count>", "of many inputs, so many at a time (default: one per processor)");

const fromOption = (): Option =>
  new Option("--from <format>", "the input's format, where its name does not tell");
/** Where only one of input and output is a stream, one word is enough. */
const formatOption = (): Option =>
  new Option("--format <format>", "of the stream; --from and --to tell it of both");
const toOption = (): Option =>
  new Option("--to <format>", "the output's format, where its name does not tell");

const withRepair = (command: Command): Command =>
  command
    .option("--repair", "join nodes at one place, drop triangles without area or twice there, turn them")
    .option("--weld <distance>", "repair, and join nodes no further apart than this")
    .option("--fill-holes <edges>", "repair, and fill holes of up to so many edges");

/** One input is done here, several in processes of their own. */
async function forEach<Options extends BatchOptions>(
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
      throw new FileProblem("-", "standard input is given among other inputs", "Give it alone.");
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
    return toldFailure(failure, inputs[0] ?? "");
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
  await checkApart(
    files.flatMap((file) => inputFiles(file, from, `the input ${file}`)),
    [
      ...outputs.flatMap((file, i) => outputFiles(file, to, `the output of ${files[i]}`)),
      ...(report === undefined ? [] : [{ words: "the report", file: report }]),
    ],
  );
  const tasks = files.map((input, i) => ({
    input,
    args: [
      command.name(),
      ...givenOptions(command, outputs[i]),
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
  const wrong = invalidOption("--jobs", `the number of jobs is "${text}"`, "Give a whole number from 1.");
  throw new BadInput("command line", [wrong]);
}

/** The options as they were given, but for those that are the batch's own, and with this output. */
function givenOptions(command: Command, output: string | undefined): string[] {
  const own = new Set(["jobs", "report"]);
  return command.options.flatMap((option) => {
    const name = option.attributeName();
    const value = command.getOptionValue(name) as GivenValue;
    const { long } = option;
    if (own.has(name) || value === undefined || long == null) return [];
    // --no-x is given where x is false, --x where it is true.
    if (typeof value === "boolean") return value === option.negate ? [] : [long];
    if (typeof value !== "string") return value.flatMap((one) => [long, one]);
    return [long, name === "output" ? (output ?? value) : value];
  });
}

/** All options here are words, words that may be repeated, or flags. */
type GivenValue = string | readonly string[] | boolean | undefined;

function addMesh(program: Command, setExitCode: SetExitCode): void {
  const command = program
    .command("mesh")
    .description("Fill closed surfaces, or mesh projects, with tetrahedra.")
    .argument("<input...>", "surfaces or projects; patterns such as 'parts/*.stl' are expanded")
    .requiredOption("-o, --output <file>", "where the mesh goes; for many inputs with {name} in it")
    .addOption(formatOption())
    .addOption(fromOption())
    .addOption(toOption())
    .option(
      "-s, --size <length>",
      "one element size: replaces a project's background grid, and is the largest within a surface",
    )
    .option(
      "-g, --grading <rate>",
      `growth of the size away from a given surface (default ${DEFAULT_GROWTH})`,
    )
    .addOption(new Option("--growth <rate>", "the older name of --grading").hideHelp())
    .addOption(
      new Option(
        "--source <x,y,z,size[,distance[,growth]]>",
        "elements no larger than size up to a distance from a place, growing beyond; may be repeated",
      ).argParser((text: string, before: string[] | undefined) => [...(before ?? []), text]),
    )
    .option("-b, --background <file>", "sizes from this background grid instead")
    .option(
      "--refine-surface",
      "divide a surface's triangles that are larger than the elements wanted there, first",
    )
    .option(
      "--gradation <ratio>",
      `the most by which a grid's sizes grow from element to element; 0: as they are (default ${DEFAULT_GRADATION})`,
    )
    .addOption(enclosedOption())
    .addOption(
      new Option(
        "--order <order>",
        `in which order faces leave the front (default ${DEFAULT_ORDER})`,
      ).choices(Object.keys(FRONT_ORDERS)),
    )
    .option("--no-filters", "analyse all faces around each new element: the same mesh, slower")
    .addOption(
      new Option(
        "--optimize <level>",
        `work on the shape of the elements after the front (default ${DEFAULT_OPTIMIZATION})`,
      ).choices(Object.keys(OPTIMIZATIONS)),
    );
  withJobs(withRepair(command))
    .option("-r, --report <file>", "write figures and diagnostics as JSON; - for standard output")
    .option("-k, --keep-partial", "write what exists even if the mesh is not complete")
    .option("-q, --quiet", "print errors only")
    .addHelpText("after", meshHelp)
    .action(async (inputs: string[]) =>
      setExitCode(await forEach<MeshCommandOptions>(inputs, command, meshFile)),
    );
}

function addConvert(program: Command, setExitCode: SetExitCode): void {
  const command = program
    .command("convert")
    .description("Write surfaces or meshes in another format.")
    .argument("<input...>", "surfaces or meshes")
    .requiredOption("-o, --output <file>", "where it goes; for many inputs with {name} in it")
    .addOption(formatOption())
    .addOption(fromOption())
    .addOption(toOption());
  withJobs(withRepair(command))
    .option("-q, --quiet", "print errors only")
    .addHelpText("after", convertHelp)
    .action(async (inputs: string[]) =>
      setExitCode(await forEach<ConvertCommandOptions>(inputs, command, convertFile)),
    );
}

function addInfo(program: Command, setExitCode: SetExitCode): void {
  const command = program
    .command("info")
    .description("Tell what files hold: points, triangles, tetrahedra, patches, regions, numbers at nodes.")
    .argument("<input...>", "projects, surfaces or meshes");
  withJobs(command)
    .addOption(formatOption())
    .addOption(fromOption())
    .option("--json", "as JSON")
    .addHelpText("after", INFO_HELP)
    .action(async (inputs: string[]) =>
      setExitCode(await forEach<InfoCommandOptions>(inputs, command, infoOnFile)),
    );
}

function addStats(program: Command, setExitCode: SetExitCode): void {
  const command = program
    .command("stats")
    .description("Tell how good the elements of meshes are, whoever made them.")
    .argument("<input...>", "volume meshes");
  withJobs(command)
    .addOption(formatOption())
    .addOption(fromOption())
    .option("--json", "as JSON")
    .addHelpText("after", STATS_HELP)
    .action(async (inputs: string[]) =>
      setExitCode(await forEach<InfoCommandOptions>(inputs, command, statsOfFile)),
    );
}

const shapeOption = (): Option =>
  new Option("--shape <shape>", `of the grid (default ${DEFAULT_COVER_SHAPE})`).choices(
    Object.keys(COVER_SHAPES),
  );

function addCover(program: Command, setExitCode: SetExitCode): void {
  program
    .command("cover")
    .description("Put a background grid of one size around a project; its sources stay.")
    .argument("<project>", "project (.json)")
    .requiredOption("-o, --output <file>", "where the project with its grid goes (.json)")
    .option(
      "-s, --size <length>",
      "element size (default the project's one size, else a twentieth of the model's diagonal)",
    )
    .addOption(shapeOption())
    .option("-q, --quiet", "print errors only")
    .addHelpText("after", COVER_HELP)
    .action(async (input: string, options: CoverCommandOptions) =>
      setExitCode(await coverFile(input, options)),
    );
}

function addPropose(program: Command, setExitCode: SetExitCode): void {
  const { elementsPerCircle, elementsPerGap, growth } = DEFAULT_PROPOSAL;
  program
    .command("propose")
    .description(
      "Propose sizes from a project's shape: sources along bends and in narrow gaps, added to those it has, and a covering grid.",
    )
    .argument("<project>", "project (.json)")
    .requiredOption("-o, --output <file>", "where the project with its sizes goes (.json)")
    .option(
      "--uniform <length>",
      "the largest size (default the project's one size, else a twentieth of the model's diagonal)",
    )
    .option("--smallest <length>", "no size below this (default a fiftieth of the largest)")
    .option("--per-circle <count>", `elements around a full turn (default ${elementsPerCircle}; 0: any)`)
    .option("--per-gap <count>", `elements between opposite patches (default ${elementsPerGap}; 0: any)`)
    .option("-g, --growth <rate>", `growth of the size away from sources (default ${growth})`)
    .addOption(shapeOption())
    .option("-q, --quiet", "print errors only")
    .addHelpText("after", PROPOSE_HELP)
    .action(async (input: string, options: ProposeCommandOptions) =>
      setExitCode(await proposeForFile(input, options)),
    );
}

function enclosedOption(): Option {
  return new Option(
    "--enclosed <meaning>",
    `what closed parts within a body bound: empty spaces, or regions meshed too (default ${DEFAULT_INNER_SHELLS})`,
  ).choices(Object.keys(INNER_SHELLS));
}

function addCheck(program: Command, setExitCode: SetExitCode): void {
  const command = program
    .command("check")
    .description("List everything that is wrong with projects, surfaces or meshes.")
    .argument("<input...>", "projects, surfaces or meshes")
    .option("-s, --size <length>", "the size a project will be meshed with; its grid is not checked")
    .addOption(enclosedOption())
    .option(
      "--findings <count>",
      `list so many problems of each kind of a surface, or all (default ${DEFAULT_MAX_DIAGNOSTICS}; as text the first 50)`,
    )
    .addOption(formatOption())
    .addOption(fromOption());
  withJobs(withRepair(command))
    .option("--json", "findings and figures as JSON, on standard output")
    .option("-q, --quiet", "print errors only")
    .addHelpText("after", checkHelp)
    .action(async (inputs: string[]) =>
      setExitCode(await forEach<CheckCommandOptions>(inputs, command, checkFile)),
    );
}

/** Commander's complaints, with a remedy, as one line like all others. */
function oneLine(message: string, program: Command, args: readonly string[]): string {
  const text = message.trim().replace(/\s*\n\s*/g, " ");
  const command = program.commands.find((known) => known.name() === args[0]);
  const help = ["tetrafront", ...(command === undefined ? [] : [command.name()]), "--help"].join(" ");
  return `${text}${/[.)]$/.test(text) ? "" : "."} See: ${help}`;
}

function packageVersion(): string {
  const text = readFileSync(new URL("../../package.json", import.meta.url), "utf8");
  return (JSON.parse(text) as { version: string }).version;
}
