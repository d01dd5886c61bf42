/**
 * Reads legacy VTK files, binary and ASCII, versions 1 to 5.1: polygons and unstructured grids, as this
 * package, meshio, VTK and ParaView write them. The numbers `patch` and `region` of cells tell their groups.
 */
import type { FilePlace } from "../read-result.js";
import { ByteReader, FIRST_LINE } from "./byte-reader.js";
import type { ByteSource } from "./byte-source.js";
import { Column } from "./column.js";
import type { FileMesh } from "./file-mesh.js";
import { MeshBuilder } from "./mesh-builder.js";
import { NAME_BREAK, NameLines } from "./name-lines.js";
import { addCell, cellsOf } from "./vtk-cells.js";

const REMEDY = "Save the mesh again as legacy .vtk with triangles or linear tetrahedra, or as .vtu.";
const VTK_VERTEX = 1;
const VTK_STRIP = 6;
const VTK_POLYGON = 7;
const POLYGON_SECTIONS: ReadonlyMap<string, number> = new Map([
  ["VERTICES", VTK_VERTEX],
  ["LINES", VTK_VERTEX],
  ["POLYGONS", VTK_POLYGON],
  ["TRIANGLE_STRIPS", VTK_STRIP],
]);

/** Binary numbers are high byte first. Bits come packed and only ever as attributes, which are passed over. */
const TYPES: Readonly<Record<string, { readonly bytes: 1 | 2 | 4 | 8; readonly kind: "i" | "u" | "f" }>> = {
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
/** No attribute has more numbers per cell or point. */
const MAX_COMPONENTS = 9;

/** Nodes of cell c: nodes[offsets[c]..offsets[c + 1]]. */
interface CellList {
  /** Of its begin. */
  readonly place: FilePlace;
  readonly offsets: Float64Array;
  readonly nodes: Float64Array;
}

export function readVtk(source: ByteSource): Promise<FileMesh> {
  return ByteReader.over(source, { remedy: REMEDY }, (reader) => new VtkReader(reader).read());
}

class VtkReader {
  readonly #reader: ByteReader;
  readonly #builder = new MeshBuilder();
  readonly #names = new NameLines();
  readonly #cellData = new Map<string, Float64Array>();
  /** In the order of the file, which is that of the cell data. */
  readonly #lists: { readonly list: CellList; readonly type: number | undefined }[] = [];
  #types: Float64Array = new Float64Array();
  #isBinary = false;
  /** Since version 5 cells have offsets and connectivity of their own. */
  #hasOffsets = false;
  /** Rows of the attributes that follow. */
  #rows = 0;
  #isPointData = false;

  constructor(reader: ByteReader) {
    this.#reader = reader;
  }

  async read(): Promise<FileMesh> {
    this.#readHead();
    for (;;) {
      await this.#reader.fill();
      const word = this.#reader.word().toUpperCase();
      if (word === "") break;
      if (!(await this.#readSection(word))) break;
    }
    this.#addCells();
    return this.#names.given(this.#builder.mesh());
  }

  #readHead(): void {
    const reader = this.#reader;
    const version = /^# vtk datafile version (\d+)/i.exec(reader.line());
    if (version === null) return reader.fail('the file does not begin with "# vtk DataFile"', FIRST_LINE);
    this.#hasOffsets = Number(version[1]) >= 5;
    for (const line of reader.line().split(NAME_BREAK)) this.#names.hear(line);
    const coding = reader.line().toUpperCase();
    if (coding !== "ASCII" && coding !== "BINARY") reader.fail(`"${coding.slice(0, 24)}" is no coding`);
    this.#isBinary = coding === "BINARY";
    reader.isLittleEndian = false;
    reader.expect("dataset");
    const kind = reader.word().toUpperCase();
    if (kind !== "UNSTRUCTURED_GRID" && kind !== "POLYDATA") {
      reader.fail(`a dataset "${kind.slice(0, 24)}" has no triangles and tetrahedra`);
    }
  }

  /** False where the rest of the file cannot matter. */
  async #readSection(word: string): Promise<boolean> {
    const reader = this.#reader;
    const kind = POLYGON_SECTIONS.get(word);
    if (kind !== undefined) {
      this.#lists.push({ list: await this.#readList(), type: kind });
      return true;
    }
    switch (word) {
      case "POINTS":
        await this.#readPoints();
        return true;
      case "CELLS":
        this.#lists.push({ list: await this.#readList(), type: undefined });
        return true;
      case "CELL_TYPES":
        this.#types = await this.#numbers("int", this.#size());
        return true;
      case "CELL_DATA":
      case "POINT_DATA":
        this.#isPointData = word === "POINT_DATA";
        this.#rows = this.#size();
        return true;
      case "SCALARS":
        return this.#readScalars();
      case "VECTORS":
      case "NORMALS":
        return this.#readAttribute(3);
      case "TENSORS":
        return this.#readAttribute(9);
      case "FIELD":
        return this.#readField();
      case "METADATA":
        return this.#skipMetadata();
      case "LOOKUP_TABLE":
      case "COLOR_SCALARS":
      case "TEXTURE_COORDINATES":
        return false;
      default:
        return reader.fail(`"${word.slice(0, 24)}" is not a section`);
    }
  }

  #size(): number {
    return this.#reader.count(this.#reader.number("a number of items"), "items");
  }

  /** The words of this line are over; `count` numbers follow. */
  async #numbers(type: string, count: number): Promise<Float64Array> {
    const reader = this.#reader;
    const { bytes, kind } =
      TYPES[type.toLowerCase()] ?? reader.fail(`numbers of type "${type}" cannot be read`);
    if (this.#isBinary) reader.endLine();
    const column = new Column(Float64Array);
    for (let i = 0; i < count; i++) {
      if (reader.isLow) await reader.fill();
      if (!this.#isBinary) column.push(reader.number("a value"));
      else if (kind === "f") column.push(reader.float(bytes === 4 ? 4 : 8));
      else column.push(reader.integer(bytes, kind === "i"));
    }
    return column.taken();
  }

  async #readPoints(): Promise<void> {
    const count = this.#size();
    const { place } = this.#reader;
    const values = await this.#numbers(this.#reader.word(), 3 * count);
    const wild = values.findIndex((value) => !Number.isFinite(value));
    if (wild >= 0)
      this.#reader.fail(`point ${Math.floor(wild / 3)} (counted from 0) has no finite place`, place);
    for (let i = 0; i < values.length; i += 3) {
      this.#builder.addPoint(values[i] ?? 0, values[i + 1] ?? 0, values[i + 2] ?? 0);
    }
  }

  async #readList(): Promise<CellList> {
    const { place } = this.#reader;
    const count = this.#size();
    const total = this.#size();
    if (!this.#hasOffsets) return this.#splitList(place, count, await this.#numbers("int", total));
    if (count === 0) return { place, offsets: new Float64Array(), nodes: new Float64Array() };
    this.#reader.expect("offsets");
    const offsets = await this.#numbers(this.#reader.word(), count);
    this.#reader.expect("connectivity");
    return { place, offsets, nodes: await this.#numbers(this.#reader.word(), total) };
  }

  /** Cells with their number of nodes before each. */
  #splitList(place: FilePlace, count: number, values: Float64Array): CellList {
    const offsets: number[] = [0];
    const nodes = new Float64Array(Math.max(0, values.length - count));
    let at = 0;
    for (let cell = 0; cell < count; cell++) {
      const size = values[at] ?? NaN;
      const isListed = Number.isInteger(size) && size >= 0 && at - cell + size <= nodes.length;
      if (!isListed || at + 1 + size > values.length) {
        this.#reader.fail(`cell ${cell} (counted from 0) has no corners`, place);
      }
      nodes.set(values.subarray(at + 1, at + 1 + size), at - cell);
      at += 1 + size;
      offsets.push(at - cell - 1);
    }
    return { place, offsets: Float64Array.from(offsets), nodes };
  }

  #keep(name: string, components: number, values: Float64Array): void {
    if (this.#isPointData) this.#builder.nodeData.set(name, { components, values });
    else if (components === 1) this.#cellData.set(name, values);
  }

  async #readScalars(): Promise<boolean> {
    const reader = this.#reader;
    const name = reader.word();
    const type = reader.word();
    const components = reader.hasWordInLine() ? this.#componentCount() : 1;
    reader.expect("lookup_table");
    reader.word();
    this.#keep(name, components, await this.#numbers(type, components * this.#rows));
    return true;
  }

  #componentCount(): number {
    const count = this.#size();
    return count <= MAX_COMPONENTS ? count : this.#reader.fail(`${count} numbers per row cannot be read`);
  }

  async #readAttribute(components: number): Promise<boolean> {
    const name = this.#reader.word();
    this.#keep(name, components, await this.#numbers(this.#reader.word(), components * this.#rows));
    return true;
  }

  async #readField(): Promise<boolean> {
    this.#reader.word();
    const arrays = this.#size();
    for (let i = 0; i < arrays; i++) {
      await this.#reader.fill();
      if (this.#reader.accepts("metadata")) this.#skipMetadata();
      const name = this.#reader.word();
      const components = this.#size();
      const rows = this.#size();
      const values = await this.#numbers(this.#reader.word(), components * rows);
      if (rows === this.#rows && components <= MAX_COMPONENTS) this.#keep(name, components, values);
    }
    return true;
  }

  /** Lines up to an empty one. */
  #skipMetadata(): boolean {
    this.#reader.line();
    while (!this.#reader.isAtEnd && this.#reader.line() !== "");
    return true;
  }

  #addCells(): void {
    let first = 0;
    for (const { list, type } of this.#lists) {
      const { place, offsets, nodes } = list;
      const fail = (message: string): never => this.#reader.fail(message, place);
      const cells = cellsOf(this.#builder, this.#cellData, fail);
      const count = Math.max(0, offsets.length - 1);
      if (type === undefined && this.#types.length !== count) {
        fail(`there are ${count} cells and ${this.#types.length} types of cells`);
      }
      for (let cell = 0; cell < count; cell++) {
        const [begin = 0, end = 0] = offsets.subarray(cell, cell + 2);
        if (!(begin >= 0 && begin <= end && end <= nodes.length))
          fail(`cell ${cell} (counted from 0) has no corners`);
        addCell(cells, type ?? this.#types[cell] ?? 0, [...nodes.subarray(begin, end)], first + cell);
      }
      first += count;
    }
  }
}
