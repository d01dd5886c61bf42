/** Collects the points, elements and groups found by a reader. */
import type { MeshGroup, Mesh, NodeData } from "../mesh/mesh.js";
import { Column } from "./column.js";
import { facetPolygons } from "./facets.js";
import { addPolygon, ClippingBudget, type Position3 } from "./polygons.js";
import { SecondOrderNodes } from "./second-order-nodes.js";
import { sixfoldVolume } from "./sixfold-volume.js";
import { PointWelder } from "./weld.js";

/** Groups in order of first appearance, identified by a key of the format. */
export class GroupList {
  readonly #indices = new Map<string | number, number>();
  readonly #groups: MeshGroup[] = [];
  /** Indices of the groups that the file identifies by tag. */
  readonly #tagged = new Set<number>();
  readonly #word: string;

  /** `word` names groups without a name: "patch 7" by its tag. */
  constructor(word: string) {
    this.#word = word;
  }

  get length(): number {
    return this.#groups.length;
  }

  /** Returns the index of the group with this key; undefined if there is none. */
  known(key: string | number): number | undefined {
    return this.#indices.get(key);
  }

  /** Returns the index of the group with this tag; adds it if it is new. */
  tagged(tag: number, name?: string): number {
    return this.of(tag, () => {
      this.#tagged.add(this.#groups.length);
      return { name: name ?? `${this.#word} ${tag}`, tag };
    });
  }

  /** Returns the index of the group with this name; adds it if it is new. New groups are numbered from 1. */
  named(name: string, color?: MeshGroup["color"]): number {
    return this.of(name, () => ({ name, tag: this.#groups.length + 1, color }));
  }

  of(key: string | number, make: () => MeshGroup): number {
    const known = this.#indices.get(key);
    if (known !== undefined) return known;
    this.#indices.set(key, this.#groups.length);
    return this.#groups.push(make()) - 1;
  }

  /** Returns the groups. `names` apply to groups identified by tag. Other groups get tags that differ from those. */
  groups(names: ReadonlyMap<number, string> = new Map()): readonly MeshGroup[] {
    const taken = new Set(this.#groups.filter((_, g) => this.#tagged.has(g)).map(({ tag }) => tag));
    let free = 1;
    const numberFor = (tag: number): number => {
      if (taken.has(tag)) for (tag = free; taken.has(tag); free = ++tag);
      taken.add(tag);
      return tag;
    };
    return this.#groups.map((group, index) =>
      this.#tagged.has(index)
        ? { ...group, name: names.get(group.tag) ?? group.name }
        : { ...group, tag: numberFor(group.tag) },
    );
  }
}

/** Node order of a file's tetrahedra: positive or negative volume. */
class Orientations {
  reversed = 0;
  /** Tetrahedra whose sign is certain. */
  readonly #positive = new Column(Uint32Array);
  readonly #negative = new Column(Uint32Array);
  #count = 0;

  add(isReversed: boolean, isSure: boolean): void {
    if (isReversed) this.reversed++;
    if (isSure) (isReversed ? this.#negative : this.#positive).push(this.#count);
    this.#count++;
  }

  /** Returns the tetrahedra in the minority; in a tie, those of negative volume. */
  inverted(): Uint32Array {
    const isMostlyPositive = this.#positive.length >= this.#negative.length;
    return (isMostlyPositive ? this.#negative : this.#positive).taken();
  }
}

export class MeshBuilder {
  readonly patches = new GroupList("patch");
  readonly regions = new GroupList("region");
  readonly nodeData = new Map<string, NodeData>();
  readonly elementData = new Map<string, NodeData>();
  readonly #points = new Column(Float64Array);
  readonly #triangles = new Column(Uint32Array);
  readonly #trianglePatch = new Column(Uint32Array);
  readonly #tetrahedra = new Column(Uint32Array);
  readonly #tetrahedronRegion = new Column(Uint32Array);
  readonly #welder: PointWelder | undefined;
  /** Called after cutting polygons has taken a while, so that other work can run. */
  onLongWork: () => void = () => undefined;
  readonly #clipping = new ClippingBudget(() => this.onLongWork());
  readonly #orientations = new Orientations();
  readonly #secondOrder = new SecondOrderNodes();

  /** `isSoup`: the file repeats its points; `addCorner` welds them as they arrive. */
  constructor(isSoup = false) {
    this.#welder = isSoup ? new PointWelder() : undefined;
  }

  get pointCount(): number {
    return this.#welder?.count ?? this.#points.length / 3;
  }

  get tetrahedronCount(): number {
    return this.#tetrahedronRegion.length;
  }

  get triangleCount(): number {
    return this.#trianglePatch.length;
  }

  addPoint(x: number, y: number, z: number): void {
    this.#points.push(x);
    this.#points.push(y);
    this.#points.push(z);
  }

  /** Adds a corner of a triangle soup; returns its node. */
  addCorner(x: number, y: number, z: number): number {
    return this.#welder?.add(x, y, z) ?? 0;
  }

  /**
   * Records a triangle or tetrahedron of second order, which the reader adds by its corners; the other nodes are left out
   * of the mesh. `nodes` in the order of second-order.ts.
   */
  addSecondOrder(nodes: readonly number[]): void {
    this.#secondOrder.add(nodes, this.#points);
  }

  addTriangle(a: number, b: number, c: number, patch: number): void {
    this.#triangles.push(a);
    this.#triangles.push(b);
    this.#triangles.push(c);
    this.#trianglePatch.push(patch);
  }

  /**
   * Adds polygons in one plane, nested or not. Returns false, and may have added some of them, if they cannot be
   * cut safely.
   */
  addFacet(rings: readonly (readonly number[])[], holes: readonly Position3[], patch: number): boolean {
    const polygons = facetPolygons(rings, holes, this.#points, this.#clipping);
    return polygons?.every((corners) => this.addPolygon(corners, patch)) === true;
  }

  /** Adds a polygon as triangles. Returns false, and adds nothing, if it cannot be cut safely. All nodes must exist. */
  addPolygon(corners: readonly number[], patch: number): boolean {
    const [a = 0, b = 0, c = 0] = corners;
    if (corners.length === 3) {
      this.addTriangle(a, b, c, patch);
      return true;
    }
    const triangles: number[] = [];
    if (!addPolygon(corners, this.#points, triangles, this.#clipping)) return false;
    for (let i = 0; i < triangles.length; i += 3) {
      this.addTriangle(triangles[i] ?? 0, triangles[i + 1] ?? 0, triangles[i + 2] ?? 0, patch);
    }
    return true;
  }

  /**
   * Adds a tetrahedron; swaps two nodes if (b-a)×(c-a)·(d-a) is negative, because formats differ in node order. All
   * nodes must exist.
   */
  addTetrahedron(a: number, b: number, c: number, d: number, region: number): void {
    const { volume, isSure } = sixfoldVolume(this.#points, a, b, c, d);
    const isReversed = volume < 0;
    this.#orientations.add(isReversed, isSure && volume !== 0);
    this.#tetrahedra.push(isReversed ? b : a);
    this.#tetrahedra.push(isReversed ? a : b);
    this.#tetrahedra.push(c);
    this.#tetrahedra.push(d);
    this.#tetrahedronRegion.push(region);
  }

  /** Returns the collected mesh and empties the builder. `names` by tag, if the file has them. */
  mesh(
    names: {
      readonly patches?: ReadonlyMap<number, string>;
      readonly regions?: ReadonlyMap<number, string>;
    } = {},
  ): Mesh {
    return this.#secondOrder.leftOutOf({
      points: this.#welder?.taken() ?? this.#points.taken(),
      isWelded: this.#welder !== undefined,
      ...(this.#welder !== undefined && { isSoup: true }),
      triangles: this.#triangles.taken(),
      trianglePatch: this.#trianglePatch.taken(),
      patches: this.patches.groups(names.patches),
      tetrahedra: this.#tetrahedra.taken(),
      tetrahedronRegion: this.#tetrahedronRegion.taken(),
      reversedTetrahedra: this.#orientations.reversed,
      invertedTetrahedra: this.#orientations.inverted(),
      regions: this.regions.groups(names.regions),
      nodeData: this.nodeData,
      ...(this.elementData.size > 0 && { elementData: this.elementData }),
    });
  }
}
