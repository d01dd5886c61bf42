/** What a format keeps of the names of patches or regions: names and numbers, numbers only, or nothing. */
export type Kept = "names" | "numbers" | "nothing";

export type Encoding = "text" | "binary";

/** A file format in which a mesh can be saved. docs/FORMAT.md describes their content. */
export interface ExportFormat {
  readonly id: string;
  /** Extensions without the first dot, by encoding. A format has one or both. */
  readonly extensions: Readonly<Partial<Record<Encoding, string>>>;
  /** Whether the file has the tetrahedra, or only the boundary. */
  readonly content: "volume" | "boundary";
  /** Whether the file may have elements of the second order. */
  readonly hasSecondOrder: boolean;
  readonly patches: Kept;
  readonly regions: Kept;
  /** Digits of the coordinates: all of them, or fewer. */
  readonly coordinates: "exact" | "single" | "short";
}

const volume = { content: "volume", hasSecondOrder: false, coordinates: "exact" } as const;
const boundary = {
  content: "boundary",
  hasSecondOrder: false,
  coordinates: "exact",
  regions: "nothing",
} as const;
const allNames = { patches: "names", regions: "names" } as const;

export const exportFormats: readonly ExportFormat[] = [
  { id: "vtu", extensions: { binary: "vtu" }, ...volume, ...allNames, hasSecondOrder: true },
  { id: "msh", extensions: { binary: "msh" }, ...volume, ...allNames, hasSecondOrder: true },
  { id: "msh2", extensions: { binary: "msh2" }, ...volume, ...allNames, hasSecondOrder: true },
  { id: "foam", extensions: { text: "foam.zip" }, ...volume, ...allNames },
  { id: "su2", extensions: { text: "su2" }, ...volume, patches: "names", regions: "nothing" },
  { id: "inp", extensions: { text: "inp" }, ...volume, ...allNames, hasSecondOrder: true },
  {
    id: "bdf",
    extensions: { text: "bdf" },
    ...volume,
    ...allNames,
    hasSecondOrder: true,
    coordinates: "short",
  },
  {
    id: "ugrid",
    extensions: { binary: "b8.ugrid", text: "ugrid" },
    ...volume,
    patches: "numbers",
    regions: "nothing",
  },
  { id: "mesh", extensions: { text: "mesh" }, ...volume, ...allNames },
  { id: "meshb", extensions: { binary: "meshb" }, ...volume, patches: "numbers", regions: "numbers" },
  {
    id: "vtk",
    extensions: { text: "vtk" },
    ...volume,
    patches: "numbers",
    regions: "numbers",
    hasSecondOrder: true,
  },
  { id: "tetgen", extensions: { text: "tetgen.zip" }, ...volume, ...allNames },
  { id: "stl", extensions: { binary: "stl" }, ...boundary, patches: "numbers", coordinates: "single" },
  { id: "obj", extensions: { text: "obj" }, ...boundary, patches: "names" },
  { id: "ply", extensions: { text: "ply" }, ...boundary, patches: "names" },
  { id: "off", extensions: { text: "off" }, ...boundary, patches: "names" },
  { id: "glb", extensions: { binary: "glb" }, ...boundary, patches: "names", coordinates: "single" },
];

/** Returns the encodings of a format, its own first. */
export const encodingsOf = ({ extensions }: ExportFormat): readonly Encoding[] =>
  Object.keys(extensions) as Encoding[];

/** Returns the extension of a format in an encoding, or in the only one that it has. */
export const extensionIn = (format: ExportFormat, encoding: Encoding): string =>
  format.extensions[encoding] ?? Object.values(format.extensions)[0] ?? "";
