/** Collects what a reader finds. */
import { Column } from "./column.js";
import { facetPolygons } from "./facets.js";
import type { FileGroup, FileMesh, NodeData } from "./file-mesh.js";
import { addPolygon, ClippingBudget, type Triple } from "./polygons.js";
import { sixfoldVolume } from "./sixfold-volume.js";
import { PointWelder } from "./weld.js";

/** Groups in order of first appearance, by whatever the format tells them apart by. */
export class GroupList {
  readonly #positions = new Map<string | number, number>();
  readonly #groups: FileGroup[] = [];
  /** Positions of the groups that the file tells apart by their numbers. */
  readonly #tagged = new Set<number>();
  readonly #word: string;

  /** `word` names groups that have no name: "patch 7" by its tag. */
  constructor(word: string) {
    this.#word = word;
  }

  get length(): number {
    return this.#groups.length;
  }

  /** The position of the group of this key, if there is one. */
  known(key: string | number): number | undefined {
    return this.#positions.get(key);
  }

  /** The position of a group told by its number. */
  tagged(tag: number, name?: string): number {
    return this.of(tag, () => {
      this.#tagged.add(this.#groups.length);
      return { name: name ?? `${this.#word} ${tag}`, tag };
    });
  }

  /** The position of a group told by its name; numbered from 1 in order. */
  named(name: string, color?: FileGroup["color"]): number {
    return this.of(name, () => ({ name, tag: this.#groups.length + 1, color }));
  }

  of(key: string | number, make: () => FileGroup): number {
    const known = this.#positions.get(key);
    if (known !== undefined) return known;
    this.#positions.set(key, this.#groups.length);
    return this.#groups.push(make()) - 1;
  }

  /**
   * With the names that the file gives to numbers elsewhere. Those are of groups told by their numbers alone; where
   * there are such, all others have numbers that are none of theirs.
   */
  groups(names: ReadonlyMap<number, string> = new Map()): readonly FileGroup[] {
    const taken = new Set(this.#groups.filter((_, g) => this.#tagged.has(g)).map(({ tag }) => tag));
    let free = 1;
    const numberFor = (tag: number): number => {
      if (taken.has(tag)) for (tag = free; taken.has(tag); free = ++tag);
      taken.add(tag);
      return tag;
    };
    return this.#groups.map((group, position) =>
      this.#tagged.has(position)
        ? { ...group, name: names.get(group.tag) ?? group.name }
        : { ...group, tag: numberFor(group.tag) },
    );
  }
}

/** Which way round a file counts the nodes of its tetrahedra. */
class Turns {
  turned = 0;
  /** Of each of two ways: the tetrahedra that are so beyond doubt. */
  readonly #upright = new Column(Uint32Array);
  readonly #upsideDown = new Column(Uint32Array);
  #count = 0;

  add(isTurned: boolean, isSure: boolean): void {
    if (isTurned) this.turned++;
    if (isSure) (isTurned ? this.#upsideDown : this.#upright).push(this.#count);
    this.#count++;
  }

  /** Those that are turned against most; of as many each way, those with negative volumes. */
  inverted(): Uint32Array {
    const isUpright = this.#upright.length >= this.#upsideDown.length;
    return (isUpright ? this.#upsideDown : this.#upright).taken();
  }
}

export class MeshBuilder {
  readonly patches = new GroupList("patch");
  readonly regions = new GroupList("region");
  readonly nodeData = new Map<string, NodeData>();
  readonly #points = new Column(Float64Array);
  readonly #triangles = new Column(Uint32Array);
  readonly #trianglePatch = new Column(Uint32Array);
  readonly #tetrahedra = new Column(Uint32Array);
  readonly #tetrahedronRegion = new Column(Uint32Array);
  readonly #welder: PointWelder | undefined;
  /** Called where cutting polygons has taken a while, for others to run. */
  onLongWork: () => void = () => undefined;
  readonly #clipping = new ClippingBudget(() => this.onLongWork());
  readonly #turns = new Turns();

  /** `isSoup`: the file repeats its points, which are welded as they come (`addCorner`). */
  constructor(isSoup = false) {
    this.#welder = isSoup ? new PointWelder() : undefined;
  }

  get pointCount(): number {
    return this.#welder?.count ?? this.#points.length / 3;
  }

  get triangleCount(): number {
    return this.#trianglePatch.length;
  }

  addPoint(x: number, y: number, z: number): void {
    this.#points.push(x);
    this.#points.push(y);
    this.#points.push(z);
  }

  /** A corner of a soup; its node. */
  addCorner(x: number, y: number, z: number): number {
    return this.#welder?.add(x, y, z) ?? 0;
  }

  addTriangle(a: number, b: number, c: number, patch: number): void {
    this.#triangles.push(a);
    this.#triangles.push(b);
    this.#triangles.push(c);
    this.#trianglePatch.push(patch);
  }

  /** Several polygons of one plane, around each other or not; else as `addPolygon`. */
  addFacet(rings: readonly (readonly number[])[], holes: readonly Triple[], patch: number): boolean {
    const polygons = facetPolygons(rings, holes, this.#points, this.#clipping);
    return polygons?.every((corners) => this.addPolygon(corners, patch)) === true;
  }

  /** Cut into triangles; false, and nothing added, if that cannot be done safely. All nodes must be there. */
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

  /** Turned so that (b-a)×(c-a)·(d-a) is not below 0; formats differ in that. All nodes must be there. */
  addTetrahedron(a: number, b: number, c: number, d: number, region: number): void {
    const { volume, isSure } = sixfoldVolume(this.#points, a, b, c, d);
    const isTurned = volume < 0;
    this.#turns.add(isTurned, isSure && volume !== 0);
    this.#tetrahedra.push(isTurned ? b : a);
    this.#tetrahedra.push(isTurned ? a : b);
    this.#tetrahedra.push(c);
    this.#tetrahedra.push(d);
    this.#tetrahedronRegion.push(region);
  }

  /** Everything collected; the builder is empty afterwards. Names by tag where the file has them. */
  mesh(
    names: {
      readonly patches?: ReadonlyMap<number, string>;
      readonly regions?: ReadonlyMap<number, string>;
    } = {},
  ): FileMesh {
    return {
      points: this.#welder?.taken() ?? this.#points.taken(),
      isWelded: this.#welder !== undefined,
      triangles: this.#triangles.taken(),
      trianglePatch: this.#trianglePatch.taken(),
      patches: this.patches.groups(names.patches),
      tetrahedra: this.#tetrahedra.taken(),
      tetrahedronRegion: this.#tetrahedronRegion.taken(),
      turnedTetrahedra: this.#turns.turned,
      invertedTetrahedra: this.#turns.inverted(),
      regions: this.regions.groups(names.regions),
      nodeData: this.nodeData,
    };
  }
}
