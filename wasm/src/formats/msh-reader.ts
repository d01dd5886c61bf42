/**
 * Reads Gmsh's MSH files, versions 4.1 and 2.2, binary and text, as written by this package, Gmsh and meshio. The
 * patch of a triangle or quadrilateral, and the region of a tetrahedron, is its physical group or, without one, its
 * entity. Values at nodes are kept. Points, lines and other sections are skipped.
 */
import { plural } from "../base/plural.js";
import type { Mesh } from "../mesh/mesh.js";
import { ByteReader, FIRST_LINE } from "./byte-reader.js";
import type { ByteSource } from "./byte-source.js";
import { DuplicateElements } from "./duplicate-elements.js";
import { ExtraGroups } from "./extra-groups.js";
import { type GroupList, MeshBuilder } from "./mesh-builder.js";
import { MshEntities } from "./msh-entities.js";
import { MshNumbers } from "./msh-numbers.js";
import { MshVolumes } from "./msh-volumes.js";
import { NodeTags } from "./node-tags.js";
import { UNCUT } from "./polygons.js";

/** The last two nodes of a tetrahedron with ten nodes are in the opposite order. */
function fromGmshOrder(nodes: readonly number[]): readonly number[] {
  return nodes.length === 10 ? [...nodes.slice(0, 8), ...nodes.slice(8).reverse()] : nodes;
}

const REMEDY = "Save the mesh again as MSH 4.1 or 2.2 with linear triangles and tetrahedra, or as .vtu.";
const TRIANGLE = 2;
const QUADRILATERAL = 3;
const TETRAHEDRON = 4;
const TRIANGLE6 = 9;
const TETRAHEDRON10 = 11;
/** Linear elements with the corners of second-order ones. */
const LINEAR_TYPES: ReadonlyMap<number, number> = new Map([
  [TRIANGLE6, TRIANGLE],
  [TETRAHEDRON10, TETRAHEDRON],
]);
/** Nodes per element of the supported types; points and lines are skipped. */
const WIDTHS: ReadonlyMap<number, number> = new Map([
  [1, 2],
  [TRIANGLE, 3],
  [QUADRILATERAL, 4],
  [TETRAHEDRON, 4],
  [TRIANGLE6, 6],
  [TETRAHEDRON10, 10],
  [8, 3],
  [15, 1],
]);
/** Largest number of values per node: a tensor has nine. */
const MAX_COMPONENTS = 9;
/** Largest number of sections of values: each needs memory for all nodes or elements, however few values it has. */
const MAX_DATA = 16;

export function readMsh(source: ByteSource): Promise<Mesh> {
  return ByteReader.over(source, { remedy: REMEDY }, async (reader) =>
    new MshReader(reader, await readFormat(reader)).read(),
  );
}

/** Reads the first section, which states how numbers are encoded. */
async function readFormat(reader: ByteReader): Promise<MshNumbers> {
  if (reader.line() !== "$MeshFormat") {
    reader.fail('the file does not begin with "$MeshFormat"', FIRST_LINE);
  }
  const format = reader.line();
  const [version, kind, size] = format.split(/\s+/);
  if ((version !== "4.1" && version !== "2.2") || size !== "8") {
    reader.fail(
      `the format is "${format.slice(0, 24)}"; only versions 4.1 and 2.2 with data size 8 are supported`,
    );
  }
  const isBinary = kind === "1";
  // The number 1, in the byte order of the file.
  if (isBinary) reader.isLittleEndian = reader.integer(4, true) === 1;
  await reader.skipPast("$EndMeshFormat");
  return new MshNumbers(reader, isBinary, version === "4.1");
}

/** Tags of an element in version 2.2: physical group and entity, 0 for none. */
type Tags = readonly [number, number];

class MshReader {
  readonly #reader: ByteReader;
  readonly #numbers: MshNumbers;
  readonly #entities: MshEntities;
  readonly #builder = new MeshBuilder();
  readonly #nodes = new NodeTags();
  readonly #tetrahedra = new NodeTags();
  /** Names of physical groups by tag, of surfaces and of volumes. */
  readonly #names = { patches: new Map<number, string>(), regions: new Map<number, string>() };
  readonly #volumes = new MshVolumes();
  readonly #extraGroups = new ExtraGroups();
  #sectionsOfData = 0;
  /** Number of nodes of all earlier `$Nodes` sections. */
  #nodesBefore = 0;
  readonly #listed = new Map<number, DuplicateElements>();
  #duplicateTetrahedra = 0;
  #duplicateTriangles = 0;

  constructor(reader: ByteReader, numbers: MshNumbers) {
    this.#reader = reader;
    this.#numbers = numbers;
    this.#entities = new MshEntities(reader, numbers, this.#volumes);
  }

  /** Reads the sections after the format. */
  async read(): Promise<Mesh> {
    for (;;) {
      await this.#reader.fill();
      const section = this.#reader.word();
      if (section === "") return this.#mesh();
      await this.#readSection(section);
      await this.#reader.skipPast(`$End${section.slice(1)}`);
    }
  }

  #mesh(): Mesh {
    const mesh = this.#builder.mesh(this.#names);
    const surfaceRegions = this.#volumes.regions(mesh, this.#names.regions);
    const isLost = surfaceRegions === undefined && mesh.regions.length === 0 && this.#names.regions.size > 0;
    const unlocatedRegions = isLost ? [...this.#names.regions.values()] : undefined;
    const notes = [
      ...(mesh.notes ?? []),
      ...this.#extraGroups.notes({ 2: this.#names.patches, 3: this.#names.regions }),
    ];
    return {
      format: `Gmsh ${this.#numbers.hasBlocks ? "4.1" : "2.2"}`,
      ...mesh,
      surfaceRegions,
      unlocatedRegions,
      duplicateTetrahedra: this.#duplicateTetrahedra,
      duplicateTriangles: this.#duplicateTriangles,
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
        if (this.#builder.elementData.size > 0)
          this.#reader.fail("a section of elements follows the values of elements");
        this.#reader.endLine();
        if (this.#numbers.hasBlocks) return this.#readElementBlocks();
        return this.#numbers.isBinary ? this.#readElementRuns() : this.#readElementList();
      case "$NodeData":
        return this.#readData("node");
      case "$ElementData":
        return this.#readData("element");
      default:
        if (!section.startsWith("$")) this.#reader.failUnknown("section", section);
    }
  }

  async #readNames(): Promise<void> {
    const reader = this.#reader;
    const count = this.#reader.count(reader.number("the number of names"), "names");
    reader.endLine();
    for (let i = 0; i < count; i++) {
      await reader.fill();
      const [, dimension, tag, name] = /^(\d+)\s+(\d+)\s+"(.*)"$/.exec(reader.line()) ?? [];
      if (name === undefined) reader.fail("expected a physical name as dimension, tag and name in quotes");
      if (dimension === "2") this.#names.patches.set(Number(tag), name ?? "");
      if (dimension === "3") this.#names.regions.set(Number(tag), name ?? "");
    }
  }

  /**
   * Starts a node section. There may be several with different nodes; a repeated node means that the file holds
   * several meshes.
   */
  #beginNodes(): void {
    this.#nodesBefore = this.#builder.pointCount;
    if (this.#builder.nodeData.size > 0) this.#reader.fail("a section of nodes follows the values at nodes");
  }

  #addNode(tag: number): void {
    const known = this.#nodesBefore > 0 ? this.#nodes.indexOf(tag) : undefined;
    if (known !== undefined && known < this.#nodesBefore) {
      this.#reader.fail(`node ${tag} is in two sections $Nodes, so the file holds several meshes`);
    }
    this.#nodes.add(tag);
    const [x, y, z] = [this.#numbers.double(), this.#numbers.double(), this.#numbers.double()];
    if (!(Number.isFinite(x) && Number.isFinite(y) && Number.isFinite(z))) {
      this.#reader.fail(`node ${tag} has a coordinate that is not finite`);
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

  /** `isParametric`: after the coordinates follow a dimension, an entity, and the parameters on it. */
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

  /** Reads the node tags of an element with a tag, and adds it. */
  #readElement(tag: number, given: number, group: (groups: GroupList) => number, tags?: Tags): void {
    const all = Array.from({ length: this.#width(given) }, () => this.#numbers.size());
    const type = LINEAR_TYPES.get(given) ?? given;
    const corners = all.slice(0, this.#width(type));
    const middles = all.slice(corners.length);
    if (type !== TRIANGLE && type !== QUADRILATERAL && type !== TETRAHEDRON) return;
    const nodeOf = (tag: number) =>
      this.#nodes.indexOf(tag) ?? this.#reader.fail(`an element refers to node ${tag}, which does not exist`);
    const nodes = corners.map(nodeOf);
    if (tags !== undefined && this.#isDuplicate(type, tags, nodes)) return;
    if (type !== given) this.#builder.addSecondOrder(fromGmshOrder([...nodes, ...middles.map(nodeOf)]));
    if (type === TETRAHEDRON) {
      const [a = 0, b = 0, c = 0, d = 0] = nodes;
      this.#tetrahedra.add(tag);
      this.#builder.addTetrahedron(a, b, c, d, group(this.#builder.regions));
    } else if (!this.#builder.addPolygon(nodes, group(this.#builder.patches))) {
      this.#reader.fail(`a quadrilateral ${UNCUT}`);
    }
  }

  #readListed(tag: number, type: number, tags: Tags): void {
    this.#readElement(tag, type, this.#groupOf(...tags), tags);
  }

  /**
   * Version 2.2 lists an element once per physical group, and an interface once per volume: the first listing
   * counts. A tetrahedron listed twice in one group is kept twice, so that the checks of meshes report it.
   */
  #isDuplicate(type: number, [physical]: Tags, nodes: readonly number[]): boolean {
    const listed = this.#listed.get(type) ?? new DuplicateElements();
    this.#listed.set(type, listed);
    const first = listed.firstGroup(nodes, physical);
    const isDuplicate = first !== undefined && (type !== TETRAHEDRON || first !== physical);
    if (isDuplicate && physical > 0 && first !== physical) {
      this.#extraGroups.add(type === TETRAHEDRON ? 3 : 2, physical, 1);
    }
    if (isDuplicate && type === TETRAHEDRON) this.#duplicateTetrahedra++;
    else if (isDuplicate) this.#duplicateTriangles++;
    return isDuplicate;
  }

  #width(type: number): number {
    return (
      WIDTHS.get(type) ??
      this.#reader.fail(
        `the file has elements of type ${type}; only linear triangles and tetrahedra are supported`,
      )
    );
  }

  /** Selects the group of an element: its physical group if it has one, else its entity. */
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
      for (const other of others) if (count > 0) this.#extraGroups.add(dimension, other, count);
      if (dimension === 2) this.#volumes.trianglesFollow(this.#builder.triangleCount, entity);
      for (let e = 0; e < count; e++) {
        if (this.#reader.isLow) await this.#reader.fill();
        this.#readElement(this.#numbers.size(), type, group);
      }
    }
  }

  /** Reads elements of version 2.2, binary: runs of elements of one type. */
  async #readElementRuns(): Promise<void> {
    const total = this.#reader.count(Number(this.#reader.line()), "elements");
    for (let read = 0; read < total;) {
      const type = this.#numbers.int();
      const count = this.#reader.count(this.#numbers.int(), "elements");
      const tagCount = this.#reader.count(this.#numbers.int(), "tags");
      for (let e = 0; e < count; e++) {
        if (this.#reader.isLow) await this.#reader.fill();
        const tag = this.#numbers.int();
        this.#readListed(tag, type, await this.#readTags(tagCount));
      }
      read += Math.max(count, 1);
      if (this.#reader.isLow) await this.#reader.fill();
    }
  }

  async #readElementList(): Promise<void> {
    const total = this.#reader.count(Number(this.#reader.line()), "elements");
    for (let e = 0; e < total; e++) {
      if (this.#reader.isLow) await this.#reader.fill();
      const tag = this.#numbers.int();
      const type = this.#numbers.int();
      this.#readListed(tag, type, await this.#readTags(this.#reader.count(this.#numbers.int(), "tags")));
    }
  }

  /** Reads the tags of an element: physical group, entity, and others that are ignored. */
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

  /** Reads values by the tags of nodes or elements; those of elements that are no tetrahedra are passed over. */
  async #readData(kind: "node" | "element"): Promise<void> {
    const reader = this.#reader;
    reader.endLine();
    const strings = await this.#readLines("names");
    await this.#readLines("times");
    const [, width, rows] = (await this.#readLines("numbers")).map(Number);
    const components = this.#reader.count(width ?? NaN, `values per ${kind}`);
    if (components === 0 || components > MAX_COMPONENTS) {
      reader.fail(
        `the file has ${plural(components, "value")} per ${kind}; only 1 to ${MAX_COMPONENTS} are supported`,
      );
    }
    const count = this.#reader.count(rows ?? NaN, "values");
    if (++this.#sectionsOfData > MAX_DATA)
      reader.fail(`the file has more than ${MAX_DATA} sections of values at nodes or of elements`);
    const isOfNodes = kind === "node";
    const tags = isOfNodes ? this.#nodes : this.#tetrahedra;
    const owners = isOfNodes ? this.#builder.pointCount : this.#builder.tetrahedronCount;
    const values = new Float64Array(components * owners).fill(NaN);
    for (let r = 0; r < count; r++) {
      if (reader.isLow) await reader.fill();
      const owner = tags.indexOf(this.#numbers.int());
      if (owner === undefined && isOfNodes) reader.fail("a value refers to a node that does not exist");
      for (let i = 0; i < components; i++) {
        const value = this.#numbers.value();
        if (owner !== undefined) values[components * owner + i] = value;
      }
    }
    const name = (strings[0] ?? "").replace(/^"|"$/g, "");
    if (isOfNodes) this.#builder.nodeData.set(name, { components, values });
    else if (owners > 0) this.#builder.elementData.set(name, { components, values });
  }

  /** Reads a count in one line, then that number of lines. */
  async #readLines(what: string): Promise<string[]> {
    const count = this.#reader.count(Number(this.#reader.line()), what);
    const lines: string[] = [];
    for (let i = 0; i < count; i++) {
      await this.#reader.fill();
      if (this.#reader.isAtEnd) this.#reader.failAtEnd(what);
      lines.push(this.#reader.line());
    }
    return lines;
  }
}
