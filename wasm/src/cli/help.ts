/** Help texts below the options of each command. */
import type { Contents } from "../formats/file-format.js";
import { FILE_FORMATS } from "../formats/file-formats.js";
import { LAYER_DEFAULTS } from "../generated/constants.js";

/** Returns one line per format that can read, or write, any of the contents. */
function formatLines(list: "readable" | "writable", ...contents: readonly Contents[]): string {
  return FILE_FORMATS.filter((format) => contents.some((held) => format[list].includes(held)))
    .map(({ name, extensions }) => `  ${extensions.join(", ").padEnd(21)} ${name}`)
    .join("\n");
}

const EXIT_CODES_HELP = `
Exit code
  0  done    1  not completed: stalled, cancelled, out of memory, not written    2  invalid input
  With several inputs, the highest of their codes. Ctrl-C during meshing cancels it (1; SIGTERM: 143); \`mesh\` still writes
  the report, with the statistics of a remeshing that was stopped; \`remesh\` and \`improve\` write what they have
  made so far. Otherwise, or if a step does not answer within a second, it ends the command without a partial
  file (130; SIGTERM: 143; SIGHUP: 129).

Progress
  A terminal shows a bar. Elsewhere, a line every ten seconds names the step, the share that is done, and the
  time; --quiet leaves it out.`;

const READING_HELP = `
Formats: the input formats of \`tetrafront convert --help\`; - is standard input.`;

/** Explains the quality measures. */
const QUALITY_HELP = `
Quality
  Dihedral angles, between two faces of an element, are best near 70.5 degrees; 30 to 135 degrees are good.
  The radius ratio, three times the inscribed radius / circumscribed radius, is 1 for the regular
  tetrahedron and 0 for a degenerate one.`;

export const meshHelp = () => `
Input
  .json                 Tetrafront project: points, lines, patches, background grid
${formatLines("readable", "surface")}
  -                     standard input; set its format with --format

Output
${formatLines("writable", "volume")}
  -                     standard output; set its format with --format

Element sizes
  A size is an edge length in the unit of the file. A project defines its own sizes. For a surface, sizes
  start at its edges and grow inwards by --growth up to --size. --background takes the sizes from a project,
  or from a mesh with node values "size" (also "stretching" and "direction", "secondStretching" and
  "secondDirection"; without "size", "metric", else its edges).
  --source limits the sizes around a position. --max-volume caps all sizes, and tetrahedra that are larger
  nonetheless are split; the boundary does not change.

Number of elements
  --elements makes as many elements as you ask for, within 5 %. All sizes, those of a project, a grid or a source
  too, are multiplied by one factor, which a few runs find; surfaces are remeshed. Fewer elements make flat faces
  coarser first, then curved ones, then thin walls. If the shape permits no such number, or --surface keep keeps
  its triangles, the mesh has the nearest one, and a warning states the least or the most. --report has both numbers.

Regions
  Hole points of TetGen's .smesh and .poly files keep volumes empty; region points number regions and limit the
  volume of their tetrahedra. The smallest of these limits also applies to triangles that are split or replaced.
  Without such points, closed shells inside a region of these files are regions, unless --inner-shells is
  cavities. In other files, a closed shell inside a region is a region if its triangles face outward, as those
  around it, and bounds a cavity if they face inward; --inner-shells decides otherwise.

CAD files
  STEP, IGES and BREP files are triangulated, remeshed and, if needed, repaired. Each solid becomes a region, in
  millimetres, each of its faces a patch, and a face, or part of one, that two solids share an interface.

  --join meshes several files as one model, for example the parts of an assembly. Where solids touch, they share an
  interface, named after both, and the mesh fits together.

Surfaces
  By default, --surface auto, the mesh keeps every triangle of other surfaces if they are fit. If more than 2 %
  have an angle below 10 degrees, as in STL files of CAD programs, or one below 0.5 degrees, or an option of a
  remeshing such as --max-size or --tolerance is given, all are replaced. If an edge is longer than twice the target length, fit triangles are
  split. Fine cracks between them are welded. Notes state what was done. --join and
  several solids do not change this.

  --surface keep keeps all triangles. If a triangle is larger than the target size, so are the elements next
  to it; further inside, sizes decrease by --growth, at most 0.5 per unit of distance. Needle triangles lead to
  elements with small angles. Warnings report both.
  --surface refine first splits triangles that are larger than the target size, or than small ones near them
  permit, and keeps the shape.
  --surface remesh first replaces all triangles by well-shaped ones near the given surface. Without sizes, it
  chooses them by the shape. \`tetrafront remesh --help\` explains its options.
  Bodies of a project have a treatment of their own.

Element order
  --element-order 2 writes second-order elements, with a node at the middle of every edge, as VTU, VTK, MSH,
  INP or BDF. Edges follow the curved faces of CAD files, also of those in a project. The edges of a surface
  that consists of triangles stay straight. The report has the scaled Jacobian of the elements.

Interior
  The deep inside of a mesh of 10 000 or more elements is filled with lattices, where sizes are nearly constant
  over some elements and not stretched; only the rest is left to the front, so that the time grows with the
  surface rather than with the volume. --interior front fills everything by the front, and --interior lattice
  uses lattices in smaller meshes too. The report has the number of their elements as interior.lattice.

Threads
  Large meshes, with 60 000 elements or more outside lattices, are optimized in tiles by several threads, each
  with an engine and one tile at a time. The mesh is the same for any number of --threads. By default, they are
  the threads of the machine, at most 8, divided by the number of inputs that are processed at once.

Element shapes
  --optimize none keeps the mesh as the front made it. fast, default and thorough improve it, each taking
  longer. --require-angle makes a mesh with a smaller dihedral angle fail with exit code 1. The output file
  is written nevertheless, and the report has the error "required-angle".
${QUALITY_HELP}

Patches
  Patches of a surface become boundaries of the mesh, with their names. --split-patches divides them at edges
  that are sharper than its angle. The new patches are numbered from the lowest one up: "patch 1", "patch 2";
  pieces of a named patch are called "wing", "wing 2".

Surfaces with problems
  \`tetrafront check\` lists the problems of a surface. Before needles are replaced, it is repaired if it cannot be
  filled and nothing that is seen changes. Other repairs are made only if you ask for them. --repair welds coincident
  nodes, removes degenerate and duplicate triangles, and flips triangles outward. If that is not
  enough, it closes cracks and holes, and cuts triangles where they intersect: the boundary of what they enclose
  remains. --surface remesh repairs in the same way if necessary. --weld also welds nodes within a distance,
  --fill-holes also closes small holes. Messages and the report list every change.
${EXIT_CODES_HELP}

Examples
  tetrafront mesh part.stl -o part.vtu
  tetrafront mesh part.step -o part.vtu
  tetrafront mesh part.step -o part.vtu --elements 50000
  tetrafront mesh base.step post.step -o assembly.msh --join
  tetrafront mesh surface.ply -o mesh.vtu
  tetrafront mesh part.stl -o part.msh --size 0.05 --report report.json
  tetrafront mesh part.stl -o part.msh --split-patches
  tetrafront mesh part.stl -o part.vtu --source 0,0,1,0.01,0.2
  tetrafront mesh scan.ply -o scan.vtu --weld 1e-6 --fill-holes 20
  tetrafront mesh duct.json -o finer.vtu --background sizes.vtu
  tetrafront mesh part.stl -o part.vtu --optimize thorough --require-angle 10
  tetrafront mesh 'parts/*.stl' -o 'meshes/{name}.vtu' --jobs 4 --report all.json
  cat part.stl | tetrafront mesh - --format stl -o part.vtu
  tetrafront mesh part.stl -o - --format vtu > part.vtu
`;

export const remeshHelp = () => `
Input
${formatLines("readable", "surface")}
  -                     standard input; set its format with --format

Output
${formatLines("writable", "surface")}
  -                     standard output; set its format with --format

Result
  A closed surface without self-intersections, as the given one must be, within --tolerance of it in both
  directions. Edges sharper than --feature-angle, corners and the lines between patches stay; patches keep
  their names. The program prints the sizes that it chose, the smallest angle, and an upper bound of the
  distance between the surfaces.

Sizes
  Without --size and --background, the sizes follow from the shape, between --min-size and --max-size: an edge
  spans at most --angle-per-edge where the surface is curved, thin walls have --layers elements across, and
  sizes are small near short lines and in narrow gaps. They grow by --growth per unit of distance. --source
  limits the sizes around a position.

Small details
  Strips and steps that are much narrower than the sizes leave triangles with small angles. --drop-details merges
  sharp edges that are nearer to each other than a length, and --json lists every merge. Without this option, details
  below a fifth of the tolerance are merged, unless --background or --source is given or --min-size is less than six
  times as large; and if an angle is below 10 degrees all the same, more details across which triangles are poor, provided that the triangles get better. The surface stays
  within the tolerance. --drop-details 0 keeps all details.

Rounding
  STL files have single precision. The program reads the written surface again. If the rounding made it invalid,
  it prints an error and exits with 1; the file is written nevertheless.
${EXIT_CODES_HELP}

Examples
  tetrafront remesh part.stl -o remeshed.ply
  tetrafront remesh part.stl -o remeshed.ply --size 0.5 --tolerance 0.01
  tetrafront remesh part.stl -o remeshed.ply --layers 2 --angle-per-edge 10
  tetrafront remesh scan.stl -o remeshed.ply --weld 1e-6 --json
  tetrafront remesh 'parts/*.stl' -o 'remeshed/{name}.ply' --jobs 4
`;

export const adaptHelp = () => `
Input
  A volume mesh, or what \`tetrafront mesh\` reads: a CAD file, a surface or a project, which is meshed first. New
  nodes of the boundary are on the faces and edges of a CAD file, and otherwise on the
  triangles of this mesh.

Background
  A volume mesh with the metric at its nodes: "metric" with xx, xy, xz, yy, yz and zz, or "size" and optionally
  "stretching" and "direction" (also second ones). An edge e has the target length if e M e = 1. The file must cover the model.

Layers
  --layers PATCH:FIRST:GROWTH:COUNT makes thin elements along a patch: COUNT layers, the first one FIRST high, each GROWTH
  times as high as the one below. Along the patch, sizes are those of --background or of the mesh itself, at most
  --max-aspect (default ${LAYER_DEFAULTS.maxAspect}) times those across it, and smaller where the patch is curved. The layers follow the
  faces of a CAD file; triangles of other curved patches must be nearer to them than the first height. Beyond the layers,
  sizes grow by --gradation. In corners and gaps where several layers meet, elements are small in the directions of all.
  With --solver, every mesh gets the layers, and sizes beyond them follow from the solution.

Solver
  --solver runs cycles: the solver computes fields on a mesh, the sizes follow from them as in \`tetrafront sizes\`, the
  mesh is adapted, and the fields are transferred to the next mesh, as start values. In the command, {mesh} is the file
  that the solver reads, {solution} the one that it writes, and {cycle} the number of the cycle; without {mesh} and
  {solution}, both names follow the command. A shell runs it in the current folder.

  The solution is a volume mesh with values at its nodes, or, with --solution-format sol or solb, values alone in the order of
  the nodes. --mesh-format is that of both by default: vtu; with mesh or meshb, the values are in a .sol or .solb
  file beside. The last mesh is the output, with the last fields at its nodes.

  The folder, by default OUTPUT-cycles, has the files of every cycle, the solver's output in solver-N.log, and
  cycles.json with the table that is printed: elements and estimated error of the solved mesh, elements, unit
  edges and least quality of the next one. Each cycle is a checkpoint: --resume continues after the last one, after an
  interrupt or a failure too, and adds cycles if --cycles is larger.

Output
${formatLines("writable", "volume")}

Result
  Nearly all edges have a length from 0.71 to 1.41 in the metric. Patches, regions, sharp edges and corners stay;
  interfaces between regions stay triangle for triangle. With --background or --layers, Ctrl-C ends the work early; the mesh made so
  far is valid and is written. With --solver, it ends the solver too, and the cycles that are done are kept.
${EXIT_CODES_HELP}

Examples
  tetrafront adapt mesh.vtu --background metric.vtu -o adapted.vtu
  tetrafront adapt part.step --background metric.vtu -o adapted.vtu --quality 0.4
  tetrafront adapt channel.json --layers floor:0.001:1.2:10 --layers roof:0.002:1.3:6 -o layered.vtu
  tetrafront adapt part.step --solver 'python solve.py {mesh} {solution}' --cycles 5 --elements 20000 -o adapted.vtu
  tetrafront adapt part.step --solver ./solve --mesh-format mesh --field p --error 0.01 -o adapted.vtu --resume
  tetrafront adapt part.step --solver ./solve --indicator residual --elements 20000 -o adapted.vtu
`;

export const improveHelp = () => `
Input
${formatLines("readable", "volume")}
  -                     standard input; set its format with --format

Output
${formatLines("writable", "volume")}
  -                     standard output; set its format with --format

Result
  Elements are improved by swapping edges, moving nodes, and splitting and collapsing edges. The boundary, the
  interfaces between regions, and the triangles of the file stay as they are; patches and regions keep their
  names. The sizes stay those of the mesh. The smallest and the largest dihedral angle, the least and the mean
  radius ratio and the share of elements outside 30 to 135 degrees become better or stay as they are. The number
  of elements grows by at most 5 %, and only where that makes an element outside 30 to 135 degrees better.
  --max-growth sets another limit: 0 for no growth, 2 for up to three times as many; above 0.05, edges that are
  long for their surroundings are split too. All of these measures are printed as they were before and are
  after. If nothing better is found, the program says so and writes the given mesh. Values at the nodes are not kept if nodes move.

Meshes with problems
  Inverted elements are oriented, with a note. Elements without volume, elements that overlap, and faces of
  more than two elements are errors, which name the elements. \`tetrafront check\` lists more problems.
  Ctrl-C ends the work early; the mesh made so far is valid and is written.
${QUALITY_HELP}
${EXIT_CODES_HELP}

Examples
  tetrafront improve mesh.vtu -o better.vtu
  tetrafront improve mesh.msh -o better.msh --optimize thorough
  tetrafront improve mesh.msh -o better.msh --max-growth 0
  tetrafront improve mesh.vtk -o better.vtu --json
  tetrafront improve 'meshes/*.msh' -o 'better/{name}.vtu' --jobs 4
`;

export const checkHelp = () => `
For a surface, prints whether it is closed, manifold and without self-intersections; its regions and cavities,
area, volume, edges and worst triangles. For a project, lists what prevents meshing. For a mesh, checks whether
its elements fit together. Each problem states its indices, counted from 0, and its position. The list goes to
standard output.
${READING_HELP}

Exit code
  0  can be meshed or used    1  out of memory, not written    2  has errors, or cannot be read
  With several inputs, the highest of their codes.

Examples
  tetrafront check part.stl
  tetrafront check part.stl --json | jq .inspection.openEdges
  tetrafront check scan.stl --max-diagnostics all --json  # every problem, not the first thousand of each kind
  tetrafront check part.stl --repair --fill-holes 10      # lists the repairs, and the problems that remain
  tetrafront check parts.stl --inner-shells regions       # shells inside regions bound regions too
  tetrafront check base.step post.step --join             # which solids share faces, overlap or almost touch
  tetrafront check duct.json --size 0.1
  tetrafront check 'parts/*.stl' --jobs 4
`;

export const convertHelp = () => `
Input
${formatLines("readable", "surface", "volume")}
  -                     standard input; set its format with --format

Output
${formatLines("writable", "surface", "volume")}
  -                     standard output; set its format with --format

  part.json             project with the surface as a body, or one body per solid

A surface format receives the boundary of a volume mesh. Corners at equal positions become one node.
${EXIT_CODES_HELP}

Examples
  tetrafront convert part.vtu -o part.msh
  tetrafront convert part.vtu -o boundary.stl
  tetrafront convert scan.obj -o scan.stl --repair
  tetrafront convert part.stl -o part.json --split-patches 30
  tetrafront convert 'meshes/*.vtu' -o 'meshes/{name}.su2'
  cat scan.obj | tetrafront convert - --from obj -o - --to stl > scan.stl
`;

export const INFO_HELP = `${READING_HELP}
${EXIT_CODES_HELP}

Examples
  tetrafront info part.msh
  tetrafront info 'parts/*.stl'
  tetrafront info part.msh --json | jq '.patches[].name'
`;

export const STATS_HELP = `${QUALITY_HELP}
  --json adds histograms of both and of the edge lengths, per region, and the worst elements.
${READING_HELP}
${EXIT_CODES_HELP}

Examples
  tetrafront stats part.vtu
  tetrafront stats part.vtu --json | jq .dihedral.min
`;

export const TRACE_HELP = `
A trace (.tft) holds every decision while lines are divided, patches triangulated and volumes filled: the base edge or
face, the ideal point, each candidate with the reason why it was refused, and what the step changed; docs/TRACE.md
describes the file. Its fingerprint is that of \`tetrafront mesh --optimize none\` with the same options. A step takes
about 50 bytes. With --optimize, it also holds what each sweep of the optimizer changed, in about 40 bytes per element.

With --order, --no-relaxation, --front-tolerance or --search, the front follows other rules, to see what each rule is good
for; the summaries of two traces show the difference.

Examples
  tetrafront trace cube.json -o cube.tft
  tetrafront trace cube.json -o random.tft --order random --no-relaxation --summary
  tetrafront trace cube.tft --summary
  tetrafront trace cube.json -o cube.tft --optimize default --summary | jq .optimization.sweeps
`;

export const sizesHelp = () => `
Input
  A volume mesh with the values of a solver at its nodes:
${formatLines("readable", "volume")}

Output
  The same mesh as a background grid, for \`tetrafront adapt\`, \`tetrafront mesh --background\` and others. Its values
  at the nodes are "metric" (xx, xy, xz, yy, yz, zz: an edge e with e M e = 1 has the target length), and the
  same as sizes of the front: "size", "stretching" with "direction", "secondStretching" with "secondDirection".
  They are 0.947 of those of the metric, with which the front makes as many elements as the metric asks for.

Sizes
  Elements are small where the fields bend, and thin across their layers. --elements sets their number, --error the
  interpolation error of each field, in the norm. --min-size, --max-size, --max-aspect and --gradation limit
  the sizes. If they exclude the number of elements, a warning states which number they permit.

Indicator
  --indicator names a field that is your own estimate of the error, for example a residual: one number of at least 0
  per node or element. The size of each element is multiplied by (target / indicator)^(1 / order), so that all
  elements get the same indicator: --error, or the one with which there are --elements. --indicator-order is the power
  of the size with which the indicator falls: 2 (the default) for the error of linear elements, 3.5 for its L2 norm
  over each element. Elements are as wide in all directions; with --field, they have the shape that the fields ask
  for.
${EXIT_CODES_HELP}

Examples
  tetrafront sizes solution.vtu --field temperature --elements 50000 -o background.vtu
  tetrafront sizes flow.vtu --field velocity --field pressure --error 0.01 --norm L4 -o background.vtu
  tetrafront sizes flow.vtu --indicator residual --field velocity --elements 50000 -o background.vtu
  tetrafront mesh body.json -o finer.vtu --background background.vtu
`;

export const transferHelp = () => `
Input
  The volume mesh with the fields, and the mesh that is to have them:
${formatLines("readable", "volume")}

Result
  The second mesh with the fields at its nodes. By default, they are interpolated; nodes outside the first mesh take
  the value of its nearest point. --conservative intersects the elements of both meshes, so that the integral of each
  field is kept where the meshes fill the same domain; beside jumps, values may leave their range.
${EXIT_CODES_HELP}

Examples
  tetrafront transfer solution.vtu finer.vtu -o start.vtu
  tetrafront transfer solution.vtu finer.vtu -o start.vtu --field density --conservative
`;

export const COVER_HELP = `
A background grid defines the element size at its nodes. Edit the sizes in the app or in the file, or let
\`tetrafront propose\` add sources.
${EXIT_CODES_HELP}

Examples
  tetrafront cover duct.json -o covered.json
  tetrafront cover duct.json -o covered.json --size 0.1
`;

export const PROPOSE_HELP = `
For a project, the output is a project that you can inspect, change and mesh; the input is not changed. For a
surface, the program prints the smallest and the largest size that \`tetrafront remesh\` would choose, the
tolerance, and about how many triangles and tetrahedra result. The options mean what they mean for remeshing, with its
defaults: --angle-per-edge is 36, and --layers 1.
${EXIT_CODES_HELP}

Examples
  tetrafront propose duct.json -o sized.json
  tetrafront propose part.stl
  tetrafront propose duct.json -o sized.json --angle-per-edge 30 --layers 2 --min-size 0.01
  tetrafront mesh sized.json -o duct.vtu
`;

export const PROGRAM_HELP = `
Start with
  tetrafront check part.stl              list the problems of a surface
  tetrafront mesh part.stl -o part.vtu   fill it with tetrahedra
  tetrafront stats part.vtu              print the quality of the mesh

Help on a command: tetrafront mesh --help`;
