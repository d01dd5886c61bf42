/** The commands of `tetrafront` with their options and arguments. What each one does has a file of its own. */
import { type Command, Option } from "commander";
import {
  FRONT_ORDERS,
  ADAPT_DEFAULTS,
  LAYER_DEFAULTS,
  IMPROVE_DEFAULTS,
  INSPECTION_DEFAULTS,
  MESH_DEFAULTS,
  INTERIORS,
  OPTIMIZATIONS,
  PROPOSAL_DEFAULTS,
  REMESH_DEFAULTS,
} from "../generated/constants.js";
import { DEFAULT_CYCLES } from "../api/adaptation-cycles.js";
import { SURFACE_TREATMENTS } from "../api/option-types.js";
import { IMPROVEMENT_LEVELS } from "../api/mesh-options.js";
import { type CheckCommandOptions, checkFile } from "./check.js";
import { type ConvertCommandOptions, convertFile } from "./convert.js";
import { elementOrderOption } from "./element-order.js";
import { forEachInput } from "./each-input.js";
import { type CoverCommandOptions, coverFile } from "./grids.js";
import {
  checkHelp,
  convertHelp,
  COVER_HELP,
  adaptHelp,
  improveHelp,
  INFO_HELP,
  meshHelp,
  PROPOSE_HELP,
  remeshHelp,
  sizesHelp,
  STATS_HELP,
  TRACE_HELP,
  transferHelp,
} from "./help.js";
import { type AdaptCommandOptions, adaptFile } from "./adapt.js";
import { type ImproveCommandOptions, improveFile } from "./improve.js";
import { type InfoCommandOptions, infoOnFile, statsOfFile } from "./info.js";
import { type MeshCommandOptions, meshFile } from "./mesh.js";
import { propose, type ProposeOptions } from "./propose.js";
import { type RemeshFileOptions, remeshFile } from "./remesh.js";
import { type TraceCommandOptions, traceFile } from "./trace.js";
import { FRONT_SEARCHES, MAX_TOLERANCE } from "../trace/experiment.js";
import {
  sizesOfFile,
  type SizesCommandOptions,
  transferFile,
  type TransferCommandOptions,
} from "./solution.js";
import { withUnits } from "./units.js";
import {
  backgroundOption,
  fieldOption,
  layersOption,
  formatOption,
  fromOption,
  innerShellsOption,
  inputFormatOption,
  shapeOption,
  sourceOption,
  splitOption,
  threadsOption,
  toOption,
  withJobs,
  withRemeshing,
  withRepair,
  withSolutionSizes,
} from "./shared-options.js";

export type SetExitCode = (code: number) => void;

/** Adds all commands, in the order of the help. `setExitCode` gets the exit code of the one that runs. */
export function addCommands(program: Command, setExitCode: SetExitCode): void {
  addMesh(program, setExitCode);
  addRemesh(program, setExitCode);
  addImprove(program, setExitCode);
  addAdapt(program, setExitCode);
  addCheck(program, setExitCode);
  addConvert(program, setExitCode);
  addInfo(program, setExitCode);
  addStats(program, setExitCode);
  addCover(program, setExitCode);
  addPropose(program, setExitCode);
  addSizes(program, setExitCode);
  addTransfer(program, setExitCode);
  addTrace(program, setExitCode);
}

function addMesh(program: Command, setExitCode: SetExitCode): void {
  const command = program
    .command("mesh")
    .description("Mesh projects, or the inside of closed surfaces, with tetrahedra.")
    .argument("<input...>", "surfaces or projects; patterns such as 'parts/*.stl' are expanded")
    .requiredOption("-o, --output <file>", "output file; for several inputs, its name must contain {name}")
    .addOption(formatOption())
    .addOption(fromOption())
    .addOption(toOption());
  withFront(command).addOption(
    new Option(
      "--optimize <level>",
      `effort spent on improving the elements after the front (default ${MESH_DEFAULTS.optimization})`,
    ).choices(OPTIMIZATIONS),
  );
  command.addOption(
    new Option(
      "--interior <kind>",
      "what fills the deep inside: the front, lattices where sizes are nearly constant, or (auto, the default) lattices in large meshes",
    ).choices(INTERIORS),
  );
  command.addOption(threadsOption());
  withUnits(withJobs(withRepair(withRemeshing(command, "remeshing: ")).addOption(splitOption())))
    .option(
      "--elements <count>",
      "number of elements to reach within 5 %: all sizes are multiplied by one factor; surfaces are remeshed",
    )
    .option(
      "--require-angle <degrees>",
      "exit with 1 if the smallest dihedral angle is below this; still write the mesh",
    )
    .option("-r, --report <file>", "write statistics and diagnostics as JSON; - for standard output")
    .addOption(elementOrderOption())
    .option("--join", "mesh all surfaces as one model: each solid a region, shared faces interfaces")
    .option("-k, --keep-partial", "write the mesh even if it is partial")
    .option("-q, --quiet", "print errors only")
    .addHelpText("after", meshHelp)
    .action(async (inputs: string[]) =>
      setExitCode(await forEachInput<MeshCommandOptions>(inputs, command, meshFile)),
    );
}

/** Adds the options that decide how the front advances. */
function withFront(command: Command): Command {
  return command
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
        "keep the triangles of a surface, split those larger than the target size, or replace all; auto keeps fit triangles, and replaces needles and those too large for a thin body (default auto; remesh for CAD files)",
      ).choices(SURFACE_TREATMENTS),
    )
    .option(
      "--gradation <ratio>",
      `largest size ratio of neighbouring elements of a grid; 0 for no limit (default ${MESH_DEFAULTS.gradation})`,
    )
    .option("--max-volume <volume>", "largest volume of a tetrahedron (default: no limit)")
    .addOption(innerShellsOption())
    .addOption(
      new Option(
        "--order <order>",
        `order in which faces leave the front (default ${MESH_DEFAULTS.order})`,
      ).choices(FRONT_ORDERS),
    )
    .option("--no-filters", "test all faces around each new element; slower, gives the same mesh");
}

function addTrace(program: Command, setExitCode: SetExitCode): void {
  const command = program
    .command("trace")
    .description(
      "Record every step of the fronts while a project or surface is meshed, or describe a recording.",
    )
    .argument("<input>", "project or surface; or a trace (.tft), with --summary")
    .option("-o, --output <file>", "output file (.tft)")
    .addOption(inputFormatOption())
    .addOption(fromOption());
  withUnits(withRepair(withRemeshing(withFront(command), "remeshing: ")).addOption(splitOption()))
    .option("--no-relaxation", "experiment: leave faces that cannot be completed to recovery at once")
    .option(
      "--front-tolerance <factor>",
      `experiment: factor of the distance at which a node is too close to a face, 0 to ${MAX_TOLERANCE} (default 1)`,
    )
    .addOption(
      new Option(
        "--search <method>",
        "experiment: how nearby faces are found; linear compares all, and makes the same mesh (default grid)",
      ).choices(FRONT_SEARCHES),
    )
    .option(
      "--summary",
      "print the counts of the trace as JSON: steps, accepted, refused by reason, postponed",
    )
    .option("-q, --quiet", "print errors only")
    .addHelpText("after", TRACE_HELP)
    .action(
      async (input: string, { format, ...options }: TraceCommandOptions & { readonly format?: string }) =>
        setExitCode(await traceFile(input, { ...options, ...(format !== undefined && { from: format }) })),
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
  withUnits(
    withJobs(withRepair(withRemeshing(command).addOption(innerShellsOption())).addOption(splitOption())),
  )
    .option("--json", "print sizes, triangles, shapes and problems as JSON")
    .option("-q, --quiet", "print errors only")
    .addHelpText("after", remeshHelp)
    .action(async (inputs: string[]) =>
      setExitCode(await forEachInput<RemeshFileOptions>(inputs, command, remeshFile)),
    );
}

function addAdapt(program: Command, setExitCode: SetExitCode): void {
  const command = program
    .command("adapt")
    .description(
      "Adapt a mesh, or the mesh of a model, to the metric of a background mesh, to layers along patches, or in cycles to the solution of a solver.",
    )
    .argument("<model>", "volume mesh, CAD file, surface or project")
    .requiredOption("-o, --output <file>", "output file")
    .option("-b, --background <file>", "volume mesh with the metric at its nodes; not with --solver")
    .addOption(layersOption())
    .option(
      "--solver <command>",
      "command that reads {mesh} and writes {solution}; run once per cycle, with --elements or --error",
    )
    .option(
      "--cycles <count>",
      `number of cycles with the solver (default ${DEFAULT_CYCLES}), or for layers at most (default ${LAYER_DEFAULTS.cycles})`,
    )
    .option("--resume", "continue an earlier run with its folder")
    .option("--folder <folder>", "folder for the files of the cycles (default: named after the output)")
    .option("--mesh-format <format>", "format of the meshes for the solver (default vtu)")
    .option(
      "--solution-format <format>",
      "format of the solver's solutions, or sol for values alone (default: that of the meshes)",
    )
    .addOption(fieldOption());
  withSolutionSizes(command)
    .option("--conservative", "keep the integrals of the fields from mesh to mesh (default: interpolate)")
    .option(
      "--quality <q>",
      `quality that every element should reach (default ${ADAPT_DEFAULTS.leastQuality})`,
    )
    .option("--sweeps <count>", `sweeps of improvement at most (default ${ADAPT_DEFAULTS.sweeps})`)
    .addOption(threadsOption())
    .addOption(fromOption())
    .addOption(toOption());
  withUnits(command)
    .option("--json", "print lengths and qualities, or what each cycle made, as JSON")
    .option("-q, --quiet", "print errors only")
    .addHelpText("after", adaptHelp)
    .action(async (input: string, options: AdaptCommandOptions) =>
      setExitCode(await adaptFile(input, options)),
    );
}

function addImprove(program: Command, setExitCode: SetExitCode): void {
  const command = program
    .command("improve")
    .description("Improve the elements of volume meshes from any program; the boundary stays as it is.")
    .argument("<input...>", "volume meshes; patterns such as 'meshes/*.vtu' are expanded")
    .requiredOption("-o, --output <file>", "output file; for several inputs, its name must contain {name}")
    .addOption(formatOption())
    .addOption(fromOption())
    .addOption(toOption())
    .addOption(
      new Option("--optimize <level>", "effort spent on the elements (default default)").choices(
        IMPROVEMENT_LEVELS,
      ),
    )
    .option(
      "--max-growth <fraction>",
      `elements that may be added, as a fraction of those given (default ${IMPROVE_DEFAULTS.maxGrowth})`,
    );
  withUnits(withJobs(command))
    .option("--json", "print shapes before and after, and problems, as JSON")
    .option("-q, --quiet", "print errors only")
    .addHelpText("after", improveHelp)
    .action(async (inputs: string[]) =>
      setExitCode(await forEachInput<ImproveCommandOptions>(inputs, command, improveFile)),
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
  withUnits(withJobs(withRepair(command).addOption(splitOption())))
    .addOption(elementOrderOption())
    .option("-q, --quiet", "print errors only")
    .addHelpText("after", convertHelp)
    .action(async (inputs: string[]) =>
      setExitCode(await forEachInput<ConvertCommandOptions>(inputs, command, convertFile)),
    );
}

function addInfo(program: Command, setExitCode: SetExitCode): void {
  const command = program
    .command("info")
    .description(
      "Print the contents of files: points, triangles, tetrahedra, patches, regions, values at nodes.",
    )
    .argument("<input...>", "projects, surfaces or meshes");
  withUnits(withJobs(command))
    .addOption(inputFormatOption())
    .addOption(fromOption())
    .option("--json", "print JSON")
    .addHelpText("after", INFO_HELP)
    .action(async (inputs: string[]) =>
      setExitCode(await forEachInput<InfoCommandOptions>(inputs, command, infoOnFile)),
    );
}

function addStats(program: Command, setExitCode: SetExitCode): void {
  const command = program
    .command("stats")
    .description("Print the quality of the elements of volume meshes from any program.")
    .argument("<input...>", "volume meshes");
  withUnits(withJobs(command))
    .addOption(inputFormatOption())
    .addOption(fromOption())
    .option("--json", "print JSON")
    .addHelpText("after", STATS_HELP)
    .action(async (inputs: string[]) =>
      setExitCode(await forEachInput<InfoCommandOptions>(inputs, command, statsOfFile)),
    );
}

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
  const command = program
    .command("propose")
    .description(
      "Propose sizes for the shape of a project or a surface. A project gets sources at curved lines and patches and in narrow gaps, and a covering grid; for a surface, the sizes and the expected numbers of elements are printed.",
    )
    .argument("<input>", "project (.json) or surface")
    .option("-o, --output <file>", "output project (.json), for a project")
    .option("--min-size <length>", "smallest size that the shape may ask for (default: 1/50 of the largest)")
    .option(
      "--max-size <length>",
      "largest size (default: uniform size of the project, else 1/20 of the model's diagonal)",
    )
    .option(
      "--angle-per-edge <degrees>",
      `largest angle that an edge spans where the shape is curved; 0 for a project omits it (default ${360 / elementsPerCircle})`,
    )
    .option(
      "--layers <count>",
      `elements across thin walls and narrow gaps; 0 ignores thickness (default ${elementsPerGap})`,
    )
    .option("-g, --growth <rate>", `growth of the size per unit of distance from sources (default ${growth})`)
    .addOption(shapeOption())
    .addOption(inputFormatOption())
    .addOption(fromOption())
    .option("--json", "print JSON, for a surface")
    .option("-q, --quiet", "print errors only")
    .addHelpText("after", PROPOSE_HELP)
    .action(async (input: string, { format, ...options }: ProposeOptions & { readonly format?: string }) =>
      setExitCode(await propose(input, { ...options, from: options.from ?? format })),
    );
  withUnits(command);
}

function addSizes(program: Command, setExitCode: SetExitCode): void {
  const command = program
    .command("sizes")
    .description("Make a background grid from the fields of a solver: small elements where they bend.")
    .argument("<solution>", "volume mesh with values at its nodes")
    .requiredOption("-o, --output <file>", "output file: the mesh with sizes at its nodes")
    .addOption(fieldOption());
  withUnits(withSolutionSizes(command))
    .addOption(fromOption())
    .addOption(toOption())
    .option("-q, --quiet", "print errors only")
    .addHelpText("after", sizesHelp)
    .action(async (input: string, options: SizesCommandOptions) =>
      setExitCode(await sizesOfFile(input, options)),
    );
}

function addTransfer(program: Command, setExitCode: SetExitCode): void {
  const command = program
    .command("transfer")
    .description("Transfer the fields of a solver from one volume mesh to another.")
    .argument("<from>", "volume mesh with values at its nodes")
    .argument("<to>", "volume mesh")
    .requiredOption("-o, --output <file>", "output file: the second mesh with the fields")
    .addOption(fieldOption())
    .option("--conservative", "keep the integrals of the fields (default: interpolate)")
    .addOption(fromOption())
    .addOption(toOption())
    .option("-q, --quiet", "print errors only")
    .addHelpText("after", transferHelp);
  withUnits(command).action(async (from: string, to: string, options: TransferCommandOptions) =>
    setExitCode(await transferFile(from, to, options)),
  );
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
      `list at most this many problems of each kind for a surface, or all (default ${INSPECTION_DEFAULTS.maxDiagnostics}; without --json 5)`,
    )
    .addOption(inputFormatOption())
    .addOption(fromOption());
  withUnits(withJobs(withRepair(command)))
    .option("--join", "check all surfaces as one model, as mesh --join")
    .option("--json", "print problems and statistics as JSON")
    .option("-q, --quiet", "print errors only")
    .addHelpText("after", checkHelp)
    .action(async (inputs: string[]) =>
      setExitCode(await forEachInput<CheckCommandOptions>(inputs, command, checkFile)),
    );
}
