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
  return ByteReader.over(source, { remedy: REMEDY }, (reader) => new MshReader(reader).read());
}

/** Of an element in version 2.2: its physical group and its entity, 0 for none. */
type Tags = readonly [number, number];

class MshReader {
  readonly #reader: ByteReader;
  readonly #builder = new MeshBuilder();
  readonly #nodes = new NodeTags();
  /** Names of physical groups by tag, of surfaces and of volumes. */
  readonly #names = { patches: new Map<number, string>(), regions: new Map<number, string>() };
  readonly #volumes = new MshVolumes();
  /** Physical tags of an entity, by "dimension tag". The first counts. */
  readonly #physical = new Map<string, readonly number[]>();
  readonly #lost = new LostGroups();
  #sectionsOfData = 0;
  /** Nodes of the sections before this one. */
  #nodesBefore = 0;
  #isBinary = false;
  #hasBlocks = true;
  readonly #listed = new Map<number, RepeatedElements>();
  #repeatedTetrahedra = 0;
  #repeatedTriangles = 0;

  constructor(reader: ByteReader) {
    this.#reader = reader;
  }

  async read(): Promise<FileMesh> {
    await this.#readFormat();
    for (;;) {
      await this.#reader.fill();
      const section = this.#reader.word();
      if (section === "") {
        const mesh = this.#builder.mesh(this.#names);
        const surfaceRegions = this.#volumes.regions(mesh, this.#names.regions);
        const isLost =
          surfaceRegions === undefined && mesh.regions.length === 0 && this.#names.regions.size > 0;
        const unplacedRegions = isLost ? [...this.#names.regions.values()] : undefined;
        const notes = this.#lost.notes({ 2: this.#names.patches, 3: this.#names.regions });
        return {
          format: `Gmsh ${this.#hasBlocks ? "4.1" : "2.2"}`,
          ...mesh,
          surfaceRegions,
          unplacedRegions,
          repeatedTetrahedra: this.#repeatedTetrahedra,
          repeatedTriangles: this.#repeatedTriangles,
          ...(notes.length > 0 && { notes }),
        };
      }
      await this.#readSection(section);
      await this.#reader.skipPast(`$End${section.slice(1)}`);
    }
  }

  async #readFormat(): Promise<void> {
    const reader = this.#reader;
    if (reader.line() !== "$MeshFormat") {
      reader.fail('the file does not begin with "$MeshFormat"', FIRST_LINE);
    }
    const format = reader.line();
    const [version, kind, size] = format.split(/\s+/);
    if ((version !== "4.1" && version !== "2.2") || size !== "8") {
      reader.fail(`the format is "${format.slice(0, 24)}", versions 4.1 and 2.2 of size 8 can be read`);
    }
    this.#hasBlocks = version === "4.1";
    this.#isBinary = kind === "1";
    // The number 1, in the byte order of all that follow.
    if (this.#isBinary) reader.isLittleEndian = reader.integer(4, true) === 1;
    await reader.skipPast("$EndMeshFormat");
  }

  async #readSection(section: string): Promise<void> {
    switch (section) {
      case "$PhysicalNames":
        return this.#readNames();
      case "$Entities":
        if (this.#hasBlocks) await this.#readEntities();
        return;
      case "$PartitionedEntities":
        if (this.#hasBlocks) await this.#readPartitionedEntities();
        return;
      case "$Nodes":
        this.#beginNodes();
        this.#reader.endLine();
        return this.#hasBlocks ? this.#readNodeBlocks() : this.#readNodeList(false);
      case "$ParametricNodes":
        this.#beginNodes();
        this.#reader.endLine();
        return this.#readNodeList(true);
      case "$Elements":
        this.#reader.endLine();
        if (this.#hasBlocks) return this.#readElementBlocks();
        return this.#isBinary ? this.#readElementRuns() : this.#readElementList();
      case "$NodeData":
        return this.#readNodeData();
      default:
        if (!section.startsWith("$")) this.#reader.fail(`"${section.slice(0, 24)}" is not a section`);
    }
  }

  #int(): number {
    return this.#isBinary ? this.#reader.integer(4, true) : this.#reader.number("a number");
  }

  /** Of 8 bytes in version 4.1. */
  #size(): number {
    if (!this.#isBinary) return this.#reader.number("a number");
    return this.#hasBlocks ? this.#reader.integer(8, false) : this.#reader.integer(4, true);
  }

  #double(): number {
    return this.#isBinary ? this.#reader.float(8) : this.#reader.number("a coordinate");
  }

  #count(value: number, what: string): number {
    return this.#reader.count(value, what);
  }

  async #readNames(): Promise<void> {
    const reader = this.#reader;
    const count = this.#count(reader.number("the number of names"), "names");
    reader.endLine();
    for (let i = 0; i < count; i++) {
      await reader.fill();
      const [, dimension, tag, name] = /^(\d+)\s+(\d+)\s+"(.*)"$/.exec(reader.line()) ?? [];
      if (name === undefined) reader.fail("a physical name is not written as dimension, tag and name");
      if (dimension === "2") this.#names.patches.set(Number(tag), name ?? "");
      if (dimension === "3") this.#names.regions.set(Number(tag), name ?? "");
    }
  }

  async #readEntities(): Promise<void> {
    this.#reader.endLine();
    await this.#eachEntity(() => undefined);
  }

  /** What a mesh was cut into: entities of their own, with the physical groups of what they are part of. */
  async #readPartitionedEntities(): Promise<void> {
    this.#reader.endLine();
    this.#size();
    await this.#skipInts(2 * this.#count(this.#size(), "ghosts"));
    await this.#eachEntity(async () => {
      const parent = `${this.#int()} ${this.#int()}`;
      await this.#skipInts(this.#count(this.#size(), "partitions"));
      return this.#physical.get(parent);
    });
  }

  async #skipInts(count: number): Promise<void> {
    for (let i = 0; i < count; i++) {
      if (this.#reader.isLow) await this.#reader.fill();
      this.#int();
    }
  }

  /** `readParent`: what stands behind the tag; gives the physical groups for entities that have none of their own. */
  async #eachEntity(readParent: () => Promise<readonly number[] | undefined> | undefined): Promise<void> {
    const counts = [0, 1, 2, 3].map(() => this.#count(this.#size(), "entities"));
    for (const [dimension, count] of counts.entries()) {
      for (let i = 0; i < count; i++) {
        await this.#reader.fill();
        const tag = this.#int();
        const inherited = await readParent();
        if (inherited !== undefined) this.#physical.set(`${dimension} ${tag}`, inherited);
        for (let c = 0; c < (dimension === 0 ? 3 : 6); c++) this.#double();
        const groups: number[] = [];
        for (let left = this.#count(this.#size(), "physical groups"); left > 0; left--) {
          if (this.#reader.isLow) await this.#reader.fill();
          // Below 0 where the entity is turned in its group.
          groups.push(Math.abs(this.#int()));
        }
        if (groups.length > 0) this.#physical.set(`${dimension} ${tag}`, groups);
        const around = dimension === 0 ? 0 : this.#count(this.#size(), "bounding entities");
        const [group] = this.#physical.get(`${dimension} ${tag}`) ?? [];
        for (let b = 0; b < around; b++) {
          if (this.#reader.isLow) await this.#reader.fill();
          const bounding = this.#int();
          if (dimension === 3 && group !== undefined) this.#volumes.bound(bounding, group);
        }
      }
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
    const [x, y, z] = [this.#double(), this.#double(), this.#double()];
    if (!(Number.isFinite(x) && Number.isFinite(y) && Number.isFinite(z))) {
      this.#reader.fail(`node ${tag} has no finite place`);
    }
    this.#builder.addPoint(x, y, z);
  }

  async #readNodeBlocks(): Promise<void> {
    const blocks = this.#count(this.#size(), "blocks of nodes");
    for (let i = 0; i < 3; i++) this.#size();
    for (let b = 0; b < blocks; b++) {
      await this.#reader.fill();
      const dimension = this.#int();
      this.#int();
      const extra = this.#int() === 0 ? 0 : Math.min(dimension, 3);
      const count = this.#count(this.#size(), "nodes");
      const tags: number[] = [];
      for (let i = 0; i < count; i++) {
        if (this.#reader.isLow) await this.#reader.fill();
        tags.push(this.#size());
      }
      for (const tag of tags) {
        if (this.#reader.isLow) await this.#reader.fill();
        this.#addNode(tag);
        for (let i = 0; i < extra; i++) this.#double();
      }
    }
  }

  /** `isParametric`: behind the place stand a dimension and an entity, and where the node is on its line or face. */
  async #readNodeList(isParametric: boolean): Promise<void> {
    const count = this.#count(Number(this.#reader.line()), "nodes");
    for (let i = 0; i < count; i++) {
      if (this.#reader.isLow) await this.#reader.fill();
      this.#addNode(this.#int());
      if (!isParametric) continue;
      const dimension = this.#int();
      this.#int();
      for (let p = 0; p < dimension && dimension < 3; p++) this.#double();
    }
  }

  /** The next numbers are tags of the nodes of an element. */
  #readElement(type: number, group: (groups: GroupList) => number, tags?: Tags): void {
    const corners = Array.from({ length: this.#width(type) }, () => this.#size());
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
    const blocks = this.#count(this.#size(), "blocks of elements");
    for (let i = 0; i < 3; i++) this.#size();
    for (let b = 0; b < blocks; b++) {
      await this.#reader.fill();
      const dimension = this.#int();
      const entity = this.#int();
      const type = this.#int();
      const count = this.#count(this.#size(), "elements");
      const [first = 0, ...others] = this.#physical.get(`${dimension} ${entity}`) ?? [];
      const group = this.#groupOf(first, entity);
      for (const other of others) if (count > 0) this.#lost.add(dimension, other, count);
      if (dimension === 2) this.#volumes.trianglesFollow(this.#builder.triangleCount, entity);
      for (let e = 0; e < count; e++) {
        if (this.#reader.isLow) await this.#reader.fill();
        this.#size();
        this.#readElement(type, group);
      }
    }
  }

  /** Version 2.2, binary: runs of elements of one type. */
  async #readElementRuns(): Promise<void> {
    const total = this.#count(Number(this.#reader.line()), "elements");
    for (let read = 0; read < total;) {
      const type = this.#int();
      const count = this.#count(this.#int(), "elements");
      const tagCount = this.#count(this.#int(), "tags");
      for (let e = 0; e < count; e++) {
        if (this.#reader.isLow) await this.#reader.fill();
        this.#int();
        this.#readListed(type, await this.#readTags(tagCount));
      }
      read += Math.max(count, 1);
      if (this.#reader.isLow) await this.#reader.fill();
    }
  }

  async #readElementList(): Promise<void> {
    const total = this.#count(Number(this.#reader.line()), "elements");
    for (let e = 0; e < total; e++) {
      if (this.#reader.isLow) await this.#reader.fill();
      this.#int();
      const type = this.#int();
      this.#readListed(type, await this.#readTags(this.#count(this.#int(), "tags")));
    }
  }

  /** Physical group, entity, and whatever else. */
  async #readTags(count: number): Promise<Tags> {
    let [physical, entity] = [0, 0];
    for (let i = 0; i < count; i++) {
      if (this.#reader.isLow) await this.#reader.fill();
      const tag = this.#int();
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
    const components = this.#count(width ?? NaN, "numbers per node");
    if (components === 0 || components > MAX_COMPONENTS) {
      reader.fail(`${components} numbers per node cannot be read`);
    }
    const count = this.#count(rows ?? NaN, "values");
    if (++this.#sectionsOfData > MAX_DATA) reader.fail(`more than ${MAX_DATA} sections of numbers at nodes`);
    const values = new Float64Array(components * this.#builder.pointCount).fill(NaN);
    for (let r = 0; r < count; r++) {
      if (reader.isLow) await reader.fill();
      const node = this.#nodes.positionOf(this.#int()) ?? reader.fail("a value belongs to no node");
      for (let i = 0; i < components; i++) {
        values[components * node + i] = this.#isBinary ? reader.float(8) : reader.number("a value", true);
      }
    }
    const name = (strings[0] ?? "").replace(/^"|"$/g, "");
    this.#builder.nodeData.set(name, { components, values });
  }

  /** Their number in one line, then each in its own. */
  async #readLines(what: string): Promise<string[]> {
    const count = this.#count(Number(this.#reader.line()), what);
    const lines: string[] = [];
    for (let i = 0; i < count; i++) {
      await this.#reader.fill();
      if (this.#reader.isAtEnd) this.#reader.fail(`the file ends where ${what} should be`);
      lines.push(this.#reader.line());
    }
    return lines;
  }
}
