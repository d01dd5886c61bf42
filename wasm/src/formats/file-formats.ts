/**
 * The list of file formats: the only place where a format is registered. The command line, the app and the
 * documents take names and extensions from here. The code of a format is loaded on first use.
 */
import * as v from "valibot";
import { checkArgument } from "../calls/argument-checks.js";
import type { Part } from "./bytes.js";
import type {
  BlockWriter,
  Contents,
  FileFormat,
  FormatCode,
  MeshReader,
  MeshWriter,
  Note,
} from "./file-format.js";
import type { Mesh } from "../mesh/mesh.js";
import { fitBlocksToFormat } from "./blocks.js";
import { fitToFormat, type FormatLimits } from "./format-limits.js";
import type { WrittenMesh } from "./second-order.js";

/** Every format that can be read or written. */
export const FILE_FORMATS: readonly FileFormat[] = [
  {
    id: "stl",
    name: "STL",
    extensions: [".stl"],
    readable: ["surface"],
    writable: ["surface"],
    load: async () => ({
      read: (await import("./stl.js")).readStl,
      write: singleFile((await import("./stl-writer.js")).writeStl),
    }),
  },
  {
    id: "off",
    name: "OFF",
    extensions: [".off"],
    readable: ["surface"],
    writable: ["surface"],
    load: async () => ({
      read: (await import("./off.js")).readOff,
      write: singleFile((await import("./off-writer.js")).writeOff, { minTag: 0 }),
    }),
  },
  {
    id: "obj",
    name: "OBJ",
    extensions: [".obj"],
    readable: ["surface"],
    writable: ["surface"],
    load: async () => ({
      read: (await import("./obj.js")).readObj,
      write: singleFile((await import("./obj-writer.js")).writeObj),
    }),
  },
  {
    id: "ply",
    name: "PLY",
    extensions: [".ply"],
    readable: ["surface"],
    writable: ["surface"],
    load: async () => ({
      read: (await import("./ply.js")).readPly,
      write: singleFile((await import("./ply-writer.js")).writePly, { minTag: 0 }),
    }),
  },
  {
    id: "3mf",
    name: "3MF",
    extensions: [".3mf"],
    readable: ["surface"],
    writable: [],
    load: async () => ({ read: (await import("./threemf.js")).readThreeMf, arrival: THREE_MF_ARRIVAL }),
  },
  cadFormat("step", "STEP", [".step", ".stp"], async () => (await import("./cad.js")).readStep),
  cadFormat("iges", "IGES", [".iges", ".igs"], async () => (await import("./cad.js")).readIges),
  cadFormat("brep", "BREP", [".brep"], async () => (await import("./cad.js")).readBrep),
  {
    id: "glb",
    name: "glTF binary",
    extensions: [".glb"],
    readable: [],
    writable: ["surface"],
    load: async () => ({ write: singleFile((await import("./glb.js")).writeGlb) }),
  },
  {
    id: "vtu",
    name: "VTU",
    extensions: [".vtu"],
    readable: ["surface", "volume"],
    writable: ["volume"],
    hasSecondOrder: true,
    load: async () => ({
      ...(await vtkXml()),
      write: await vtuWriter(),
      writeBlocks: blockWriter((await import("./vtu-blocks.js")).writeVtuBlocks, VTU_LIMITS),
    }),
  },
  {
    id: "vtp",
    name: "VTP",
    extensions: [".vtp"],
    readable: ["surface"],
    writable: [],
    load: vtkXml,
  },
  {
    id: "gmsh",
    name: "Gmsh 4.1",
    extensions: [".msh"],
    readable: ["surface", "volume"],
    writable: ["volume"],
    hasSecondOrder: true,
    load: async () => ({
      read: (await import("./msh-reader.js")).readMsh,
      write: singleFile((await import("./msh.js")).writeMsh, GMSH_LIMITS),
      writeBlocks: blockWriter((await import("./msh-blocks.js")).writeMshBlocks, GMSH_LIMITS),
      passes: 11,
    }),
  },
  {
    id: "gmsh2",
    name: "Gmsh 2.2",
    extensions: [".msh2"],
    readable: ["surface", "volume"],
    writable: ["volume"],
    hasSecondOrder: true,
    load: async () => ({
      read: (await import("./msh-reader.js")).readMsh,
      write: singleFile((await import("./msh2.js")).writeMsh2, GMSH_LIMITS),
    }),
  },
  {
    id: "vtk",
    name: "legacy VTK",
    extensions: [".vtk"],
    readable: ["surface", "volume"],
    writable: ["volume"],
    hasSecondOrder: true,
    load: async () => ({
      read: (await import("./vtk-reader.js")).readVtk,
      write: singleFile((await import("./vtk.js")).writeVtk, {
        minTag: 0,
        canHoldData: (components) => components <= 9,
        hasElementData: true,
      }),
    }),
  },
  {
    id: "medit",
    name: "Medit",
    extensions: [".mesh"],
    valuesExtension: ".sol",
    readable: ["surface", "volume"],
    writable: ["volume"],
    load: async () => {
      const { isSolField, writeSol } = await import("./medit-sol.js");
      const { writeMedit } = await import("./medit.js");
      const limits = { minTag: 0, canHoldData: isSolField } as const;
      return {
        read: (await import("./medit-reader.js")).readMedit,
        write: withValues(singleFile(writeMedit, limits), isSolField, writeSol),
        passes: 2,
      };
    },
  },
  {
    id: "medit-binary",
    name: "Medit binary",
    extensions: [".meshb"],
    valuesExtension: ".solb",
    readable: ["surface", "volume"],
    writable: ["volume"],
    load: async () => {
      const { isSolField, writeSolBinary } = await import("./medit-sol.js");
      const { readMeditBinary, writeMeditBinary } = await import("./medit-binary.js");
      const limits = { minTag: 0, canHoldData: isSolField } as const;
      return {
        read: readMeditBinary,
        write: withValues(singleFile(writeMeditBinary, limits), isSolField, writeSolBinary),
        passes: 2,
      };
    },
  },
  {
    id: "su2",
    name: "SU2",
    extensions: [".su2"],
    readable: [],
    writable: ["volume"],
    load: async () => ({ write: singleFile((await import("./su2.js")).writeSu2), passes: 12 }),
  },
  {
    id: "abaqus",
    name: "Abaqus",
    extensions: [".inp"],
    readable: [],
    writable: ["volume"],
    hasSecondOrder: true,
    load: async () => ({ write: singleFile((await import("./abaqus.js")).writeAbaqus), passes: 9 }),
  },
  {
    id: "nastran",
    name: "Nastran",
    extensions: [".bdf", ".nas"],
    readable: [],
    writable: ["volume"],
    hasSecondOrder: true,
    load: async () => {
      const { NASTRAN_NUMBERS, writeNastran } = await import("./nastran.js");
      return { write: singleFile(writeNastran, NASTRAN_NUMBERS) };
    },
  },
  {
    id: "ugrid",
    name: "UGRID",
    extensions: [".ugrid"],
    readable: [],
    writable: ["volume"],
    load: async () => ({
      write: singleFile((await import("./ugrid.js")).writeUgrid, { minTag: 1 }),
      passes: 12,
    }),
  },
  {
    id: "ugrid-binary",
    name: "UGRID binary",
    extensions: [".b8.ugrid"],
    readable: [],
    writable: ["volume"],
    load: async () => ({
      write: singleFile((await import("./ugrid.js")).writeUgridBinary, { minTag: 1 }),
      passes: 14,
    }),
  },
  {
    id: "openfoam",
    name: "OpenFOAM",
    extensions: [".foam.zip"],
    readable: [],
    writable: ["volume"],
    load: async () => ({ write: singleFile((await import("./openfoam.js")).writeOpenFoam), passes: 32 }),
  },
  {
    id: "tetgen",
    name: "TetGen",
    extensions: [".node", ".ele"],
    companions: [".node", ".ele", ".face"],
    readable: ["volume"],
    writable: ["volume"],
    load: async () => ({
      read: (await import("./tetgen-reader.js")).readTetgen,
      write: withLimits({ minTag: 0 }, (await import("./tetgen.js")).writeTetgen),
      passes: 2,
    }),
  },
  {
    id: "tetgen-zip",
    name: "TetGen zip",
    extensions: [".tetgen.zip"],
    readable: [],
    writable: ["volume"],
    load: async () => ({
      write: singleFile((await import("./tetgen.js")).writeTetgenZip, { minTag: 0 }),
      passes: 6,
    }),
  },
  {
    id: "tetgen-surface",
    name: "TetGen surface",
    extensions: [".smesh", ".poly", ".face"],
    companions: [".node"],
    readable: ["surface"],
    writable: [],
    load: async () => ({ read: (await import("./tetgen-reader.js")).readTetgen }),
  },
];

/** Whether a file of this name describes shapes, which are triangulated when they are read. */
export function isCadFile(fileName: string): boolean {
  return formatOf(fileName)?.isCad === true;
}

/**
 * Returns the format of a file by its extension, ignoring case; the longest matching extension decides. Throws a
 * `MesherError` if `fileName` is not a string.
 */
export function formatOf(fileName: string): FileFormat | undefined {
  checkArgument("fileName", fileName, v.string());
  const end = extensionOf(fileName);
  return FILE_FORMATS.find(({ extensions }) => extensions.includes(end));
}

/** Returns the extension that decides the format, else the text from the last dot on; in lower case, with its dot. */
export function extensionOf(fileName: string): string {
  const name = fileName.toLowerCase();
  const known = FILE_FORMATS.flatMap(({ extensions }) => extensions)
    .filter((extension) => name.endsWith(extension))
    .sort((a, b) => b.length - a.length);
  return known[0] ?? /\.[^./\\]+$/.exec(name)?.[0] ?? "";
}

/** Returns the files of a mesh of this name: the given one first, then its companions in formats of several files. */
export function filesOf(fileName: string): readonly string[] {
  const end = extensionOf(fileName);
  const stem = fileName.slice(0, fileName.length - end.length);
  const others = formatOf(fileName)?.companions?.filter((extension) => extension !== end) ?? [];
  return [fileName, ...others.map((extension) => stem + extension)];
}

/**
 * Extensions of the formats that can read, or write, surfaces or volumes. Throws a `MesherError` for other
 * arguments.
 */
export function extensionsFor(action: "read" | "write", contents: Contents): readonly string[] {
  checkArgument("action", action, v.picklist(["read", "write"]));
  checkArgument("contents", contents, v.picklist(["surface", "volume"]));
  const formats = FILE_FORMATS.filter(({ readable, writable }) =>
    (action === "read" ? readable : writable).includes(contents),
  );
  return formats.flatMap(({ extensions }) => extensions);
}

function cadFormat(
  id: string,
  name: string,
  extensions: FileFormat["extensions"],
  loadReader: () => Promise<MeshReader>,
): FileFormat {
  return {
    id,
    name,
    extensions,
    isCad: true,
    readable: ["surface"],
    writable: [],
    load: async () => ({ read: await loadReader(), arrival: CAD_ARRIVAL }),
  };
}

/** Approximate fraction of the work of reading a 3MF file that is done when all bytes have arrived. */
const THREE_MF_ARRIVAL = 0.1;
/** Approximate fraction of the work of reading a CAD file that is done when all bytes have arrived. */
const CAD_ARRIVAL = 0.1;

async function vtkXml(): Promise<FormatCode> {
  const { ARRIVAL, readVtkXml } = await import("./vtk-xml-reader.js");
  return { read: readVtkXml, arrival: ARRIVAL };
}

/**
 * Gmsh permits a patch and a region with one tag, but programs that read its files look tags up without the dimension.
 * Values are scalars, vectors or tensors.
 */
const GMSH_LIMITS: FormatLimits = {
  minTag: 1,
  hasSharedTags: true,
  canHoldData: (components) => [1, 3, 9].includes(components),
  hasElementData: true,
};

async function vtuWriter(): Promise<MeshWriter> {
  const { writeVtu } = await import("./vtu.js");
  return withLimits(VTU_LIMITS, (mesh, fileName, note, createSpool) => [
    { fileName, parts: writeVtu(mesh, note, createSpool) },
  ]);
}

const VTU_LIMITS: FormatLimits = { minTag: 0, canHoldData: () => true, hasElementData: true };

/** Makes a writer of elements in blocks, which gets groups as the format can store them. */
function blockWriter(write: BlockWriter, limits: FormatLimits): BlockWriter {
  return (mesh, note, createSpool) => write(fitBlocksToFormat(mesh, limits, note), note, createSpool);
}

/** Makes a writer of a single file. */
function singleFile(
  write: (mesh: WrittenMesh, note: Note, fileName: string) => Iterable<Part>,
  limits: FormatLimits = {},
): MeshWriter {
  return withLimits(limits, (mesh, fileName, note) => [{ fileName, parts: write(mesh, note, fileName) }]);
}

/** Makes a writer that writes the values at the nodes to a second file, if the format can hold any of them. */
function withValues(
  write: MeshWriter,
  canHold: (components: number) => boolean,
  writeValues: (nodeData: Mesh["nodeData"], nodes: number) => Iterable<Part>,
): MeshWriter {
  return (mesh, fileName, note, createSpool) => {
    const files = write(mesh, fileName, note, createSpool);
    const kept = new Map([...mesh.nodeData].filter(([, { components }]) => canHold(components)));
    const { valuesExtension = "" } = formatOf(fileName) ?? {};
    const stem = fileName.slice(0, fileName.length - extensionOf(fileName).length);
    if (kept.size === 0) return files;
    return [...files, { fileName: stem + valuesExtension, parts: writeValues(kept, mesh.points.length / 3) }];
  };
}

function withLimits(limits: FormatLimits, write: MeshWriter): MeshWriter {
  return (mesh, fileName, note, createSpool) =>
    write(fitToFormat(mesh, limits, note), fileName, note, createSpool);
}
