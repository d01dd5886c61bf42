/**
 * Readers of VTU and MSH files that follow the specifications, not the code that writes them. Little-endian
 * only.
 */
import { inflateSync } from "node:zlib";

export interface Mesh {
  readonly points: Float64Array;
  /** Node indices of each tetrahedron, from 0. */
  readonly tetrahedra: number[][];
  readonly regions: number[];
  readonly triangles: number[][];
  readonly patches: number[];
}

/** Reads a VTU file with appended data compressed in blocks, as VTK's file format guide describes it. */
export function parseVtu(bytes: Uint8Array): Mesh {
  const text = new TextDecoder("latin1").decode(bytes);
  const begin = text.indexOf("_", text.indexOf("<AppendedData")) + 1;
  const view = new DataView(bytes.buffer, bytes.byteOffset);
  const bytesOf = (name: string): ArrayBuffer => {
    const tag = new RegExp(`<DataArray[^>]*Name="${name}"[^>]*>`).exec(text)?.[0] ?? "";
    const offset = begin + Number(/offset="(\d+)"/.exec(tag)?.[1]);
    const header = (index: number) => Number(view.getBigUint64(offset + 8 * index, true));
    const blocks: Buffer[] = [];
    let at = offset + 8 * (3 + header(0));
    for (let b = 0; b < header(0); b++) {
      blocks.push(inflateSync(bytes.subarray(at, at + header(3 + b))));
      at += header(3 + b);
    }
    return new Uint8Array(Buffer.concat(blocks)).buffer;
  };
  const connectivity = [...new Int32Array(bytesOf("connectivity"))];
  const offsets = [...new Int32Array(bytesOf("offsets"))];
  const cells = offsets.map((end, c) => connectivity.slice(c === 0 ? 0 : offsets[c - 1], end));
  const types = new Uint8Array(bytesOf("types"));
  const ofType = <T>(values: readonly T[], ...wanted: number[]) =>
    values.filter((_, c) => wanted.includes(types[c] ?? 0));
  // The types of first and of second order.
  const [tetrahedron, triangle] = [
    [10, 24],
    [5, 22],
  ] as const;
  return {
    points: new Float64Array(bytesOf("Points")),
    tetrahedra: ofType(cells, ...tetrahedron),
    regions: ofType([...new Int32Array(bytesOf("region"))], ...tetrahedron),
    triangles: ofType(cells, ...triangle),
    patches: ofType([...new Int32Array(bytesOf("patch"))], ...triangle),
  };
}

/**
 * Returns how far the middle nodes of second-order triangles lie from a cylinder along z, of the edges between two nodes on it;
 * Infinity for triangles without middle nodes.
 */
export function middlesOnCylinder(
  { points, triangles }: Pick<Mesh, "points" | "triangles">,
  [x, y]: readonly [number, number],
  radius: number,
): number[] {
  const gapOf = (node = NaN): number =>
    Math.abs(Math.hypot((points[3 * node] ?? Infinity) - x, (points[3 * node + 1] ?? Infinity) - y) - radius);
  return triangles.flatMap((nodes) =>
    [0, 1, 2].flatMap((corner) => {
      const areOn = [nodes[corner], nodes[(corner + 1) % 3]].every((node) => gapOf(node) < 1e-6);
      return areOn ? [gapOf(nodes[3 + corner])] : [];
    }),
  );
}

export interface GmshGroup {
  readonly name: string;
  /** Node indices of each element, from 0. */
  readonly elements: number[][];
}

export interface GmshMesh {
  readonly points: Float64Array;
  readonly triangles: readonly GmshGroup[];
  readonly tetrahedra: readonly GmshGroup[];
}

/** Reads a binary MSH 4.1 file, as Gmsh's reference manual describes it. */
export function parseMsh(bytes: Uint8Array): GmshMesh {
  const reader = new MshReader(bytes);
  const names = reader.physicalNames();
  const groupOf = reader.entities();
  const points = reader.nodes();
  const groups = reader.elements().map(({ dimension, entity, elements }) => ({
    dimension,
    name: names.get(`${dimension} ${groupOf.get(`${dimension} ${entity}`)}`) ?? "",
    elements,
  }));
  const of = (chosen: number) =>
    groups.filter(({ dimension }) => dimension === chosen).map(({ name, elements }) => ({ name, elements }));
  return { points, triangles: of(2), tetrahedra: of(3) };
}

class MshReader {
  readonly #text: string;
  readonly #view: DataView;
  #position = 0;

  constructor(bytes: Uint8Array) {
    this.#text = new TextDecoder("latin1").decode(bytes);
    this.#view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  }

  physicalNames(): Map<string, string> {
    const section = /\$PhysicalNames\n\d+\n([^$]*)\$End/.exec(this.#text)?.[1] ?? "";
    return new Map(
      [...section.matchAll(/(\d) (\d+) "(.*)"/g)].map(([, dimension, tag, name]) => [
        `${dimension} ${tag}`,
        name ?? "",
      ]),
    );
  }

  /** Returns physical tags by dimension and entity. */
  entities(): Map<string, number> {
    this.#enter("$Entities");
    const counts = [this.#size(), this.#size(), this.#size(), this.#size()];
    const groups = new Map<string, number>();
    counts.forEach((count, dimension) => {
      for (let i = 0; i < count; i++) {
        const tag = this.#int();
        this.#position += 8 * (dimension === 0 ? 3 : 6);
        const physical = Array.from({ length: this.#size() }, () => this.#int());
        groups.set(`${dimension} ${tag}`, physical[0] ?? NaN);
        const bounding = dimension === 0 ? 0 : this.#size();
        this.#position += 4 * bounding;
      }
    });
    return groups;
  }

  nodes(): Float64Array {
    this.#enter("$Nodes");
    const blocks = this.#size();
    const points = new Float64Array(3 * this.#size());
    this.#position += 16;
    for (let b = 0; b < blocks; b++) {
      this.#position += 12;
      const tags = Array.from({ length: this.#size() }, () => this.#size()).map((tag) => tag - 1);
      for (const node of tags) for (let axis = 0; axis < 3; axis++) points[3 * node + axis] = this.#double();
    }
    return points;
  }

  elements(): { dimension: number; entity: number; elements: number[][] }[] {
    this.#enter("$Elements");
    const blocks = this.#size();
    this.#position += 24;
    return Array.from({ length: blocks }, () => {
      const [dimension, entity, type] = [this.#int(), this.#int(), this.#int()];
      const width = type === 4 ? 4 : 3;
      const elements = Array.from({ length: this.#size() }, () => {
        this.#position += 8;
        return Array.from({ length: width }, () => this.#size() - 1);
      });
      return { dimension, entity, elements };
    });
  }

  #enter(section: string): void {
    this.#position = this.#text.indexOf(`${section}\n`) + section.length + 1;
  }

  #int(): number {
    this.#position += 4;
    return this.#view.getInt32(this.#position - 4, true);
  }

  #size(): number {
    this.#position += 8;
    return Number(this.#view.getBigUint64(this.#position - 8, true));
  }

  #double(): number {
    this.#position += 8;
    return this.#view.getFloat64(this.#position - 8, true);
  }
}

/** Returns the tetrahedra as a binary file of legacy VTK, which is big-endian. */
export function vtkBinary(points: Float64Array, tetrahedra: Uint32Array): Uint8Array {
  const count = tetrahedra.length / 4;
  const doubles = new DataView(new ArrayBuffer(8 * points.length));
  points.forEach((value, i) => doubles.setFloat64(8 * i, value));
  const ints = (values: readonly number[]) => {
    const view = new DataView(new ArrayBuffer(4 * values.length));
    values.forEach((value, i) => view.setInt32(4 * i, value));
    return view;
  };
  const cells = Array.from({ length: count }, (_, t) => [4, ...tetrahedra.subarray(4 * t, 4 * t + 4)]).flat();
  const parts = [
    "# vtk DataFile Version 3.0\nmade by a test\nBINARY\nDATASET UNSTRUCTURED_GRID\n",
    `POINTS ${points.length / 3} double\n`,
    doubles,
    `\nCELLS ${count} ${5 * count}\n`,
    ints(cells),
    `\nCELL_TYPES ${count}\n`,
    ints(cells.slice(0, count).fill(10)),
    `\nCELL_DATA ${count}\nSCALARS region int 1\nLOOKUP_TABLE default\n`,
    ints(cells.slice(0, count).fill(3)),
    "\n",
  ].map((part) => (typeof part === "string" ? new TextEncoder().encode(part) : new Uint8Array(part.buffer)));
  return new Uint8Array(Buffer.concat(parts));
}
