/** The command line: what `tetrafront` understands. What it does is in cli-mesh.ts. */
import { readFileSync } from "node:fs";

import { Command, CommanderError, Option } from "commander";

import { ExitCode, meshFile, type MeshCommandOptions } from "./cli-mesh.js";
import {
  DEFAULT_GRADATION,
  DEFAULT_GROWTH,
  DEFAULT_OPTIMIZATION,
  DEFAULT_ORDER,
  FRONT_ORDERS,
  OPTIMIZATIONS,
} from "./options.js";

const EXAMPLES = `
Input
  model.json   a Tetrafront project: points, lines, patches, background grid
  part.stl     a closed triangle surface, STL binary or ASCII
  part.off     a closed triangle surface, OFF

Output
  mesh.vtu     for ParaView, VTK, meshio
  mesh.msh     Gmsh 4.1, with the patches and regions as named physical groups

Exit code
  0  meshed    1  not completed (stalled, cancelled)    2  bad input

Examples
  tetrafront mesh duct.json -o duct.vtu
  tetrafront mesh duct.json -o duct.msh --size 0.05
  tetrafront mesh part.stl -o part.vtu --report report.json
`;

/** Runs the command line; resolves with the exit code. Messages go to stderr. */
export async function main(args: readonly string[]): Promise<number> {
  let exitCode: number = ExitCode.meshed;
  const program = commandLine((code) => (exitCode = code));
  try {
    await program.parseAsync(args, { from: "user" });
    return exitCode;
  } catch (failure) {
    if (failure instanceof CommanderError) return failure.exitCode === 0 ? 0 : ExitCode.badInput;
    throw failure;
  }
}

function commandLine(setExitCode: (code: number) => void): Command {
  const program = new Command("tetrafront");
  program
    .description("Fills shapes with tetrahedra by the advancing-front method.")
    .version(packageVersion(), "-V, --version", "print the version")
    .helpOption("-h, --help", "print this help")
    .helpCommand(false)
    .configureOutput({ outputError: (message, write) => write(`tetrafront: ${oneLine(message)}\n`) })
    .exitOverride();
  program
    .command("mesh")
    .description("Mesh a project or fill a closed surface with tetrahedra.")
    .argument("<input>", "project (.json) or closed surface (.stl, .off)")
    .requiredOption("-o, --output <file>", "where the mesh goes (.vtu or .msh)")
    .option("-s, --size <length>", "uniform element size; replaces a project's background grid")
    .option("-g, --growth <rate>", `growth of the size away from a given surface (default ${DEFAULT_GROWTH})`)
    .option(
      "--gradation <ratio>",
      `the most by which a grid's sizes grow from element to element; 0: as they are (default ${DEFAULT_GRADATION})`,
    )
    .addOption(
      new Option(
        "--order <order>",
        `in which order faces leave the front (default ${DEFAULT_ORDER})`,
      ).choices(Object.keys(FRONT_ORDERS)),
    )
    .addOption(
      new Option(
        "--optimize <level>",
        `work on the shape of the elements after the front (default ${DEFAULT_OPTIMIZATION})`,
      ).choices(Object.keys(OPTIMIZATIONS)),
    )
    .option("-r, --report <file>", "write figures and diagnostics as JSON; - for standard output")
    .option("-k, --keep-partial", "write what exists even if the mesh is not complete")
    .option("-q, --quiet", "print errors only")
    .addHelpText("after", EXAMPLES)
    .action(async (input: string, options: MeshCommandOptions) =>
      setExitCode(await meshFile(input, options)),
    );
  program.addHelpText("after", "\nTry: tetrafront mesh --help");
  return program;
}

/** Commander's complaints, with a remedy, as one line like all others. */
function oneLine(message: string): string {
  const text = message.trim().replace(/\s*\n\s*/g, " ");
  return `${text}${/[.)]$/.test(text) ? "" : "."} See: tetrafront mesh --help`;
}

function packageVersion(): string {
  const text = readFileSync(new URL("../package.json", import.meta.url), "utf8");
  return (JSON.parse(text) as { version: string }).version;
}
