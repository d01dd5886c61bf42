/**
 * Reads legacy VTK files, binary and ASCII, versions 1 to 5.1: polygons and unstructured grids, as written by this
 * package, meshio, VTK and ParaView. The cell arrays `patch` and `region` define the groups.
 */
import { plural } from "../base/plural.js";
import { type Steps, stepwise } from "../base/steps.js";
import { inSteps } from "../calls/yielder.js";
import type { Mesh, NodeData } from "../mesh/mesh.js";
import { ByteReader, FIRST_LINE } from "./byte-reader.js";
import type { ByteSource } from "./byte-source.js";
import { Column } from "./column.js";
import type { ReadContext } from "./file-format.js";
import { MeshBuilder } from "./mesh-builder.js";
import { NAME_BREAK, NameLines } from "./name-lines.js";
import type { FileLocation } from "./read-result.js";
import { textOf } from "./text-bytes.js";
import { addCell, type Cells, cellsOf, cellwise, rowsOfTetrahedra } from "./vtk-cells.js";

const REMEDY = "Save the mesh again as legacy .vtk with triangles or linear tetrahedra, or as .vtu.";
const VTK_VERTEX = 1;
const VTK_STRIP = 6;
const VTK_POLYGON = 7;
/** In the order in which VTK numbers the cells, regardless of the order of the sections. */
const POLYGON_SECTIONS: ReadonlyMap<string, number> = new Map([
  ["VERTICES", VTK_VERTEX],
  ["LINES", VTK_VERTEX],
  ["POLYGONS", VTK_POLYGON],
  ["TRIANGLE_STRIPS", VTK_STRIP],
]);

/** Binary numbers have the high byte first; kind "b" packs eight into a byte. */
const TYPES: Readonly<
  Record<string, { readonly bytes: 1 | 2 | 4 | 8; readonly kind: "i" | "u" | "f" | "b" }>
> = {
  bit: { bytes: 1, kind: "b" },
  unsigned_char: { bytes: 1, kind: "u" },
  char: { bytes: 1, kind: "i" },
  unsigned_short: { bytes: 2, kind: "u" },
  short: { bytes: 2, kind: "i" },
  unsigned_int: { bytes: 4, kind: "u" },
  int: { bytes: 4, kind: "i" },
  unsigned_long: { bytes: 8, kind: "u" },
  long: { bytes: 8, kind: "i" },
  vtktypeint64: { bytes: 8, kind: "i" },
  vtktypeint32: { bytes: 4, kind: "i" },
  vtktypeuint64: { bytes: 8, kind: "u" },
  vtkidtype: { bytes: 4, kind: "i" },
  float: { bytes: 4, kind: "f" },
  double: { bytes: 8, kind: "f" },
};
/** Largest number of values per cell or point. */
const MAX_COMPONENTS = 9;

/** Nodes of cell c: nodes[offsets[c]..offsets[c + 1]]. */
interface CellList {
  /** Beginning of the list. */
  readonly location: FileLocation;
  readonly offsets: Float64Array;
  readonly nodes: Float64Array;
}

export function readVtk(source: ByteSource, { signal }: ReadContext): Promise<Mesh> {
  return ByteReader.over(source, { remedy: REMEDY }, (reader) => new VtkReader(reader, signal).read());
}

class VtkReader {
  readonly #reader: ByteReader;
  readonly #builder = new MeshBuilder();
  readonly #names = new NameLines();
  readonly #cellData = new Map<string, NodeData>();
  readonly #lists: {
    readonly list: CellList;
    readonly section: string;
    readonly type: number | undefined;
  }[] = [];
  #types: Float64Array = new Float64Array();
  #isBinary = false;
  /** Whether cells have separate offsets and connectivity, as from version 5 on. */
  #hasOffsets = false;
  /** Number of rows of the following attributes, and the items they belong to. */
  #rows = 0;
  #attributesOf: "dataset" | "cells" | "points" = "dataset";

  readonly #signal: AbortSignal | undefined;

  constructor(reader: ByteReader, signal: AbortSignal | undefined) {
    this.#reader = reader;
    this.#signal = signal;
  }

  async read(): Promise<Mesh> {
    this.#readHead();
    for (;;) {
      await this.#reader.fill();
      const word = this.#reader.word().toUpperCase();
      if (word === "") break;
      await this.#readSection(word);
    }
    await inSteps(this.#addCells(), this.#signal);
    return this.#names.applyTo(this.#builder.mesh());
  }

  #readHead(): void {
    const reader = this.#reader;
    const version = /^# vtk datafile version (\d+)/i.exec(reader.line());
    if (version === null) return reader.fail('the file does not begin with "# vtk DataFile"', FIRST_LINE);
    this.#hasOffsets = Number(version[1]) >= 5;
    for (const line of reader.line().split(NAME_BREAK)) this.#names.readComment(line);
    const coding = reader.line().toUpperCase();
    if (coding !== "ASCII" && coding !== "BINARY")
      reader.fail(`expected "ASCII" or "BINARY", found "${coding.slice(0, 24)}"`);
    this.#isBinary = coding === "BINARY";
    reader.isLittleEndian = false;
    reader.expect("dataset");
    const kind = reader.word().toUpperCase();
    if (kind !== "UNSTRUCTURED_GRID" && kind !== "POLYDATA") {
      reader.fail(`expected the dataset "UNSTRUCTURED_GRID" or "POLYDATA", found "${kind.slice(0, 24)}"`);
    }
  }

  async #readSection(section: string): Promise<void> {
    const reader = this.#reader;
    const type = POLYGON_SECTIONS.get(section);
    if (type !== undefined || section === "CELLS") {
      this.#lists.push({ list: await this.#readList(), section, type });
      return;
    }
    switch (section) {
      case "POINTS":
        return this.#readPoints();
      case "CELL_TYPES":
        this.#types = await this.#numbers("int", this.#size());
        return;
      case "CELL_DATA":
      case "POINT_DATA":
        return this.#beginAttributes(section);
      case "SCALARS":
        return this.#readScalars();
      case "VECTORS":
      case "NORMALS":
        return this.#readAttribute(3);
      case "TENSORS":
        return this.#readAttribute(9);
      case "TENSORS6":
        return this.#readAttribute(6);
      case "GLOBAL_IDS":
      case "PEDIGREE_IDS":
      case "EDGE_FLAGS":
        return this.#readAttribute(1);
      case "TEXTURE_COORDINATES": {
        const name = reader.word();
        return this.#readAttribute(this.#componentCount(), name);
      }
      case "COLOR_SCALARS":
        reader.word();
        return this.#skipColors(this.#componentCount() * this.#rows);
      case "LOOKUP_TABLE":
        reader.word();
        return this.#skipColors(4 * this.#size());
      case "FIELD":
        return this.#readField();
      case "METADATA":
        return this.#skipMetadata();
      default:
        return reader.failUnknown("section", section);
    }
  }

  #beginAttributes(section: "CELL_DATA" | "POINT_DATA"): void {
    this.#attributesOf = section === "CELL_DATA" ? "cells" : "points";
    this.#rows = this.#size();
    const { pointCount } = this.#builder;
    if (section === "POINT_DATA" && this.#rows !== pointCount) {
      this.#reader.fail(`the file has ${plural(pointCount, "point")}, but data for ${this.#rows}`);
    }
  }

  #size(): number {
    return this.#reader.count(this.#reader.number("a number of items"), "items");
  }

  async #numbers(type: string, count: number): Promise<Float64Array> {
    const column = new Column(Float64Array);
    await this.#eachNumber(type, count, (value) => column.push(value));
    return column.taken();
  }

  /** Ends the current line and reads `count` numbers. */
  async #eachNumber(type: string, count: number, use: (value: number) => void): Promise<void> {
    const reader = this.#reader;
    const { bytes, kind } = TYPES[type.toLowerCase()] ?? reader.failUnknown("number type", type);
    const mayBeNone = this.#attributesOf === "points";
    if (this.#isBinary) reader.endLine();
    let bits = 0;
    for (let i = 0; i < count; i++) {
      if (reader.isLow) await reader.fill();
      if (kind === "b" && this.#isBinary) {
        bits = i % 8 === 0 ? reader.integer(1, false) : bits << 1;
        use((bits >> 7) & 1);
      } else if (!this.#isBinary) use(reader.number("a value", mayBeNone));
      else if (kind === "f") use(reader.float(bytes === 4 ? 4 : 8));
      else use(reader.integer(bytes, kind === "i"));
    }
  }

  /** Colours are bytes in binary files, and numbers from 0 to 1 in text. */
  #skipColors(count: number): Promise<void> {
    return this.#eachNumber("unsigned_char", count, () => undefined);
  }

  /**
   * Skips strings: one per line in text; otherwise each after its length, whose first two bits state the size of
   * the length.
   */
  async #skipStrings(count: number): Promise<void> {
    const reader = this.#reader;
    if (this.#isBinary) reader.endLine();
    else reader.line();
    for (let i = 0; i < count; i++) {
      await reader.fill();
      if (reader.isAtEnd) reader.failAtEnd("text");
      if (!this.#isBinary) {
        reader.line();
        continue;
      }
      const sizes = [8, 4, 2, 1] as const;
      const size = sizes[(reader.peek(1)[0] ?? 0) >> 6] ?? 1;
      await reader.bytes(reader.integer(size, false) % 2 ** (8 * size - 2));
    }
  }

  async #readPoints(): Promise<void> {
    const count = this.#size();
    const position: number[] = [];
    await this.#eachNumber(this.#reader.word(), 3 * count, (value) => {
      if (!Number.isFinite(value)) {
        this.#reader.fail(
          `point ${this.#builder.pointCount} (counted from 0) has a coordinate that is not finite`,
        );
      }
      if (position.push(value) < 3) return;
      const [x = 0, y = 0, z = 0] = position;
      this.#builder.addPoint(x, y, z);
      position.length = 0;
    });
  }

  async #readList(): Promise<CellList> {
    const { location } = this.#reader;
    const count = this.#size();
    const total = this.#size();
    if (!this.#hasOffsets) {
      const split = this.#splitList(location, count, await this.#numbers("int", total));
      return inSteps(split, this.#signal);
    }
    if (count === 0) return { location, offsets: new Float64Array(), nodes: new Float64Array() };
    this.#reader.expect("offsets");
    const offsets = await this.#numbers(this.#reader.word(), count);
    this.#reader.expect("connectivity");
    return { location, offsets, nodes: await this.#numbers(this.#reader.word(), total) };
  }

  /** Splits a list in which each cell is preceded by its number of nodes. */
  *#splitList(location: FileLocation, count: number, values: Float64Array): Steps<CellList> {
    const offsets: number[] = [0];
    const nodes = new Float64Array(Math.max(0, values.length - count));
    let at = 0;
    yield* stepwise(count, (cell) => {
      const size = values[at] ?? NaN;
      const isListed = Number.isInteger(size) && size >= 0 && at - cell + size <= nodes.length;
      if (!isListed || at + 1 + size > values.length) {
        this.#reader.fail(`cell ${cell} (counted from 0) has an invalid list of corners`, location);
      }
      nodes.set(values.subarray(at + 1, at + 1 + size), at - cell);
      at += 1 + size;
      offsets.push(at - cell - 1);
    });
    return { location, offsets: Float64Array.from(offsets), nodes };
  }

  /** Stores an array under its name, in which blanks and similar characters are encoded like %20. */
  #keep(name: string, components: number, values: Float64Array): void {
    const plain = name.replace(/(?:%[0-9a-f]{2})+/gi, (codes) =>
      textOf(Uint8Array.from(codes.slice(1).split("%"), (code) => parseInt(code, 16))),
    );
    if (this.#attributesOf === "points") this.#builder.nodeData.set(plain, { components, values });
    else if (this.#attributesOf === "cells") this.#cellData.set(plain, { components, values });
  }

  async #readScalars(): Promise<void> {
    const reader = this.#reader;
    const name = reader.word();
    const type = reader.word();
    const components = reader.hasWordInLine() ? this.#componentCount() : 1;
    reader.expect("lookup_table");
    reader.word();
    this.#keep(name, components, await this.#numbers(type, components * this.#rows));
  }

  #componentCount(): number {
    const count = this.#size();
    return count <= MAX_COMPONENTS
      ? count
      : this.#reader.fail(`the file has ${count} values per row; the limit is ${MAX_COMPONENTS}`);
  }

  async #readAttribute(components: number, name = this.#reader.word()): Promise<void> {
    this.#keep(name, components, await this.#numbers(this.#reader.word(), components * this.#rows));
  }

  async #readField(): Promise<void> {
    const reader = this.#reader;
    reader.word();
    const arrays = this.#size();
    for (let i = 0; i < arrays; i++) {
      await reader.fill();
      if (reader.accepts("metadata")) this.#skipMetadata();
      const name = reader.word();
      const components = this.#size();
      const rows = this.#size();
      const type = reader.word();
      const isOfMesh = this.#attributesOf !== "dataset";
      if (isOfMesh && rows !== this.#rows) {
        reader.fail(
          `"${name.slice(0, 24)}" has ${plural(rows, "row")}, but the number of ${this.#attributesOf} is ${this.#rows}`,
        );
      }
      if (/string$/i.test(type)) await this.#skipStrings(components * rows);
      else if (isOfMesh && components <= MAX_COMPONENTS) {
        this.#keep(name, components, await this.#numbers(type, components * rows));
      } else await this.#eachNumber(type, components * rows, () => undefined);
    }
  }

  /** Skips lines up to an empty one. */
  #skipMetadata(): void {
    this.#reader.line();
    while (!this.#reader.isAtEnd && this.#reader.line() !== "");
  }

  #tagsNamed(name: string): Float64Array | undefined {
    const data = this.#cellData.get(name);
    return data?.components === 1 ? data.values : undefined;
  }

  /** Keeps the values of the cells that are tetrahedra; only one list of cells has any. */
  *#addElementData({ tetrahedra: column, groupArrays }: Cells): Steps<void> {
    const tetrahedra = column.taken();
    if (tetrahedra.length === 0) return;
    for (const [name, { components, values }] of this.#cellData) {
      if (components === 1 && groupArrays.has(name)) continue;
      const rows = yield* rowsOfTetrahedra(values, components, tetrahedra);
      this.#builder.elementData.set(name, { components, values: rows });
    }
  }

  *#addCells(): Steps<void> {
    let first = 0;
    const order = [...POLYGON_SECTIONS.keys()];
    this.#lists.sort((a, b) => order.indexOf(a.section) - order.indexOf(b.section));
    for (const { list, type } of this.#lists) {
      const { location, offsets, nodes } = list;
      const fail = (message: string): never => this.#reader.fail(message, location);
      const cells = cellsOf(this.#builder, (name) => this.#tagsNamed(name), fail);
      const count = Math.max(0, offsets.length - 1);
      if (type === undefined && this.#types.length !== count) {
        fail(`the file has ${plural(count, "cell")}, but ${plural(this.#types.length, "cell type")}`);
      }
      yield* cellwise(this.#builder, count, (cell) => {
        const [begin = 0, end = 0] = offsets.subarray(cell, cell + 2);
        if (!(begin >= 0 && begin <= end && end <= nodes.length))
          fail(`cell ${cell} (counted from 0) has an invalid list of corners`);
        addCell(cells, type ?? this.#types[cell] ?? 0, [...nodes.subarray(begin, end)], first + cell);
      });
      yield* this.#addElementData(cells);
      first += count;
    }
  }
}
