/** Names of the entities of a project and of their types. */

export const entityWords = {
  point: { one: "Point", many: "Points" },
  line: { one: "Line", many: "Lines" },
  patch: { one: "Patch", many: "Patches" },
  body: { one: "Body", many: "Bodies" },
  "body-patch": { one: "Patch", many: "Patches of bodies" },
  "background-node": { one: "Node", many: "Background grid" },
  source: { one: "Source", many: "Sources" },
} as const;

/** Returns what an entity without a name is called. Patches are called as in files of the mesh. */
export function defaultName(kind: keyof typeof entityWords, id: number): string {
  const isBoundary = kind === "patch" || kind === "body-patch";
  return `${isBoundary ? entityNouns[kind] : entityWords[kind].one} ${id}`;
}

/** Names of the kinds within a sentence. */
export const entityNouns = {
  point: "point",
  line: "line",
  patch: "patch",
  body: "body",
  "body-patch": "patch",
  "background-node": "background node",
  source: "source",
} as const;

/** Names of several entities of a kind within a sentence. */
export const pluralNouns = {
  point: "points",
  line: "lines",
  patch: "patches",
  body: "bodies",
  "body-patch": "patches",
  "background-node": "background nodes",
  source: "sources",
} as const;

export const lineTypeNames = {
  straight: "straight",
  parabolic: "parabola",
  spline: "cubic spline",
  arc: "arc",
  circle: "circle",
  hermite: "Hermite line",
} as const;

export const patchTypeNames = {
  planar: "planar",
  coons: "Coons",
  "isoparametric-triangle": "isoparametric triangle",
  serendipity: "serendipity",
  "barnhill-gregory-nielson": "Barnhill–Gregory–Nielson",
  tube: "tube",
  gregory: "smooth quadrilateral (Gregory)",
  nielson: "smooth triangle (Nielson)",
  loft: "loft",
} as const;

/** The lines that each type of patch needs. */
export const patchTypeHints = {
  planar: "Any lines that lie in one plane; holes allowed.",
  coons: "Four lines of any type; opposite lines are blended. Holes allowed.",
  "isoparametric-triangle": "Three parabolic lines: a curved triangle with six nodes. Holes allowed.",
  serendipity: "Four parabolic lines: a curved quadrilateral with eight nodes. Holes allowed.",
  "barnhill-gregory-nielson":
    "Three lines of any type; the second, F2, is weighted differently. Holes allowed.",
  gregory: "Four lines of any type; joins other smooth patches without an edge. Holes allowed.",
  nielson: "Three lines of any type; joins other smooth patches without an edge. Holes allowed.",
  loft: "Four lines of any type, and sections from the fourth to the second: a surface through all of them.",
  tube: "Two loops of any lines, joined by straight rulings: a cylinder between two circles.",
} as const;

/** What meshing does with the given triangles of a body. */
export const solidName = "solid";
export const treatmentNames = { remesh: "remesh", refine: "refine", keep: "keep" } as const;

export const sourceTypeNames = { point: "point", segment: "segment", triangle: "triangle" } as const;

export const layerNames = {
  points: "Points",
  lines: "Lines",
  patches: "Patches",
  bodies: "Bodies",
  background: "Background grid",
  sources: "Sources",
  mesh: "Mesh",
} as const;

/** Returns the name of a region; an empty text if it only repeats the number. */
export const ownRegionName = (region: number, name = ""): string => (name === `region ${region}` ? "" : name);
