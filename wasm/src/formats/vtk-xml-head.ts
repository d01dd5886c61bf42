/**
 * Finds the tags of a VTU or VTP file in its bytes. It does not decode the text between them, which may exceed the
 * longest possible string.
 */
import { failureAt, truncatedAt } from "./read-result.js";
import { indexOf } from "./text-bytes.js";
import { type Attributes, attributesIn, LESS, lineAt, tagsIn } from "./xml-tags.js";

const REMEDY = "Save the mesh again as .vtu or .vtp with triangles or linear tetrahedra.";
/** Sections whose arrays are read. In polygon files, the sections of cells are named by kind. */
const SECTIONS = new Set([
  "FieldData",
  "Points",
  "Cells",
  "Verts",
  "Lines",
  "Strips",
  "Polys",
  "PointData",
  "CellData",
]);

/** Array whose numbers have not been read yet. */
export interface FoundArray {
  readonly section: string;
  readonly attributes: Attributes;
  /** Bytes between its tags, and their offset. */
  readonly content: Uint8Array;
  readonly at: number;
}

export interface Piece {
  /** Offset of its tag. */
  readonly at: number;
  readonly attributes: Attributes;
  readonly arrays: FoundArray[];
}

export interface Head {
  readonly file: Attributes;
  readonly pieces: readonly Piece[];
  /** Arrays of the whole file. */
  readonly fields: readonly FoundArray[];
  /** Offset after the underscore of the appended data, and their encoding. */
  readonly appended: { readonly begin: number; readonly isBase64: boolean } | undefined;
}

/** Throws a ReadFailure if the bytes are not a file of these formats. */
export function readHead(bytes: Uint8Array): Head {
  let file: Attributes | undefined;
  const pieces: Piece[] = [];
  const fields: FoundArray[] = [];
  let section = "";
  for (const { begin, end, isClosing, name, rest } of tagsIn(bytes)) {
    const attributes = attributesIn(rest);
    if (isClosing) {
      if (name === section) section = "";
    } else if (name === "VTKFile") file = attributes;
    else if (name === "Piece") pieces.push({ at: begin, attributes, arrays: [] });
    else if (SECTIONS.has(name)) section = rest.endsWith("/") ? section : name;
    else if (name === "DataArray" && section !== "") {
      const close = rest.endsWith("/") ? end : bytes.indexOf(LESS, end);
      const content = bytes.subarray(end, Math.max(end, close));
      const arrays = section === "FieldData" ? fields : pieces.at(-1)?.arrays;
      arrays?.push({ section, attributes, content, at: end });
    } else if (name === "AppendedData") {
      const start = bytes.indexOf(UNDERSCORE, end) + 1;
      const isBase64 = attributes.get("encoding") === "base64";
      const appended = { begin: start === 0 ? bytes.length : start, isBase64 };
      return checkedHead(bytes, file, { pieces, fields, appended });
    }
  }
  return checkedHead(bytes, file, { pieces, fields, appended: undefined });
}

const UNDERSCORE = 95;

function checkedHead(
  bytes: Uint8Array,
  file: Attributes | undefined,
  { pieces, fields, appended }: Omit<Head, "file">,
): Head {
  const type = file?.get("type");
  if (file === undefined || (type !== "UnstructuredGrid" && type !== "PolyData"))
    return failIn(bytes, "the file is neither VTU nor VTP: it has no unstructured grid and no polygons", 0);
  if (pieces.length === 0) return failIn(bytes, "the file has no pieces", bytes.length, appended?.begin);
  const compressor = file.get("compressor");
  if (compressor !== undefined && compressor !== "vtkZLibDataCompressor") {
    const message = `unknown compressor "${compressor}"; only vtkZLibDataCompressor is supported`;
    failIn(bytes, message, indexOf(bytes, encoded("<VTKFile"), 0));
  }
  return { file, pieces, fields, appended };
}

/** Number of bytes at the end among which the last tag is. */
const END_BYTES = 1000;
const LAST_TAG = "</VTKFile>";

/**
 * Fails at byte `at`. The message states its line, or its offset if it is in the binary data. A file without its last tag is
 * truncated, which explains any other failure.
 */
export function failIn(bytes: Uint8Array, message: string, at: number, dataBegin = Infinity): never {
  const isOfVtk = indexOf(bytes, encoded("<VTKFile"), 0) >= 0;
  if (isOfVtk && indexOf(bytes, encoded(LAST_TAG), Math.max(0, bytes.length - END_BYTES)) < 0) {
    const end = bytes.length < dataBegin ? { line: lineAt(bytes, bytes.length) } : { offset: bytes.length };
    throw truncatedAt(end, `without ${LAST_TAG}`);
  }
  throw failureAt(at < dataBegin ? { line: lineAt(bytes, at) } : { offset: at }, message, REMEDY);
}

function encoded(text: string): Uint8Array {
  return new TextEncoder().encode(text);
}
