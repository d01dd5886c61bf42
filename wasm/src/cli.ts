/** The command line: what `tetrafront` understands. What its commands do is in cli-mesh.ts and others. */
import { readFileSync } from "node:fs";

import { Command, CommanderError, Option } from "commander";

import { checkFile, type CheckCommandOptions } from "./cli-check.js";
import {
  coverFile,
  proposeForFile,
  type CoverCommandOptions,
  type ProposeCommandOptions,
} from "./cli-grids.js";
import { meshFile, type MeshCommandOptions } from "./cli-mesh.js";
import { ExitCode } from "./cli-messages.js";
import {
  COVER_SHAPES,
  DEFAULT_COVER_SHAPE,
  DEFAULT_GRADATION,
  DEFAULT_GROWTH,
  DEFAULT_OPTIMIZATION,
  DEFAULT_ORDER,
  DEFAULT_PROPOSAL,
  FRONT_ORDERS,
  OPTIMIZATIONS,
} from "./options.js";

const EXAMPLES = `
Input
  model.json   a Tetrafront project: points, lines, patches, background grid
  part.stl     a closed triangle surface, STL binary or ASCII
  part.off     a closed triangle surface, OFF
  part.obj     a closed triangle surface, OBJ
  part.ply     a closed triangle surface, PLY binary or ASCII

Background grid (--background)
  model.json   the grid and the sources of another project
  mesh.vtu     a volume mesh with sizes at its nodes (named "size"; "stretching" and
  mesh.msh     "direction" too), else with sizes from its own edges

Output
  mesh.vtu     for ParaView, VTK, meshio
  mesh.msh     Gmsh 4.1, with the patches and regions as named physical groups
  mesh.vtk     legacy VTK
  mesh.mesh    Medit, with patches and regions as references
  mesh.su2     SU2, with the patches as markers

Exit code
  0  meshed    1  not completed (stalled, cancelled)    2  bad input

Examples
  tetrafront mesh duct.json -o duct.vtu
  tetrafront mesh duct.json -o duct.msh --size 0.05
  tetrafront mesh part.stl -o part.vtu --report report.json
  tetrafront mesh duct.json -o finer.vtu --background sizes.vtu
`;

/** Runs the command line; resolves with the exit code. Messages go to stderr. */
export async function main(args: readonly string[]): Promise<number> {
  let exitCode: number = ExitCode.meshed;
  const program = commandLine(args, (code) => (exitCode = code));
  try {
    await program.parseAsync(args, { from: "user" });
    return exitCode;
  } catch (failure) {
    if (failure instanceof CommanderError) return failure.exitCode === 0 ? 0 : ExitCode.badInput;
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
  addCover(program, setExitCode);
  addPropose(program, setExitCode);
  addCheck(program, setExitCode);
  program.addHelpText("after", "\nTry: tetrafront mesh --help");
  return program;
}

type SetExitCode = (code: number) => void;

function addMesh(program: Command, setExitCode: SetExitCode): void {
  program
    .command("mesh")
    .description("Mesh a project or fill a closed surface with tetrahedra.")
    .argument("<input>", "project (.json) or closed surface (.stl, .off, .obj, .ply)")
    .requiredOption("-o, --output <file>", "where the mesh goes (.vtu, .msh, .vtk, .mesh or .su2)")
    .option("-s, --size <length>", "uniform element size; replaces a project's background grid")
    .option("-b, --background <file>", "sizes from this background grid (.json, .vtu or .msh) instead")
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
    .option("--no-filters", "analyse all faces around each new element: the same mesh, slower")
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
    .option("-s, --size <length>", "element size (default a twentieth of the model's diagonal)")
    .addOption(shapeOption())
    .option("-q, --quiet", "print errors only")
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
    .option("--uniform <length>", "the largest size (default a twentieth of the model's diagonal)")
    .option("--smallest <length>", "no size below this (default a fiftieth of the largest)")
    .option("--per-circle <count>", `elements around a full turn (default ${elementsPerCircle}; 0: any)`)
    .option("--per-gap <count>", `elements between opposite patches (default ${elementsPerGap}; 0: any)`)
    .option("-g, --growth <rate>", `growth of the size away from sources (default ${growth})`)
    .addOption(shapeOption())
    .option("-q, --quiet", "print errors only")
    .action(async (input: string, options: ProposeCommandOptions) =>
      setExitCode(await proposeForFile(input, options)),
    );
}

function addCheck(program: Command, setExitCode: SetExitCode): void {
  program
    .command("check")
    .description("List everything that is wrong with a project. Exit code 2 where there are errors.")
    .argument("<project>", "project (.json)")
    .option("-s, --size <length>", "the uniform size it will be meshed with; its grid is not checked")
    .option("--json", "the diagnostics as JSON, on standard output")
    .option("-q, --quiet", "print errors only")
    .action(async (input: string, options: CheckCommandOptions) =>
      setExitCode(await checkFile(input, options)),
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
  const text = readFileSync(new URL("../package.json", import.meta.url), "utf8");
  return (JSON.parse(text) as { version: string }).version;
}
