/** What `tetrafront COMMAND --help` teaches below the options. */
import type { Contents } from "../formats/file-format.js";
import { FILE_FORMATS } from "../formats/file-formats.js";

/** One line per format that can be read, or written, as any of such contents. */
function formatLines(can: "reads" | "writes", ...contents: readonly Contents[]): string {
  return FILE_FORMATS.filter((format) => contents.some((held) => format[can].includes(held)))
    .map(({ name, extensions }) => `  ${extensions.join(", ").padEnd(21)} ${name}`)
    .join("\n");
}

const EXIT_CODES_HELP = `
Exit code
  0  done    1  not completed: stalled, cancelled, out of memory, not written    2  bad input
  Of many inputs, the highest. Ctrl C cancels a mesh being made, with its report (1); it ends all else, and leaves no
  half-written file (130; 143 where the process is told to end).`;

const READING_HELP = `
Formats: those that \`tetrafront convert --help\` lists as input; - is standard input.`;

/** What the figures of a mesh say. */
const FIGURES_HELP = `
Figures
  Dihedral angles, between the faces of an element, are best near 70.5 degrees; from 30 to 135 is good.
  The radius ratio, three times the inscribed radius by the circumscribed one, is 1 for the regular
  tetrahedron and 0 for a flat one.`;

export const meshHelp = () => `
Input
  .json                 a Tetrafront project: points, lines, patches, background grid
${formatLines("reads", "surface")}
  -                     standard input, with --format to tell its format

Output
${formatLines("writes", "volume")}
  -                     standard output, with --format to tell its format

Sizes of elements
  Lengths are edges of elements, in the units of the file, which need no name.
  Of a project as it says; of a surface from its own edges, growing inwards by --grading up to --size.
  --background takes them from a mesh with sizes at its nodes (named "size"; "stretching" and
  "direction" too, else from its own edges) or from a project. --source makes them smaller around a place.

  A surface is kept triangle for triangle: beside triangles larger than wanted elements are as large, and
  sizes fall inwards by --grading (at most 0.5 per unit of distance), as they grow from triangles that are
  smaller than a background's sizes. You are told of triangles that are too large;
  --refine-surface divides them first, and leaves the shape as it is.

Shapes of elements
  --optimize none leaves the mesh as the front made it; fast, default and thorough work on it ever longer.
${FIGURES_HELP}

Surfaces that cannot be filled
  \`tetrafront check\` tells why. Nothing is repaired unless you ask: --repair joins nodes at the same
  place, removes triangles without area and duplicates, and turns triangles outward; --weld joins nodes
  within a distance, --fill-holes closes small holes. Every change is listed, and in the report.
${EXIT_CODES_HELP}

Examples
  tetrafront mesh part.stl -o part.vtu
  tetrafront mesh part.stl -o part.msh --size 0.05 --report report.json
  tetrafront mesh part.stl -o part.vtu --source 0,0,1,0.01,0.2 --refine-surface
  tetrafront mesh scan.ply -o scan.vtu --weld 1e-6 --fill-holes 20
  tetrafront mesh duct.json -o finer.vtu --background sizes.vtu
  tetrafront mesh 'parts/*.stl' -o 'meshes/{name}.vtu' --jobs 4 --report all.json
  cat part.stl | tetrafront mesh - --format stl -o part.vtu
  tetrafront mesh part.stl -o - --format vtu > part.vtu
`;

export const checkHelp = () => `
Tells of a surface whether it is closed, manifold and free of crossings, its bodies and cavities, area,
volume, edges and worst triangles; of a project what would keep it from being meshed; of a mesh whether
its elements fit together. Each problem has its ids, counted from 0, and its place.
${READING_HELP}

Exit code
  0  nothing keeps it from being meshed or used    1  out of memory    2  something does, or it cannot be read
  Of many inputs, the highest.

Examples
  tetrafront check part.stl
  tetrafront check part.stl --json | jq .inspection.openEdges
  tetrafront check scan.stl --findings all --json        # every one, not the first thousand of each kind
  tetrafront check part.stl --repair --fill-holes 10     # what would be changed, and what then remains
  tetrafront check parts.stl --enclosed regions          # bodies within others are bodies too
  tetrafront check duct.json --size 0.1
  tetrafront check 'parts/*.stl' --jobs 4
`;

export const convertHelp = () => `
Input
${formatLines("reads", "surface", "volume")}

Output
${formatLines("writes", "surface", "volume")}

A volume mesh in a format of surfaces is its boundary. Triangles are joined at the same places.
${EXIT_CODES_HELP}

Examples
  tetrafront convert part.vtu -o part.msh
  tetrafront convert part.vtu -o boundary.stl
  tetrafront convert scan.obj -o scan.stl --repair
  tetrafront convert 'meshes/*.vtu' -o 'meshes/{name}.su2'
`;

export const INFO_HELP = `${READING_HELP}
${EXIT_CODES_HELP}

Examples
  tetrafront info part.msh
  tetrafront info 'parts/*.stl'
  tetrafront info part.msh --json | jq '.patches[].name'
`;

export const STATS_HELP = `${FIGURES_HELP}
  In --json there are histograms of both and of the lengths of edges, per region, and the worst elements.
${READING_HELP}
${EXIT_CODES_HELP}

Examples
  tetrafront stats part.vtu
  tetrafront stats part.vtu --json | jq .dihedral.min
`;

export const COVER_HELP = `
A background grid tells at its nodes how large elements are to be; without one a project has no sizes.
Edit the sizes in the application or the file, or let \`tetrafront propose\` add sources to it.
${EXIT_CODES_HELP}

Examples
  tetrafront cover duct.json -o covered.json
  tetrafront cover duct.json -o covered.json --size 0.1
`;

export const PROPOSE_HELP = `
The output is a project to be looked at, changed and meshed; the input stays as it is.
${EXIT_CODES_HELP}

Examples
  tetrafront propose duct.json -o sized.json
  tetrafront propose duct.json -o sized.json --per-circle 12 --per-gap 2 --smallest 0.01
  tetrafront mesh sized.json -o duct.vtu
`;

export const PROGRAM_HELP = `
Begin with
  tetrafront check part.stl              what is there, and what is wrong
  tetrafront mesh part.stl -o part.vtu   tetrahedra in it
  tetrafront stats part.vtu              how good they are

Each command explains itself: tetrafront mesh --help`;
