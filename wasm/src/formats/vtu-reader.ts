/**
 * Reads the tetrahedra of VTU files (VTK XML unstructured grids) as this package, meshio and ParaView
 * write them: one piece; arrays as text, in base64 or appended; compressed with zlib or not. Points,
 * lines and faces are passed over.
 */
import { ReadFailure, readSafely, type ReadResult } from "../read-result.js";
import { decodeArray, type ArrayCoding } from "./vtk-arrays.js";
import type { NodeData } from "./file-mesh.js";
import { volumeFile, type VolumeFile } from "./volume-file.js";

const REMEDY = "Save the mesh again as .vtu with one piece of linear tetrahedra, or as .msh.";
const VTK_TETRA = 10;
/** VTK's cells without volume: vertices, lines, triangles, polygons and their quadratic kin. */
const FLAT_CELLS = new Set([1, 2, 3, 4, 5, 6, 7, 8, 9, 21, 22, 23, 28, 30, 34]);
/** Sections in which arrays are looked for. */
const SECTIONS = new Set(["Points", "Cells", "PointData"]);

type Attributes = ReadonlyMap<string, string>;

/** An array before its numbers are read. */
interface FoundArray {
  readonly section: string;
  readonly attributes: Attributes;
  /** What stands between its tags. */
  readonly content: string;
}

interface Head {
  readonly file: Attributes;
  readonly piece: Attributes;
  readonly arrays: readonly FoundArray[];
  /** What follows the underscore of the appended data, and whether it is base64. */
  readonly appended: { readonly begin: number; readonly isBase64: boolean } | undefined;
}

export async function readVtu(bytes: Uint8Array): Promise<ReadResult<VolumeFile>> {
  try {
    const volume = await read(bytes);
    return { success: true, value: volume };
  } catch (failure) {
    return readSafely(() => {
      throw failure;
    });
  }
}

async function read(bytes: Uint8Array): Promise<VolumeFile> {
  const text = new TextDecoder("latin1").decode(bytes);
  const head = readHead(text);
  const coding = codingOf(head, bytes, text);
  const numbers = async (found: FoundArray): Promise<Float64Array> => {
    const { attributes, content } = found;
    return decodeArray(coding, {
      type: attributes.get("type") ?? "",
      format: attributes.get("format") ?? "ascii",
      offset: Number(attributes.get("offset") ?? NaN),
      content,
    });
  };
  const named = (section: string, name: string) =>
    head.arrays.find(
      (array) => array.section === section && (name === "" || array.attributes.get("Name") === name),
    ) ?? fail(`the file has no array "${name === "" ? section : name}"`);
  const points = await numbers(named("Points", ""));
  const count = Number(head.piece.get("NumberOfPoints") ?? NaN);
  if (points.length !== 3 * count) fail(`there are ${points.length / 3} points, ${count} are announced`);
  if (!points.every(Number.isFinite)) fail("a point has a coordinate that is not finite");
  const corners = tetrahedraOf(
    await numbers(named("Cells", "connectivity")),
    await numbers(named("Cells", "offsets")),
    await numbers(named("Cells", "types")),
  );
  const nodeData = new Map<string, NodeData>();
  for (const found of head.arrays) {
    if (found.section !== "PointData") continue;
    const values = await numbers(found);
    const components = Number(found.attributes.get("NumberOfComponents") ?? 1);
    if (values.length === components * count) {
      nodeData.set(found.attributes.get("Name") ?? "", { components, values });
    }
  }
  return volumeFile(points, corners, nodeData, REMEDY);
}

function readHead(text: string): Head {
  let file: Attributes | undefined;
  const pieces: Attributes[] = [];
  const arrays: FoundArray[] = [];
  let section = "";
  for (const match of text.matchAll(/<(\/?)([A-Za-z]+)([^<>]*)>/g)) {
    const [tag, slash, name = "", rest = ""] = match;
    const end = match.index + tag.length;
    const attributes = attributesIn(rest);
    if (slash === "/") {
      if (name === section) section = "";
    } else if (name === "VTKFile") file = attributes;
    else if (name === "Piece") pieces.push(attributes);
    else if (SECTIONS.has(name)) section = name;
    else if (name === "DataArray" && section !== "") {
      const close = rest.endsWith("/") ? end : text.indexOf("<", end);
      arrays.push({ section, attributes, content: text.slice(end, close < 0 ? end : close) });
    } else if (name === "AppendedData") {
      const begin = text.indexOf("_", end) + 1;
      const isBase64 = attributes.get("encoding") === "base64";
      return checkedHead(file, pieces, arrays, { begin: begin === 0 ? text.length : begin, isBase64 });
    }
  }
  return checkedHead(file, pieces, arrays, undefined);
}

function checkedHead(
  file: Attributes | undefined,
  pieces: readonly Attributes[],
  arrays: readonly FoundArray[],
  appended: Head["appended"],
): Head {
  if (file?.get("type") !== "UnstructuredGrid")
    return fail("this is not a VTU file: it has no unstructured grid");
  const [piece] = pieces;
  if (piece === undefined || pieces.length > 1)
    return fail(`the file has ${pieces.length} pieces instead of one`);
  return { file, piece, arrays, appended };
}

function attributesIn(text: string): Attributes {
  return new Map(
    [...text.matchAll(/([\w:]+)\s*=\s*"([^"]*)"/g)].map(([, name = "", value = ""]) => [name, value]),
  );
}

function codingOf({ file, appended }: Head, bytes: Uint8Array, text: string): ArrayCoding {
  const compressor = file.get("compressor");
  if (compressor !== undefined && compressor !== "vtkZLibDataCompressor") {
    fail(`the compressor ${compressor} is not known, only vtkZLibDataCompressor`);
  }
  return {
    isLittleEndian: file.get("byte_order") !== "BigEndian",
    headerBytes: file.get("header_type") === "UInt64" ? 8 : 4,
    isCompressed: compressor !== undefined,
    appended:
      appended === undefined
        ? undefined
        : appended.isBase64
          ? text.slice(appended.begin)
          : bytes.subarray(appended.begin),
    fail,
  };
}

/** Four corners per tetrahedron. */
function tetrahedraOf(connectivity: Float64Array, offsets: Float64Array, types: Float64Array): number[] {
  if (offsets.length !== types.length) fail("the cells have more or fewer types than offsets");
  const corners: number[] = [];
  types.forEach((type, cell) => {
    if (FLAT_CELLS.has(type)) return;
    if (type !== VTK_TETRA) fail(`cells of type ${type} cannot be read, only linear tetrahedra`);
    const end = offsets[cell] ?? NaN;
    if (!(end >= 4 && end <= connectivity.length)) fail(`cell ${cell} (counted from 0) has no corners`);
    corners.push(...connectivity.subarray(end - 4, end));
  });
  return corners;
}

function fail(message: string): never {
  throw new ReadFailure({ message, remedy: REMEDY });
}
