/** Reads the tables of a BREP file: locations, curves, surfaces, and the shapes that use them. */
import type { Vector } from "../base/vectors.js";
import {
  PLANE,
  readCurve,
  readSurface,
  SPACE,
  type StoredCurve,
  type StoredSurface,
} from "./brep-geometry.js";
import { type Location, Locations } from "./brep-locations.js";
import type { BrepWords } from "./brep-words.js";
import { readTriangulation, type Triangulation } from "./brep-triangles.js";
import type { Frame, PlaneFrame } from "./trimmed-model.js";

/** How a shape uses another one. */
export interface Use {
  readonly shape: number;
  readonly orientation: "forward" | "reversed" | "internal" | "external";
  readonly location: Location;
}

/** An edge's curve in the plane of a surface; two for the edge of a seam. */
export interface CurveOnSurface {
  readonly curve: number;
  /** Where the edge is passed backwards. */
  readonly backward: number;
  readonly surface: number;
  readonly location: Location;
  readonly first: number;
  readonly last: number;
}

export interface VertexShape {
  readonly kind: "vertex";
  readonly uses: readonly Use[];
  readonly position: Vector;
  readonly tolerance: number;
}

export interface EdgeShape {
  readonly kind: "edge";
  readonly uses: readonly Use[];
  readonly tolerance: number;
  readonly isDegenerate: boolean;
  readonly curve: Omit<CurveOnSurface, "backward" | "surface"> | undefined;
  readonly onSurfaces: readonly CurveOnSurface[];
}

export interface FaceShape {
  readonly kind: "face";
  readonly uses: readonly Use[];
  /** Undefined for a face that has triangles only. */
  readonly surface: number | undefined;
  readonly location: Location;
  readonly triangulation: number | undefined;
}

export interface GroupShape {
  readonly kind: "wire" | "shell" | "solid" | "group";
  readonly uses: readonly Use[];
}

export type BrepShape = VertexShape | EdgeShape | FaceShape | GroupShape;

export interface BrepTables {
  readonly locations: Locations;
  readonly planeCurves: readonly StoredCurve<PlaneFrame>[];
  readonly curves: readonly StoredCurve<Frame>[];
  readonly surfaces: readonly StoredSurface[];
  readonly triangulations: readonly Triangulation[];
  readonly shapes: readonly BrepShape[];
  readonly root: Use;
}

const KINDS = {
  Ve: "vertex",
  Ed: "edge",
  Wi: "wire",
  Fa: "face",
  Sh: "shell",
  So: "solid",
  CS: "group",
  Co: "group",
} as const;
const ORIENTATIONS = { "+": "forward", "-": "reversed", i: "internal", e: "external" } as const;
/** Numbers of words of polygons: in space, on triangles, on both sides of a seam. */
const POLYGON_WORDS: Readonly<Record<number, number>> = { 5: 2, 6: 3, 7: 4 };
const UV_VERSION = "2";
/** In files of this version, triangulations say whether they have normals. */
const NORMALS_VERSION = "3";

/** Reads the tables. Throws a CadFileError if the file is damaged. O(bytes). */
export function readTables(words: BrepWords, text: string): BrepTables {
  const version = /^CASCADE Topology V(\d)/m.exec(text)?.[1];
  if (version === undefined) throw words.wrong('expected "CASCADE Topology", the head of a BREP file');
  const locations = new Locations(words);
  const rows = <Row>(name: string, read: () => Row) => {
    const count = words.table(name);
    const all: Row[] = [];
    for (let i = 0; i < count; i++) all.push(read());
    return all;
  };
  const planeCurves = rows("Curve2ds", () => readCurve(words, PLANE));
  const curves = rows("Curves", () => readCurve(words, SPACE));
  const surfaces = rows("Surfaces", () => readSurface(words));
  const hasNormals = version === NORMALS_VERSION;
  const triangulations = rows("Triangulations", () => readTriangulation(words, hasNormals));
  const sizes = {
    planeCurves: planeCurves.length,
    curves: curves.length,
    surfaces: surfaces.length,
    triangulations: triangulations.length,
  };
  const count = words.table("TShapes");
  const reader = new ShapeReader(words, { locations, sizes, count, hasUv: version === UV_VERSION });
  const shapes: BrepShape[] = [];
  for (let i = 0; i < count; i++) shapes.push(reader.shape(i));
  const root = reader.use(words.word(), count);
  return { locations, planeCurves, curves, surfaces, triangulations, shapes, root };
}

interface Context {
  readonly locations: Locations;
  readonly sizes: {
    readonly planeCurves: number;
    readonly curves: number;
    readonly surfaces: number;
    readonly triangulations: number;
  };
  readonly count: number;
  readonly hasUv: boolean;
}

class ShapeReader {
  readonly #words: BrepWords;
  readonly #context: Context;

  constructor(words: BrepWords, context: Context) {
    this.#words = words;
    this.#context = context;
  }

  /** Reads the shape of an index; it uses shapes before it only. */
  shape(index: number): BrepShape {
    const word = this.#words.word();
    const kind = KINDS[word as keyof typeof KINDS] as (typeof KINDS)[keyof typeof KINDS] | undefined;
    if (kind === undefined) throw this.#words.wrong(`expected a kind of shape, found "${word.slice(0, 20)}"`);
    switch (kind) {
      case "vertex":
        return { kind, ...this.#vertex(), uses: this.#uses(index) };
      case "edge":
        return { kind, ...this.#edge(), uses: this.#uses(index) };
      case "face": {
        const { flags, ...face } = this.#face();
        return { kind, ...face, uses: this.#uses(index, flags) };
      }
      default:
        return { kind, uses: this.#uses(index) };
    }
  }

  #vertex() {
    const words = this.#words;
    const [tolerance, position] = [words.number(), words.vector()];
    for (;;) {
      words.number();
      const kind = words.count(3);
      if (kind === 0) return { tolerance, position };
      // On a curve: curve, location. On a curve of a surface: curve, surface, location. On a surface: v, surface, location.
      words.numbers(kind === 1 ? 2 : 3);
    }
  }

  #edge() {
    const words = this.#words;
    const tolerance = words.number();
    words.numbers(2);
    const isDegenerate = words.flag();
    let curve: EdgeShape["curve"];
    const onSurfaces: CurveOnSurface[] = [];
    for (let kind = words.count(7); kind !== 0; kind = words.count(7)) {
      if (kind === 1) {
        const index = this.#indexIn("curves");
        const location = this.#location();
        curve = { curve: index, location, first: words.number(), last: words.number() };
      } else if (kind === 2 || kind === 3) onSurfaces.push(this.#onSurface(kind === 3));
      else if (kind === 4) {
        words.word();
        words.numbers(4);
      } else words.numbers(POLYGON_WORDS[kind] ?? 0);
    }
    return { tolerance, isDegenerate, curve, onSurfaces };
  }

  #onSurface(isSeam: boolean): CurveOnSurface {
    const words = this.#words;
    const curve = this.#indexIn("planeCurves");
    const backward = isSeam ? this.#beforeContinuity() : curve;
    const surface = this.#indexIn("surfaces");
    const location = this.#location();
    const [first, last] = [words.number(), words.number()];
    if (this.#context.hasUv) words.numbers(isSeam ? 8 : 4);
    return { curve, backward, surface, location, first, last };
  }

  /** Reads the number of a curve in the plane and a continuity, which OpenCascade writes without a space: "30CN". */
  #beforeContinuity(): number {
    const word = this.#words.word();
    const [, digits = "", continuity] = /^(\d+)([CG]\w)?$/.exec(word) ?? [];
    const number = Number(digits);
    if (number === 0 || number > this.#context.sizes.planeCurves)
      throw this.#words.wrong(`expected the number of a curve in the plane, found "${word.slice(0, 20)}"`);
    if (continuity === undefined) this.#words.word();
    return number - 1;
  }

  #face() {
    const words = this.#words;
    words.numbers(2);
    const number = words.count(this.#context.sizes.surfaces);
    const surface = number === 0 ? undefined : number - 1;
    const location = this.#location();
    let flags = words.word();
    let triangulation: number | undefined;
    if (flags === "2") {
      triangulation = this.#indexIn("triangulations");
      flags = words.word();
    }
    return { surface, location, triangulation, flags };
  }

  #indexIn(table: keyof Context["sizes"]): number {
    const number = this.#words.count(this.#context.sizes[table]);
    if (number === 0) throw this.#words.wrong("expected the number of an entry of a table, found 0");
    return number - 1;
  }

  #location(): Location {
    return this.#context.locations.read(this.#words);
  }

  #uses(index: number, flags = this.#words.word()): Use[] {
    if (!/^[01]{7}$/.test(flags))
      throw this.#words.wrong(`expected the seven flags of a shape, found "${flags.slice(0, 20)}"`);
    const uses: Use[] = [];
    for (let word = this.#words.word(); word !== "*"; word = this.#words.word())
      uses.push(this.use(word, index));
    return uses;
  }

  /** Reads a use of one of the first `before` shapes. `word`: orientation and number, which counts from the end. */
  use(word: string, before: number): Use {
    const orientation = ORIENTATIONS[word[0] as keyof typeof ORIENTATIONS] as Use["orientation"] | undefined;
    const shape = this.#context.count - Number(word.slice(1));
    if (orientation === undefined || !(Number.isInteger(shape) && shape >= 0 && shape < before))
      throw this.#words.wrong(`expected a use of a shape before this one, found "${word.slice(0, 20)}"`);
    return { shape, orientation, location: this.#location() };
  }
}
