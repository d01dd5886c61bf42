/**
 * Reads Gmsh's MSH files, versions 4.1 and 2.2, binary and text: those this package writes, Gmsh's own and
 * meshio's. Triangles and quadrilaterals go to patches, tetrahedra to regions, by their physical group or,
 * without one, their entity; numbers at nodes are kept. Points, lines and other sections are passed over.
 */
import { ByteReader, FIRST_LINE } from "./byte-reader.js";
import type { ByteSource } from "./byte-source.js";
import type { FileMesh } from "./file-mesh.js";
import { LostGroups } from "./lost-groups.js";
import { MeshBuilder, type GroupList } from "./mesh-builder.js";
import { MshEntities } from "./msh-entities.js";
import { MshNumbers } from "./msh-numbers.js";
import { MshVolumes } from "./msh-volumes.js";
import { NodeTags } from "./node-tags.js";
import { UNCUT } from "./polygons.js";
import { RepeatedElements } from "./repeated-elements.js";

const REMEDY = "Save the mesh again as MSH 4.1 or 2.2 with linear triangles and tetrahedra, or as .vtu.";
const TRIANGLE = 2;
const QUADRILATERAL = 3;
const TETRAHEDRON = 4;
/** Nodes per element of the types that can be read; points and lines are passed over. */
const WIDTHS: ReadonlyMap<number, number> = new Map([
  [1, 2],
  [TRIANGLE, 3],
  [QUADRILATERAL, 4],
  [TETRAHEDRON, 4],
  [8, 3],
  [15, 1],
]);
/** No node has more numbers: a tensor has nine. */
const MAX_COMPONENTS = 9;
/** Each takes memory for all nodes, however few numbers it has. */
const MAX_DATA = 16;

export function readMsh(source: ByteSource): Promise<FileMesh> {
  return ByteReader.over(source, { remedy: REMEDY }, async (reader) =>
    new MshReader(reader, await readFormat(reader)).read(),
  );
}

/** The first section, which tells how numbers are written. */
async function readFormat(reader: ByteReader): Promise<MshNumbers> {
  if (reader.line() !== "$MeshFormat") {
    reader.fail('the file does not begin with "$MeshFormat"', FIRST_LINE);
  }
  const format = reader.line();
  const [version, kind, size] = format.split(/\s+/);
  if ((version !== "4.1" && version !== "2.2") || size !== "8") {
    reader.fail(`the format is "${format.slice(0, 24)}", versions 4.1 and 2.2 of size 8 can be read`);
  }
  const isBinary = kind === "1";
  // The number 1, in the byte order of all that follow.
  if (isBinary) reader.isLittleEndian = reader.integer(4, true) === 1;
  await reader.skipPast("$EndMeshFormat");
  return new MshNumbers(reader, isBinary, version === "4.1");
}

/** Of an element in version 2.2: its physical group and its entity, 0 for none. */
type Tags = readonly [number, number];

class MshReader {
  readonly #reader: ByteReader;
  readonly #numbers: MshNumbers;
  readonly #entities: MshEntities;
  readonly #builder = new MeshBuilder();
  readonly #nodes = new NodeTags();
  /** Names of physical groups by tag, of surfaces and of volumes. */
  readonly #names = { patches: new Map<number, string>(), regions: new Map<number, string>() };
  readonly #volumes = new MshVolumes();
  readonly #lost = new LostGroups();
  #sectionsOfData = 0;
  /** Nodes of the sections before this one. */
  #nodesBefore = 0;
  readonly #listed = new Map<number, RepeatedElements>();
  #repeatedTetrahedra = 0;
  #repeatedTriangles = 0;

  constructor(reader: ByteReader, numbers: MshNumbers) {
    this.#reader = reader;
    this.#numbers = numbers;
    this.#entities = new MshEntities(reader, numbers, this.#volumes);
  }

  /** The sections behind that of the format. */
  async read(): Promise<FileMesh> {
    for (;;) {
      await this.#reader.fill();
      const section = this.#reader.word();
      if (section === "") return this.#mesh();
      await this.#readSection(section);
      await this.#reader.skipPast(`$End${section.slice(1)}`);
    }
  }

  #mesh(): FileMesh {
    const mesh = this.#builder.mesh(this.#names);
    const surfaceRegions = this.#volumes.regions(mesh, this.#names.regions);
    const isLost = surfaceRegions === undefined && mesh.regions.length === 0 && this.#names.regions.size > 0;
    const unplacedRegions = isLost ? [...this.#names.regions.values()] : undefined;
    const notes = this.#lost.notes({ 2: this.#names.patches, 3: this.#names.regions });
    return {
      format: `Gmsh ${this.#numbers.hasBlocks ? "4.1" : "2.2"}`,
      ...mesh,
      surfaceRegions,
      unplacedRegions,
      repeatedTetrahedra: this.#repeatedTetrahedra,
      repeatedTriangles: this.#repeatedTriangles,
      ...(notes.length > 0 && { notes }),
    };
  }

  async #readSection(section: string): Promise<void> {
    switch (section) {
      case "$PhysicalNames":
        return this.#readNames();
      case "$Entities":
        if (this.#numbers.hasBlocks) await this.#entities.read();
        return;
      case "$PartitionedEntities":
        if (this.#numbers.hasBlocks) await this.#entities.readPartitioned();
        return;
      case "$Nodes":
        this.#beginNodes();
        this.#reader.endLine();
        return this.#numbers.hasBlocks ? this.#readNodeBlocks() : this.#readNodeList(false);
      case "$ParametricNodes":
        this.#beginNodes();
        this.#reader.endLine();
        return this.#readNodeList(true);
      case "$Elements":
        this.#reader.endLine();
        if (this.#numbers.hasBlocks) return this.#readElementBlocks();
        return this.#numbers.isBinary ? this.#readElementRuns() : this.#readElementList();
      case "$NodeData":
        return this.#readNodeData();
      default:
        if (!section.startsWith("$")) this.#reader.fail(`"${section.slice(0, 24)}" is not a section`);
    }
  }

  async #readNames(): Promise<void> {
    const reader = this.#reader;
    const count = this.#reader.count(reader.number("the number of names"), "names");
    reader.endLine();
    for (let i = 0; i < count; i++) {
      await reader.fill();
      const [, dimension, tag, name] = /^(\d+)\s+(\d+)\s+"(.*)"$/.exec(reader.line()) ?? [];
      if (name === undefined) reader.fail("a physical name is not written as dimension, tag and name");
      if (dimension === "2") this.#names.patches.set(Number(tag), name ?? "");
      if (dimension === "3") this.#names.regions.set(Number(tag), name ?? "");
    }
  }

  /** Sections may be repeated, with other nodes; where they have the same, a mesh stands behind another. */
  #beginNodes(): void {
    this.#nodesBefore = this.#builder.pointCount;
    if (this.#builder.nodeData.size > 0) this.#reader.fail("nodes stand behind the numbers at nodes");
  }

  #addNode(tag: number): void {
    const known = this.#nodesBefore > 0 ? this.#nodes.positionOf(tag) : undefined;
    if (known !== undefined && known < this.#nodesBefore) {
      this.#reader.fail(`node ${tag} is in two sections $Nodes: the file holds several meshes`);
    }
    this.#nodes.add(tag);
    const [x, y, z] = [this.#numbers.double(), this.#numbers.double(), this.#numbers.double()];
    if (!(Number.isFinite(x) && Number.isFinite(y) && Number.isFinite(z))) {
      this.#reader.fail(`node ${tag} has no finite place`);
    }
    this.#builder.addPoint(x, y, z);
  }

  async #readNodeBlocks(): Promise<void> {
    const blocks = this.#numbers.count("blocks of nodes");
    for (let i = 0; i < 3; i++) this.#numbers.size();
    for (let b = 0; b < blocks; b++) {
      await this.#reader.fill();
      const dimension = this.#numbers.int();
      this.#numbers.int();
      const extra = this.#numbers.int() === 0 ? 0 : Math.min(dimension, 3);
      const count = this.#numbers.count("nodes");
      const tags: number[] = [];
      for (let i = 0; i < count; i++) {
        if (this.#reader.isLow) await this.#reader.fill();
        tags.push(this.#numbers.size());
      }
      for (const tag of tags) {
        if (this.#reader.isLow) await this.#reader.fill();
        this.#addNode(tag);
        for (let i = 0; i < extra; i++) this.#numbers.double();
      }
    }
  }

  /** `isParametric`: behind the place stand a dimension and an entity, and where the node is on its line or face. */
  async #readNodeList(isParametric: boolean): Promise<void> {
    const count = this.#reader.count(Number(this.#reader.line()), "nodes");
    for (let i = 0; i < count; i++) {
      if (this.#reader.isLow) await this.#reader.fill();
      this.#addNode(this.#numbers.int());
      if (!isParametric) continue;
      const dimension = this.#numbers.int();
      this.#numbers.int();
      for (let p = 0; p < dimension && dimension < 3; p++) this.#numbers.double();
    }
  }

  /** The next numbers are tags of the nodes of an element. */
  #readElement(type: number, group: (groups: GroupList) => number, tags?: Tags): void {
    const corners = Array.from({ length: this.#width(type) }, () => this.#numbers.size());
    if (type !== TRIANGLE && type !== QUADRILATERAL && type !== TETRAHEDRON) return;
    const nodes = corners.map(
      (tag) =>
        this.#nodes.positionOf(tag) ?? this.#reader.fail(`an element has a corner that is no node: ${tag}`),
    );
    if (tags !== undefined && this.#isRepeated(type, tags, nodes)) return;
    if (type === TETRAHEDRON) {
      const [a = 0, b = 0, c = 0, d = 0] = nodes;
      this.#builder.addTetrahedron(a, b, c, d, group(this.#builder.regions));
    } else if (!this.#builder.addPolygon(nodes, group(this.#builder.patches))) {
      this.#reader.fail(`a quadrilateral ${UNCUT}`);
    }
  }

  #readListed(type: number, tags: Tags): void {
    this.#readElement(type, this.#groupOf(...tags), tags);
  }

  /**
   * Version 2.2 lists an element once for each of its physical groups, and walls for each of their volumes: the first
   * counts. A tetrahedron that is there twice in one group is a fault, which the checks of meshes tell.
   */
  #isRepeated(type: number, [physical]: Tags, nodes: readonly number[]): boolean {
    const listed = this.#listed.get(type) ?? new RepeatedElements();
    this.#listed.set(type, listed);
    const first = listed.firstGroup(nodes, physical);
    const isRepeated = first !== undefined && (type !== TETRAHEDRON || first !== physical);
    if (isRepeated && physical > 0 && first !== physical) {
      this.#lost.add(type === TETRAHEDRON ? 3 : 2, physical, 1);
    }
    if (isRepeated && type === TETRAHEDRON) this.#repeatedTetrahedra++;
    else if (isRepeated) this.#repeatedTriangles++;
    return isRepeated;
  }

  #width(type: number): number {
    return (
      WIDTHS.get(type) ??
      this.#reader.fail(`elements of type ${type} cannot be read, only linear triangles and tetrahedra`)
    );
  }

  /** By its physical group where it has one, else by its entity. */
  #groupOf(physical: number, entity: number): (groups: GroupList) => number {
    return (groups) =>
      physical > 0
        ? groups.tagged(physical)
        : groups.of(`entity ${entity}`, () => ({ name: `entity ${entity}`, tag: entity }));
  }

  async #readElementBlocks(): Promise<void> {
    const blocks = this.#numbers.count("blocks of elements");
    for (let i = 0; i < 3; i++) this.#numbers.size();
    for (let b = 0; b < blocks; b++) {
      await this.#reader.fill();
      const dimension = this.#numbers.int();
      const entity = this.#numbers.int();
      const type = this.#numbers.int();
      const count = this.#numbers.count("elements");
      const [first = 0, ...others] = this.#entities.groupsOf(dimension, entity);
      const group = this.#groupOf(first, entity);
      for (const other of others) if (count > 0) this.#lost.add(dimension, other, count);
      if (dimension === 2) this.#volumes.trianglesFollow(this.#builder.triangleCount, entity);
      for (let e = 0; e < count; e++) {
        if (this.#reader.isLow) await this.#reader.fill();
        this.#numbers.size();
        this.#readElement(type, group);
      }
    }
  }

  /** Version 2.2, binary: runs of elements of one type. */
  async #readElementRuns(): Promise<void> {
    const total = this.#reader.count(Number(this.#reader.line()), "elements");
    for (let read = 0; read < total;) {
      const type = this.#numbers.int();
      const count = this.#reader.count(this.#numbers.int(), "elements");
      const tagCount = this.#reader.count(this.#numbers.int(), "tags");
      for (let e = 0; e < count; e++) {
        if (this.#reader.isLow) await this.#reader.fill();
        this.#numbers.int();
        this.#readListed(type, await this.#readTags(tagCount));
      }
      read += Math.max(count, 1);
      if (this.#reader.isLow) await this.#reader.fill();
    }
  }

  async #readElementList(): Promise<void> {
    const total = this.#reader.count(Number(this.#reader.line()), "elements");
    for (let e = 0; e < total; e++) {
      if (this.#reader.isLow) await this.#reader.fill();
      this.#numbers.int();
      const type = this.#numbers.int();
      this.#readListed(type, await this.#readTags(this.#reader.count(this.#numbers.int(), "tags")));
    }
  }

  /** Physical group, entity, and whatever else. */
  async #readTags(count: number): Promise<Tags> {
    let [physical, entity] = [0, 0];
    for (let i = 0; i < count; i++) {
      if (this.#reader.isLow) await this.#reader.fill();
      const tag = this.#numbers.int();
      if (i === 0) physical = Math.abs(tag);
      if (i === 1) entity = tag;
    }
    return [physical, entity];
  }

  async #readNodeData(): Promise<void> {
    const reader = this.#reader;
    reader.endLine();
    const strings = await this.#readLines("names");
    await this.#readLines("times");
    const [, width, rows] = (await this.#readLines("numbers")).map(Number);
    const components = this.#reader.count(width ?? NaN, "numbers per node");
    if (components === 0 || components > MAX_COMPONENTS) {
      reader.fail(`${components} numbers per node cannot be read`);
    }
    const count = this.#reader.count(rows ?? NaN, "values");
    if (++this.#sectionsOfData > MAX_DATA) reader.fail(`more than ${MAX_DATA} sections of numbers at nodes`);
    const values = new Float64Array(components * this.#builder.pointCount).fill(NaN);
    for (let r = 0; r < count; r++) {
      if (reader.isLow) await reader.fill();
      const node = this.#nodes.positionOf(this.#numbers.int()) ?? reader.fail("a value belongs to no node");
      for (let i = 0; i < components; i++) {
        values[components * node + i] = this.#numbers.value();
      }
    }
    const name = (strings[0] ?? "").replace(/^"|"$/g, "");
    this.#builder.nodeData.set(name, { components, values });
  }

  /** Their number in one line, then each in its own. */
  async #readLines(what: string): Promise<string[]> {
    const count = this.#reader.count(Number(this.#reader.line()), what);
    const lines: string[] = [];
    for (let i = 0; i < count; i++) {
      await this.#reader.fill();
      if (this.#reader.isAtEnd) this.#reader.fail(`the file ends where ${what} should be`);
      lines.push(this.#reader.line());
    }
    return lines;
  }
}
