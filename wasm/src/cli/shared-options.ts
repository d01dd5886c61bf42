/** Options that several commands have. */
import { type Command, Option } from "commander";
import { DEFAULT_COVER_SHAPE } from "../api/grid-options.js";
import {
  COVER_SHAPES,
  INNER_SHELLS,
  MESH_DEFAULTS,
  REMESH_DEFAULTS,
  SOLUTION_SIZE_DEFAULTS,
} from "../generated/constants.js";

export const withJobs = (command: Command): Command =>
  command.option(
    "-j, --jobs <count>",
    "process at most this many inputs at once (default: one per processor)",
  );

export const threadsOption = (): Option =>
  new Option(
    "--threads <count>",
    "number of threads that optimize large meshes; the mesh is the same for any number (default: those of the machine, at most 8)",
  );

export const fromOption = (): Option =>
  new Option("--from <format>", "input format, if the extension does not determine it");
/** One option suffices if only the input or only the output is a stream. */
export const formatOption = (): Option =>
  new Option("--format <format>", "format of the stream; for two streams use --from and --to");
/** For commands that read files only. */
export const inputFormatOption = (): Option =>
  new Option("--format <format>", "format of standard input; the same as --from");
export const toOption = (): Option =>
  new Option("--to <format>", "output format, if the extension does not determine it");

export const withRepair = (command: Command): Command =>
  command
    .option(
      "--repair",
      "weld coincident nodes, remove degenerate and duplicate triangles, flip triangles outward; resolve the rest",
    )
    .option("--weld <distance>", "repair, and weld nodes within this distance")
    .option("--fill-holes <edges>", "repair, and fill holes of at most this many edges, no others");

export const splitOption = (): Option =>
  new Option(
    "--split-patches [angle]",
    `split patches at edges with a larger angle between their triangles, in degrees (default ${REMESH_DEFAULTS.featureAngle})`,
  );
export const sourceOption = (): Option =>
  new Option(
    "--source <x,y,z,size[,distance[,growth]]>",
    "limit the size up to a distance from a position, growing beyond it; repeatable",
  ).argParser((text: string, before: string[] | undefined) => [...(before ?? []), text]);
export const fieldOption = (): Option =>
  new Option("-f, --field <name>", "field to use; repeatable (default: all)").argParser(
    (name: string, before: string[] | undefined) => [...(before ?? []), name],
  );
export const layersOption = (): Option =>
  new Option(
    "--layers <patch:first:growth:count>",
    "layers along a patch, or * for all: height of the first, ratio of the next, and their number; repeatable",
  ).argParser((text: string, before: string[] | undefined) => [...(before ?? []), text]);
/** Adds the options of sizes that follow from a solution. */
export const withSolutionSizes = (command: Command): Command =>
  command
    .option("-n, --elements <count>", "number of elements; either this or --error")
    .option("-e, --error <value>", "interpolation error of each field, in its unit and the norm")
    .option(
      "--indicator <name>",
      "field that estimates the error of each node or element; it decides how large elements are, and --field their shape (default: the interpolation error)",
    )
    .option(
      "--indicator-order <power>",
      `power of the size with which the indicator falls (default ${SOLUTION_SIZE_DEFAULTS.indicatorOrder})`,
    )
    .option("--norm <norm>", "norm of the error: L1, L2, L4 or max (default L2)")
    .option("--isotropic", "one size at each node")
    .option("--min-size <length>", "smallest size (default: no limit)")
    .option("--max-size <length>", "largest size (default: diagonal of the mesh)")
    .option(
      "--max-aspect <ratio>",
      `largest ratio of two sizes at a node (default ${SOLUTION_SIZE_DEFAULTS.maxAspect})`,
    )
    .option(
      "--gradation <ratio>",
      `largest size ratio of neighbouring elements; 0 for no limit (default ${1 + SOLUTION_SIZE_DEFAULTS.growth})`,
    );

export const backgroundOption = (): Option =>
  new Option("-b, --background <file>", "take the sizes from this background grid");

/** `prefix`: what the options are for, if it is not the whole command. */
export const withRemeshing = (command: Command, prefix = ""): Command =>
  command
    .option(
      "--min-size <length>",
      `${prefix}smallest size that the shape may ask for (default: 1/10 of --size, or 1/150 of the diagonal; smaller at tiny details)`,
    )
    .option("--max-size <length>", `${prefix}largest automatic size (default: 1/15 of the diagonal)`)
    .option(
      "--tolerance <distance>",
      `${prefix}largest distance from the given surface (default: 1/250 of the diagonal, of several solids of that of the smallest, and at most half of the mean thickness; with given sizes 1/700, at most 1/20 of --size)`,
    )
    .option(
      "--feature-angle <degrees>",
      `${prefix}edges with a larger angle between their triangles stay sharp (default ${REMESH_DEFAULTS.featureAngle})`,
    )
    .option(
      "--angle-per-edge <degrees>",
      `${prefix}largest angle that an edge spans where the surface is curved (default 36; 60 with given sizes)`,
    )
    .option(
      "--layers <count>",
      `${prefix}elements across thin walls; 0 ignores thickness (default 1; 0 with given sizes)`,
    )
    .option(
      "--drop-details <length>",
      `${prefix}merge sharp edges that are nearer to each other than this; 0 keeps all (default: see Small details)`,
    );

export const innerShellsOption = (): Option =>
  new Option(
    "--inner-shells <meaning>",
    `what closed shells inside a region bound: cavities, regions, or bodies if they face outward (default ${MESH_DEFAULTS.innerShells})`,
  ).choices(INNER_SHELLS);

export const shapeOption = (): Option =>
  new Option("--shape <shape>", `shape of the grid (default ${DEFAULT_COVER_SHAPE})`).choices(COVER_SHAPES);
