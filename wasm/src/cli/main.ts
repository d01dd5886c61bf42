/** The command line: runs `tetrafront` with its arguments, and words what is wrong with them. */
import { readFileSync } from "node:fs";
import { Command, CommanderError } from "commander";
import { addCommands, type SetExitCode } from "./commands.js";
import { ClosedPipe, STANDARD_STREAM, writeToStandardOutput } from "./files.js";
import { PROGRAM_HELP } from "./help.js";
import { ExitCode, reportFailure } from "./messages.js";
import { exitCodeAfterSignals, IN_BATCH } from "./signals.js";
import { startStageLines } from "./stages.js";

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
  let stop = (): void => undefined;
  program.hook("preAction", (_, command) => {
    if (command.opts<{ readonly quiet?: boolean }>().quiet !== true) stop = startStageLines();
  });
  try {
    await program.parseAsync(withoutHelpOfUnknown(args, program), { from: "user" });
    return process.env[IN_BATCH] === undefined ? exitCodeAfterSignals(exitCode) : exitCode;
  } catch (failure) {
    if (failure instanceof ClosedPipe) return ExitCode.closedPipe;
    if (!(failure instanceof CommanderError)) throw failure;
    return failure.exitCode === 0 ? await writeHelp(helpText) : ExitCode.invalidInput;
  } finally {
    stop();
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
  addCommands(program, setExitCode);
  program.addHelpText("after", PROGRAM_HELP);
  return program;
}

/** What does the work of commands that a user may expect. Commander suggests only commands that are written alike. */
const HINTS: ReadonlyMap<string, string> = new Map([
  [
    "repair",
    "(Did you mean `tetrafront convert IN -o OUT --repair`? mesh, remesh and check have --repair too.)",
  ],
  ["refine", "(Did you mean `tetrafront mesh IN -o OUT --surface refine`?)"],
  ["optimize", "(Did you mean improve?)"],
  ["inspect", "(Did you mean check?)"],
  ["validate", "(Did you mean check?)"],
]);

/** Formats commander's messages as one line with a remedy, like all others. */
function oneLine(message: string, program: Command, args: readonly string[]): string {
  const [name = ""] = args;
  const isUnknown = program.commands.every((known) => known.name() !== name);
  const hint = isUnknown ? (HINTS.get(name) ?? "") : "";
  const text = `${message.trim()} ${hint}`.trim().replace(/\s*\n\s*/g, " ");
  const command = program.commands.find((known) => known.name() === args[0]);
  const help = ["tetrafront", ...(command === undefined ? [] : [command.name()]), "--help"].join(" ");
  return `${text}${/[.)]$/.test(text) ? "" : "."} See: ${help}`;
}

function packageVersion(): string {
  const text = readFileSync(new URL("../../package.json", import.meta.url), "utf8");
  return (JSON.parse(text) as { version: string }).version;
}
