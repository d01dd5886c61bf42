/** The command line: options and arguments of `tetrafront` and its commands. Each command has a file of its own. */
import { readFileSync } from "node:fs";
import { availableParallelism } from "node:os";
import { Command, CommanderError, Option } from "commander";
import { DEFAULT_COVER_SHAPE } from "../api/options.js";
import { invalidOption } from "../diagnostics/package-diagnostic.js";
import {
  COVER_SHAPES,
  FRONT_ORDERS,
  INNER_SHELLS,
  INSPECTION_DEFAULTS,
  MESH_DEFAULTS,
  OPTIMIZATIONS,
  PROPOSAL_DEFAULTS,
  REMESH_DEFAULTS,
} from "../generated/constants.js";
import {
  checkPlaceholders,
  exitCodeOf,
  expandInputs,
  outputFor,
  runTasks,
  type TaskResult,
} from "./batch.js";
import { type CheckCommandOptions, checkFile } from "./check.js";
import { type ConvertCommandOptions, convertFile } from "./convert.js";
import { ClosedPipe, FileError, STANDARD_STREAM, writeOutput, writeToStandardOutput } from "./files.js";
import { type CoverCommandOptions, coverFile, type ProposeCommandOptions, proposeForFile } from "./grids.js";
import {
  checkHelp,
  convertHelp,
  COVER_HELP,
  INFO_HELP,
  meshHelp,
  PROGRAM_HELP,
  PROPOSE_HELP,
  remeshHelp,
  STATS_HELP,
} from "./help.js";
import { type InfoCommandOptions, infoOnFile, statsOfFile } from "./info.js";
import { numberIn } from "./input.js";
import { type MeshCommandOptions, meshFile } from "./mesh.js";
import { InvalidInput, ExitCode, reportFailure } from "./messages.js";
import { checkNoOverwrite, inputFiles, outputFiles } from "./paths.js";
import { type RemeshFileOptions, remeshFile } from "./remesh.js";
import { DEFAULT_TREATMENT, SURFACE_TREATMENTS } from "./remeshing.js";

/** Runs the command line; resolves with the exit code. Messages go to stderr. */
export async function main(args: readonly string[]): Promise<number> {
  // Write failures are returned to the writer; without a listener, the error event would end the process with a
  // trace.
  for (const stream of [process.stdout, process.stderr]) stream.on("error", () => undefined);
  let exitCode: number = ExitCode.meshed;
  let helpText = "";
  const program = commandLine(args, {
    setExitCode: (code) => (exitCode = code),
    printHelp: (text) => (helpText += text),
  });
  try {
    await program.parseAsync(withoutHelpOfUnknown(args, program), { from: "user" });
    return exitCode;
  } catch (failure) {
    if (failure instanceof ClosedPipe) return ExitCode.closedPipe;
    if (!(failure instanceof CommanderError)) throw failure;
    return failure.exitCode === 0 ? await writeHelp(helpText) : ExitCode.invalidInput;
  }
}

/** Returns only the name of an unknown command, because its `--help` would print the help of the program. */
function withoutHelpOfUnknown(args: readonly string[], program: Command): readonly string[] {
  const [name] = args;
  if (name === undefined || name.startsWith("-")) return args;
  return program.commands.some((known) => known.name() === name) ? args : [name];
}

/** Writes the help or the version to standard output; resolves with the exit code. */
async function writeHelp(text: string): Promise<number> {
  try {
    await writeToStandardOutput(text);
    return ExitCode.meshed;
  } catch (failure) {
    if (failure instanceof ClosedPipe) return ExitCode.closedPipe;
    return reportFailure(failure, STANDARD_STREAM);
  }
}

interface CommandLineEvents {
  readonly setExitCode: SetExitCode;
  /** Receives the help and the version in pieces. */
  readonly printHelp: (text: string) => void;
}

function commandLine(args: readonly string[], { setExitCode, printHelp }: CommandLineEvents): Command {
  const program = new Command("tetrafront");
  program
    .description("Fills shapes with tetrahedra by the advancing-front method.")
    .version(packageVersion(), "-V, --version", "print the version")
    .helpOption("-h, --help", "print this help")
    .helpCommand(false)
    .configureOutput({
      writeOut: printHelp,
      outputError: (message, write) => write(`tetrafront: ${oneLine(message, program, args)}\n`),
    })
    .exitOverride();
  addMesh(program, setExitCode);
  addRemesh(program, setExitCode);
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
  command.option(
    "-j, --jobs <count>",
    "process at most this many inputs at once (default: one per processor)",
  );

const fromOption = (): Option =>
  new Option("--from <format>", "input format, if the extension does not determine it");
/** One option suffices if only the input or only the output is a stream. */
const formatOption = (): Option =>
  new Option("--format <format>", "format of the stream; for two streams use --from and --to");
/** For commands that read files only. */
const inputFormatOption = (): Option =>
  new Option("--format <format>", "format of standard input; the same as --from");
const toOption = (): Option =>
  new Option("--to <format>", "output format, if the extension does not determine it");

const withRepair = (command: Command): Command =>
  command
    .option(
      "--repair",
      "weld coincident nodes, remove degenerate and duplicate triangles, flip triangles outward",
    )
    .option("--weld <distance>", "repair, and weld nodes within this distance")
    .option("--fill-holes <edges>", "repair, and fill holes of at most this many edges");

const splitOption = (): Option =>
  new Option(
    "--split-patches [angle]",
    `split patches at edges with a larger angle between their triangles, in degrees (default ${REMESH_DEFAULTS.featureAngle})`,
  );
const sourceOption = (): Option =>
  new Option(
    "--source <x,y,z,size[,distance[,growth]]>",
    "limit the size up to a distance from a position, growing beyond it; repeatable",
  ).argParser((text: string, before: string[] | undefined) => [...(before ?? []), text]);
const backgroundOption = (): Option =>
  new Option("-b, --background <file>", "take the sizes from this background grid");

/** `prefix`: what the options are for, if it is not the whole command. */
const withRemeshing = (command: Command, prefix = ""): Command =>
  command
    .option(
      "--min-size <length>",
      `${prefix}smallest size that the shape may ask for (default: 1/10 of --size, or 1/300 of the diagonal)`,
    )
    .option("--max-size <length>", `${prefix}largest automatic size (default: 1/20 of the diagonal)`)
    .option(
      "--tolerance <distance>",
      `${prefix}largest distance from the given surface (default: 1/1000 of the diagonal, at most 1/20 of --size)`,
    )
    .option(
      "--feature-angle <degrees>",
      `${prefix}edges with a larger angle between their triangles stay sharp (default ${REMESH_DEFAULTS.featureAngle})`,
    )
    .option(
      "--angle-per-edge <degrees>",
      `${prefix}largest angle that an edge spans where the surface is curved (default 20; 60 with given sizes)`,
    )
    .option(
      "--layers <count>",
      `${prefix}elements across thin walls; 0 ignores thickness (default 1; 0 with given sizes)`,
    );

/** Runs one input in this process, several in processes of their own. */
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
      throw new FileError(
        "-",
        "standard input cannot be combined with other inputs",
        "Use it as the only input.",
      );
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
  const wrong = invalidOption(
    "--jobs",
    `the number of jobs is "${text}"`,
    "Use a whole number of at least 1.",
  );
  throw new InvalidInput("command line", [wrong]);
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

function addMesh(program: Command, setExitCode: SetExitCode): void {
  const command = program
    .command("mesh")
    .description("Mesh projects, or the inside of closed surfaces, with tetrahedra.")
    .argument("<input...>", "surfaces or projects; patterns such as 'parts/*.stl' are expanded")
    .requiredOption("-o, --output <file>", "output file; for several inputs, its name must contain {name}")
    .addOption(formatOption())
    .addOption(fromOption())
    .addOption(toOption())
    .option(
      "-s, --size <length>",
      "uniform element size for a project (replaces its background grid); largest size for a surface",
    )
    .option(
      "-g, --growth <rate>",
      `growth of the size per unit of distance from a given surface (default ${MESH_DEFAULTS.growth})`,
    )
    .addOption(sourceOption())
    .addOption(backgroundOption())
    .addOption(
      new Option(
        "--surface <treatment>",
        `keep the triangles of a surface, split those larger than the target size, or replace all (default ${DEFAULT_TREATMENT})`,
      ).choices(SURFACE_TREATMENTS),
    )
    .option(
      "--gradation <ratio>",
      `largest size ratio of neighbouring elements of a grid; 0 for no limit (default ${MESH_DEFAULTS.gradation})`,
    )
    .addOption(innerShellsOption())
    .addOption(
      new Option(
        "--order <order>",
        `order in which faces leave the front (default ${MESH_DEFAULTS.order})`,
      ).choices(FRONT_ORDERS),
    )
    .option("--no-filters", "test all faces around each new element; slower, gives the same mesh")
    .addOption(
      new Option(
        "--optimize <level>",
        `effort spent on improving the elements after the front (default ${MESH_DEFAULTS.optimization})`,
      ).choices(OPTIMIZATIONS),
    );
  withJobs(withRepair(withRemeshing(command, "remeshing: ")).addOption(splitOption()))
    .option(
      "--require-angle <degrees>",
      "exit with 1 if the smallest dihedral angle is below this; still write the mesh",
    )
    .option("-r, --report <file>", "write statistics and diagnostics as JSON; - for standard output")
    .option("-k, --keep-partial", "write the mesh even if it is partial")
    .option("-q, --quiet", "print errors only")
    .addHelpText("after", meshHelp)
    .action(async (inputs: string[]) =>
      setExitCode(await forEach<MeshCommandOptions>(inputs, command, meshFile)),
    );
}

function addRemesh(program: Command, setExitCode: SetExitCode): void {
  const command = program
    .command("remesh")
    .description("Replace the triangles of closed surfaces by well-shaped ones, for example of an STL file.")
    .argument("<input...>", "surfaces; patterns such as 'parts/*.stl' are expanded")
    .requiredOption("-o, --output <file>", "output file; for several inputs, its name must contain {name}")
    .addOption(formatOption())
    .addOption(fromOption())
    .addOption(toOption())
    .option("-s, --size <length>", "target edge length (default: automatic, by the shape)")
    .option(
      "-g, --growth <rate>",
      `growth of the size per unit of distance (default ${REMESH_DEFAULTS.growth})`,
    )
    .addOption(sourceOption())
    .addOption(backgroundOption());
  withJobs(withRepair(withRemeshing(command).addOption(innerShellsOption())).addOption(splitOption()))
    .option("--json", "print sizes, triangles, shapes and problems as JSON")
    .option("-q, --quiet", "print errors only")
    .addHelpText("after", remeshHelp)
    .action(async (inputs: string[]) =>
      setExitCode(await forEach<RemeshFileOptions>(inputs, command, remeshFile)),
    );
}

function addConvert(program: Command, setExitCode: SetExitCode): void {
  const command = program
    .command("convert")
    .description("Convert surfaces or meshes to another format.")
    .argument("<input...>", "surfaces or meshes")
    .requiredOption("-o, --output <file>", "output file; for several inputs, its name must contain {name}")
    .addOption(formatOption())
    .addOption(fromOption())
    .addOption(toOption());
  withJobs(withRepair(command).addOption(splitOption()))
    .option("-q, --quiet", "print errors only")
    .addHelpText("after", convertHelp)
    .action(async (inputs: string[]) =>
      setExitCode(await forEach<ConvertCommandOptions>(inputs, command, convertFile)),
    );
}

function addInfo(program: Command, setExitCode: SetExitCode): void {
  const command = program
    .command("info")
    .description(
      "Print the contents of files: points, triangles, tetrahedra, patches, regions, values at nodes.",
    )
    .argument("<input...>", "projects, surfaces or meshes");
  withJobs(command)
    .addOption(inputFormatOption())
    .addOption(fromOption())
    .option("--json", "print JSON")
    .addHelpText("after", INFO_HELP)
    .action(async (inputs: string[]) =>
      setExitCode(await forEach<InfoCommandOptions>(inputs, command, infoOnFile)),
    );
}

function addStats(program: Command, setExitCode: SetExitCode): void {
  const command = program
    .command("stats")
    .description("Print the quality of the elements of volume meshes from any program.")
    .argument("<input...>", "volume meshes");
  withJobs(command)
    .addOption(inputFormatOption())
    .addOption(fromOption())
    .option("--json", "print JSON")
    .addHelpText("after", STATS_HELP)
    .action(async (inputs: string[]) =>
      setExitCode(await forEach<InfoCommandOptions>(inputs, command, statsOfFile)),
    );
}

const shapeOption = (): Option =>
  new Option("--shape <shape>", `shape of the grid (default ${DEFAULT_COVER_SHAPE})`).choices(COVER_SHAPES);

function addCover(program: Command, setExitCode: SetExitCode): void {
  program
    .command("cover")
    .description("Add a background grid of uniform size to a project; its sources are kept.")
    .argument("<project>", "project (.json)")
    .requiredOption("-o, --output <file>", "output project (.json)")
    .option(
      "-s, --size <length>",
      "element size (default: uniform size of the project, else 1/20 of the model's diagonal)",
    )
    .addOption(shapeOption())
    .option("-q, --quiet", "print errors only")
    .addHelpText("after", COVER_HELP)
    .action(async (input: string, options: CoverCommandOptions) =>
      setExitCode(await coverFile(input, options)),
    );
}

function addPropose(program: Command, setExitCode: SetExitCode): void {
  const { elementsPerCircle, elementsPerGap, growth } = PROPOSAL_DEFAULTS;
  program
    .command("propose")
    .description(
      "Propose sizes for the shape of a project: adds sources at curved lines and patches and in narrow gaps, and a covering grid.",
    )
    .argument("<project>", "project (.json)")
    .requiredOption("-o, --output <file>", "output project (.json)")
    .option(
      "--uniform <length>",
      "largest size (default: uniform size of the project, else 1/20 of the model's diagonal)",
    )
    .option("--smallest <length>", "smallest size (default: 1/50 of the largest)")
    .option(
      "--per-circle <count>",
      `elements around a full circle; 0 for no limit (default ${elementsPerCircle})`,
    )
    .option(
      "--per-gap <count>",
      `elements between opposite patches; 0 for no limit (default ${elementsPerGap})`,
    )
    .option("-g, --growth <rate>", `growth of the size per unit of distance from sources (default ${growth})`)
    .addOption(shapeOption())
    .option("-q, --quiet", "print errors only")
    .addHelpText("after", PROPOSE_HELP)
    .action(async (input: string, options: ProposeCommandOptions) =>
      setExitCode(await proposeForFile(input, options)),
    );
}

function innerShellsOption(): Option {
  return new Option(
    "--inner-shells <meaning>",
    `leave closed shells inside a region empty, or mesh them as regions (default ${MESH_DEFAULTS.innerShells})`,
  ).choices(INNER_SHELLS);
}

function addCheck(program: Command, setExitCode: SetExitCode): void {
  const command = program
    .command("check")
    .description("List all problems of projects, surfaces or meshes.")
    .argument("<input...>", "projects, surfaces or meshes")
    .option("-s, --size <length>", "check a project for this uniform size instead of its background grid")
    .addOption(innerShellsOption())
    .option(
      "--max-diagnostics <count>",
      `list at most this many problems of each kind for a surface, or all (default ${INSPECTION_DEFAULTS.maxDiagnostics}; without --json 50)`,
    )
    .addOption(inputFormatOption())
    .addOption(fromOption());
  withJobs(withRepair(command))
    .option("--json", "print problems and statistics as JSON")
    .option("-q, --quiet", "print errors only")
    .addHelpText("after", checkHelp)
    .action(async (inputs: string[]) =>
      setExitCode(await forEach<CheckCommandOptions>(inputs, command, checkFile)),
    );
}

/** Formats commander's messages as one line with a remedy, like all others. */
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
