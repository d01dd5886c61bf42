/**
 * The file formats, one row each: the only place where a format is registered. Command line, app and
 * documents take names and extensions from here; the code of a format is fetched when it is first needed.
 */
import { aString, checkArgument, oneOf } from "../base/argument-checks.js";
import type { Part } from "./bytes.js";
import type { Contents, FileFormat, FormatCode, MeshWriter, Note } from "./file-format.js";
import type { FileMesh } from "./file-mesh.js";
import { heldOf, type Held } from "./held.js";

/** Every format that can be read or written. */
export const FILE_FORMATS: readonly FileFormat[] = [
  {
    id: "stl",
    name: "STL",
    extensions: [".stl"],
    reads: ["surface"],
    writes: ["surface"],
    load: async () => ({
      read: (await import("./stl.js")).readStl,
      write: one((await import("./stl-writer.js")).writeStl),
    }),
  },
  {
    id: "off",
    name: "OFF",
    extensions: [".off"],
    reads: ["surface"],
    writes: ["surface"],
    load: async () => ({
      read: (await import("./off.js")).readOff,
      write: one((await import("./off-writer.js")).writeOff, { lowestTag: 0 }),
    }),
  },
  {
    id: "obj",
    name: "OBJ",
    extensions: [".obj"],
    reads: ["surface"],
    writes: ["surface"],
    load: async () => ({
      read: (await import("./obj.js")).readObj,
      write: one((await import("./obj-writer.js")).writeObj),
    }),
  },
  {
    id: "ply",
    name: "PLY",
    extensions: [".ply"],
    reads: ["surface"],
    writes: ["surface"],
    load: async () => ({
      read: (await import("./ply.js")).readPly,
      write: one((await import("./ply-writer.js")).writePly, { lowestTag: 0 }),
    }),
  },
  {
    id: "glb",
    name: "glTF binary",
    extensions: [".glb"],
    reads: [],
    writes: ["surface"],
    load: async () => ({ write: one((await import("./glb.js")).writeGlb) }),
  },
  {
    id: "vtu",
    name: "VTU",
    extensions: [".vtu"],
    reads: ["surface", "volume"],
    writes: ["volume"],
    load: async () => ({
      ...(await vtkXml()),
      write: one((await import("./vtu.js")).writeVtu, { lowestTag: 0, takesData: () => true }),
    }),
  },
  {
    id: "vtp",
    name: "VTP",
    extensions: [".vtp"],
    reads: ["surface"],
    writes: [],
    load: vtkXml,
  },
  {
    id: "gmsh",
    name: "Gmsh 4.1",
    extensions: [".msh"],
    reads: ["surface", "volume"],
    writes: ["volume"],
    load: async () => ({
      read: (await import("./msh-reader.js")).readMsh,
      write: one((await import("./msh.js")).writeMsh, { lowestTag: 1, takesData: isGmshData }),
      passes: 11,
    }),
  },
  {
    id: "gmsh2",
    name: "Gmsh 2.2",
    extensions: [".msh2"],
    reads: ["surface", "volume"],
    writes: ["volume"],
    load: async () => ({
      read: (await import("./msh-reader.js")).readMsh,
      write: one((await import("./msh2.js")).writeMsh2, { lowestTag: 1, takesData: isGmshData }),
    }),
  },
  {
    id: "vtk",
    name: "legacy VTK",
    extensions: [".vtk"],
    reads: ["surface", "volume"],
    writes: ["volume"],
    load: async () => ({
      read: (await import("./vtk-reader.js")).readVtk,
      write: one((await import("./vtk.js")).writeVtk, {
        lowestTag: 0,
        takesData: (components) => components <= 9,
      }),
    }),
  },
  {
    id: "medit",
    name: "Medit",
    extensions: [".mesh"],
    reads: ["surface", "volume"],
    writes: ["volume"],
    load: async () => ({
      read: (await import("./medit-reader.js")).readMedit,
      write: one((await import("./medit.js")).writeMedit, { lowestTag: 0 }),
      passes: 2,
    }),
  },
  {
    id: "su2",
    name: "SU2",
    extensions: [".su2"],
    reads: [],
    writes: ["volume"],
    load: async () => ({ write: one((await import("./su2.js")).writeSu2), passes: 12 }),
  },
  {
    id: "abaqus",
    name: "Abaqus",
    extensions: [".inp"],
    reads: [],
    writes: ["volume"],
    load: async () => ({ write: one((await import("./abaqus.js")).writeAbaqus), passes: 9 }),
  },
  {
    id: "nastran",
    name: "Nastran",
    extensions: [".bdf", ".nas"],
    reads: [],
    writes: ["volume"],
    load: async () => {
      const { NASTRAN_NUMBERS, writeNastran } = await import("./nastran.js");
      return { write: one(writeNastran, NASTRAN_NUMBERS) };
    },
  },
  {
    id: "ugrid",
    name: "UGRID",
    extensions: [".ugrid"],
    reads: [],
    writes: ["volume"],
    load: async () => ({ write: one((await import("./ugrid.js")).writeUgrid, { lowestTag: 1 }), passes: 12 }),
  },
  {
    id: "ugrid-binary",
    name: "UGRID binary",
    extensions: [".b8.ugrid"],
    reads: [],
    writes: ["volume"],
    load: async () => ({
      write: one((await import("./ugrid.js")).writeUgridBinary, { lowestTag: 1 }),
      passes: 14,
    }),
  },
  {
    id: "openfoam",
    name: "OpenFOAM",
    extensions: [".foam.zip"],
    reads: [],
    writes: ["volume"],
    load: async () => ({ write: one((await import("./openfoam.js")).writeOpenFoam), passes: 32 }),
  },
  {
    id: "tetgen",
    name: "TetGen",
    extensions: [".node", ".ele"],
    beside: [".node", ".ele", ".face"],
    reads: ["volume"],
    writes: ["volume"],
    load: async () => ({
      read: (await import("./tetgen-reader.js")).readTetgen,
      write: holding({ lowestTag: 0 }, (await import("./tetgen.js")).writeTetgen),
      passes: 2,
    }),
  },
  {
    id: "tetgen-zip",
    name: "TetGen zip",
    extensions: [".tetgen.zip"],
    reads: [],
    writes: ["volume"],
    load: async () => ({
      write: one((await import("./tetgen.js")).writeTetgenZip, { lowestTag: 0 }),
      passes: 6,
    }),
  },
  {
    id: "tetgen-surface",
    name: "TetGen surface",
    extensions: [".smesh", ".poly", ".face"],
    beside: [".node"],
    reads: ["surface"],
    writes: [],
    load: async () => ({ read: (await import("./tetgen-reader.js")).readTetgen }),
  },
];

/**
 * The format that the name of a file tells by its end; the longest that fits, in capitals or not. Throws a `MesherError`
 * where it is no name.
 */
export function formatOf(fileName: string): FileFormat | undefined {
  checkArgument("fileName", fileName, aString);
  const end = extensionOf(fileName);
  return FILE_FORMATS.find(({ extensions }) => extensions.includes(end));
}

/** The end of a file name that tells its format, else what follows its last dot, in lower case with its dot. */
export function extensionOf(fileName: string): string {
  const name = fileName.toLowerCase();
  const known = FILE_FORMATS.flatMap(({ extensions }) => extensions)
    .filter((extension) => name.endsWith(extension))
    .sort((a, b) => b.length - a.length);
  return known[0] ?? /\.[^./\\]+$/.exec(name)?.[0] ?? "";
}

/** The files of a mesh in the format of this name, which is the first: mostly it is the only one. */
export function filesOf(fileName: string): readonly string[] {
  const end = extensionOf(fileName);
  const stem = fileName.slice(0, fileName.length - end.length);
  const others = formatOf(fileName)?.beside?.filter((extension) => extension !== end) ?? [];
  return [fileName, ...others.map((extension) => stem + extension)];
}

/** Extensions of the formats from which such meshes can be read, or as which they can be written. */
export function extensionsThat(can: "reads" | "writes", contents: Contents): readonly string[] {
  checkArgument("can", can, oneOf(["reads", "writes"]));
  checkArgument("contents", contents, oneOf(["surface", "volume"]));
  return FILE_FORMATS.filter((format) => format[can].includes(contents)).flatMap(
    ({ extensions }) => extensions,
  );
}

async function vtkXml(): Promise<FormatCode> {
  const { ARRIVAL, readVtkXml } = await import("./vtk-xml-reader.js");
  return { read: readVtkXml, arrival: ARRIVAL };
}

/** Scalars, vectors and tensors. */
function isGmshData(components: number): boolean {
  return [1, 3, 9].includes(components);
}

/** For formats of one file. */
function one(
  write: (mesh: FileMesh, note: Note, fileName: string) => Iterable<Part>,
  held: Held = {},
): MeshWriter {
  return holding(held, (mesh, fileName, note) => [{ fileName, parts: write(mesh, note, fileName) }]);
}

function holding(held: Held, write: MeshWriter): MeshWriter {
  return (mesh, fileName, note) => write(heldOf(mesh, held, note), fileName, note);
}
