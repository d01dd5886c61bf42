/**
 * Reads the tetrahedra of Gmsh's MSH files, versions 4.1 and 2.2, binary and text: those this package
 * writes, Gmsh's own and meshio's. Points, lines and triangles are passed over, as are all sections
 * but nodes, elements and the numbers at nodes.
 */
import { ReadFailure, readSafely, type ReadResult } from "../read-result.js";
import { ByteCursor } from "./byte-cursor.js";
import type { NodeData } from "./file-mesh.js";
import { volumeFile, type VolumeFile } from "./volume-file.js";

const REMEDY = "Save the mesh again as MSH 4.1 or 2.2, or as .vtu.";
const TETRAHEDRON = 4;
/** Nodes per element of Gmsh's types without volume: points, lines, triangles, quadrilaterals. */
const FLAT_TYPES: ReadonlyMap<number, number> = new Map([
  [1, 2],
  [2, 3],
  [3, 4],
  [8, 3],
  [9, 6],
  [10, 9],
  [15, 1],
  [16, 8],
]);
/** No node has more numbers: a tensor has nine. */
const MAX_COMPONENTS = 9;

/** What a file is written in: one function per kind of number. */
interface Numbers {
  readonly int: () => number;
  readonly size: () => number;
  readonly double: () => number;
}

interface Parts {
  /** Position of each node by its tag. */
  readonly nodes: Map<number, number>;
  readonly points: number[];
  readonly corners: number[];
  readonly data: Map<string, NodeData>;
}

export function readMsh(bytes: Uint8Array): ReadResult<VolumeFile> {
  return readSafely(() => {
    const reader = new MshReader(bytes);
    const { points, corners, data } = reader.read();
    return volumeFile(Float64Array.from(points), corners, data, REMEDY);
  });
}

class MshReader {
  readonly #cursor: ByteCursor;
  readonly #parts: Parts = { nodes: new Map(), points: [], corners: [], data: new Map() };
  #isBinary = false;
  #hasBlocks = true;
  #numbers: Numbers;

  constructor(bytes: Uint8Array) {
    this.#cursor = new ByteCursor(bytes, REMEDY);
    const number = () => this.#cursor.number();
    this.#numbers = { int: number, size: number, double: number };
  }

  read(): Parts {
    this.#readFormat();
    while (this.#cursor.left > 0) {
      const section = this.#cursor.word();
      if (section === "") break;
      this.#readSection(section);
    }
    return this.#parts;
  }

  #readFormat(): void {
    const cursor = this.#cursor;
    if (cursor.line().trim() !== "$MeshFormat") {
      throw new ReadFailure({ message: 'the file does not begin with "$MeshFormat"', remedy: REMEDY });
    }
    const [version, kind, size] = cursor.line().trim().split(/\s+/);
    if ((version !== "4.1" && version !== "2.2") || size !== "8") {
      cursor.fail(`the format is "${version} ${kind} ${size}", versions 4.1 and 2.2 of size 8 can be read`);
    }
    this.#hasBlocks = version === "4.1";
    this.#isBinary = kind === "1";
    if (this.#isBinary) {
      // The number 1, in the byte order of all that follow.
      cursor.isLittleEndian = cursor.int32() === 1;
      const int = () => cursor.int32();
      this.#numbers = {
        int,
        size: this.#hasBlocks ? () => cursor.uint64() : int,
        double: () => cursor.float64(),
      };
    }
    this.#endSection("$MeshFormat");
  }

  #endSection(section: string): void {
    // One byte back, so that the end may follow binary numbers or a line's end.
    this.#cursor.position--;
    this.#cursor.skipPast(`$End${section.slice(1)}`);
  }

  #readSection(section: string): void {
    switch (section) {
      case "$Nodes":
        this.#cursor.line();
        if (this.#hasBlocks) this.#readNodeBlocks();
        else this.#readNodeList();
        break;
      case "$Elements":
        this.#cursor.line();
        if (this.#hasBlocks) this.#readElementBlocks();
        else if (this.#isBinary) this.#readElementRuns();
        else this.#readElementList();
        break;
      case "$NodeData":
        this.#readNodeData();
        break;
      default:
        if (!section.startsWith("$")) this.#cursor.fail(`"${section.slice(0, 24)}" is not a section`);
    }
    this.#endSection(section);
  }

  #addNode(tag: number): void {
    this.#parts.nodes.set(tag, this.#parts.points.length / 3);
    for (let axis = 0; axis < 3; axis++) {
      const value = this.#numbers.double();
      this.#parts.points.push(
        Number.isFinite(value) ? value : this.#cursor.fail(`node ${tag} has no finite place`),
      );
    }
  }

  #readNodeBlocks(): void {
    const { int, size, double } = this.#numbers;
    const blocks = this.#cursor.count(size(), 4, "blocks of nodes");
    for (let i = 0; i < 3; i++) size();
    for (let b = 0; b < blocks; b++) {
      const dimension = int();
      int();
      const extra = int() === 0 ? 0 : dimension;
      const count = this.#cursor.count(size(), 4, "nodes");
      const tags = Array.from({ length: count }, () => size());
      for (const tag of tags) {
        this.#addNode(tag);
        for (let i = 0; i < extra; i++) double();
      }
    }
  }

  #readNodeList(): void {
    const count = this.#cursor.count(Number(this.#cursor.line()), 4, "nodes");
    for (let i = 0; i < count; i++) this.#addNode(this.#numbers.int());
  }

  /** The next `count` numbers are tags of the nodes of an element. */
  #readCorners(type: number, read: () => number): void {
    if (type === TETRAHEDRON) {
      for (let i = 0; i < 4; i++) this.#parts.corners.push(this.#parts.nodes.get(read()) ?? -1);
      return;
    }
    const width = this.#flatWidth(type);
    for (let i = 0; i < width; i++) read();
  }

  #flatWidth(type: number): number {
    return (
      FLAT_TYPES.get(type) ??
      this.#cursor.fail(`elements of type ${type} cannot be read, only tetrahedra of four nodes`)
    );
  }

  #readElementBlocks(): void {
    const { int, size } = this.#numbers;
    const blocks = this.#cursor.count(size(), 4, "blocks of elements");
    for (let i = 0; i < 3; i++) size();
    for (let b = 0; b < blocks; b++) {
      int();
      int();
      const type = int();
      const count = this.#cursor.count(size(), 4, "elements");
      for (let e = 0; e < count; e++) {
        size();
        this.#readCorners(type, size);
      }
    }
  }

  /** Version 2.2, binary: runs of elements of one type. */
  #readElementRuns(): void {
    const { int } = this.#numbers;
    const total = this.#cursor.count(Number(this.#cursor.line()), 4, "elements");
    for (let read = 0; read < total;) {
      const type = int();
      const count = this.#cursor.count(int(), 4, "elements");
      const tags = this.#cursor.count(int(), 4, "tags");
      for (let e = 0; e < count; e++) {
        for (let i = 0; i <= tags; i++) int();
        this.#readCorners(type, int);
      }
      read += Math.max(count, 1);
    }
  }

  #readElementList(): void {
    const total = this.#cursor.count(Number(this.#cursor.line()), 4, "elements");
    for (let e = 0; e < total; e++) {
      const [, type = NaN, tags = NaN, ...rest] = this.#cursor.line().trim().split(/\s+/).map(Number);
      const corners = rest.slice(tags).values();
      this.#readCorners(type, () => corners.next().value ?? -1);
    }
  }

  #readNodeData(): void {
    const cursor = this.#cursor;
    cursor.line();
    const strings = Array.from({ length: cursor.count(Number(cursor.line()), 1, "names") }, () =>
      cursor.line(),
    );
    const reals = cursor.count(Number(cursor.line()), 1, "times");
    for (let i = 0; i < reals; i++) cursor.line();
    const integers = Array.from({ length: cursor.count(Number(cursor.line()), 1, "numbers") }, () =>
      Number(cursor.line()),
    );
    const [, components = NaN, rows = NaN] = integers;
    if (!(Number.isInteger(components) && components > 0 && components <= MAX_COMPONENTS)) {
      cursor.fail(`${components} numbers per node cannot be read`);
    }
    const values = new Float64Array((components * this.#parts.points.length) / 3).fill(NaN);
    const { int, double } = this.#numbers;
    const count = cursor.count(rows, 4, "values");
    for (let r = 0; r < count; r++) {
      const node = this.#parts.nodes.get(int()) ?? cursor.fail("a value belongs to no node");
      for (let i = 0; i < components; i++) values[components * node + i] = double();
    }
    this.#parts.data.set((strings[0] ?? "").trim().replace(/^"|"$/g, ""), { components, values });
  }
}
