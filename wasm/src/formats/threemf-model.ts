/** Parses the model of a 3MF file: objects, colours and materials, and what is to be built of them. */
import { PAUSE, STEP, type Steps } from "../base/steps.js";
import type { MeshGroup } from "../mesh/mesh.js";
import { Column } from "./column.js";
import { failureAt } from "./read-result.js";
import { type Attributes, attributesIn, lineAt, tagsIn } from "./xml-tags.js";

export const THREE_MF_REMEDY = "Export the model again as 3MF, or as STL.";

/** Twelve numbers: x' = x m[0] + y m[3] + z m[6] + m[9], and so on. */
export type Transform = readonly number[];

/** An object as it is used by an item or by another object. */
export interface Use {
  readonly object: string;
  readonly transform: Transform;
  /** Offset of its tag. */
  readonly at: number;
}

export interface ModelObject {
  readonly name: string;
  readonly isSupport: boolean;
  /** x y z per node. */
  readonly points: Float64Array;
  readonly triangles: Uint32Array;
  /** Per triangle: index in `properties` of the model. */
  readonly property: Uint32Array;
  readonly components: readonly Use[];
}

export interface Model {
  /** Millimetres per unit. */
  readonly scale: number;
  readonly objects: ReadonlyMap<string, ModelObject>;
  /** What triangles consist of; the first one is nothing in particular. */
  readonly properties: readonly Pick<MeshGroup, "name" | "color">[];
  readonly items: readonly Use[];
}

const SCALES: Readonly<Record<string, number>> = {
  micron: 0.001,
  millimeter: 1,
  centimeter: 10,
  inch: 25.4,
  foot: 304.8,
  meter: 1000,
};

const NUMBERS_OF_TRANSFORM = 12;
const IDENTITY: Transform = [1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0];

interface OpenObject {
  readonly id: string;
  readonly name: string;
  readonly isSupport: boolean;
  /** Group of properties of triangles that name none. */
  readonly group: string | undefined;
  /** Property of triangles without their own. */
  readonly property: number;
  readonly points: Column<Float64Array>;
  readonly triangles: Column<Uint32Array>;
  readonly owners: Column<Uint32Array>;
  readonly components: Use[];
}

class ModelParser {
  readonly #bytes: Uint8Array;
  #scale: number | undefined;
  readonly #objects = new Map<string, ModelObject>();
  readonly #properties: Pick<MeshGroup, "name" | "color">[] = [{ name: "" }];
  /** Index of a property by the id of its group and its index there. */
  readonly #propertyOf = new Map<string, number>();
  readonly #items: Use[] = [];
  #object: OpenObject | undefined;
  #group = { id: "", count: 0 };

  constructor(bytes: Uint8Array) {
    this.#bytes = bytes;
  }

  *parse(): Steps<Model> {
    let count = 0;
    for (const { begin, isClosing, name, rest } of tagsIn(this.#bytes)) {
      if (++count % STEP === 0) yield PAUSE;
      // Names may have the prefix of an extension, such as "m:".
      const element = name.slice(name.indexOf(":") + 1);
      if (!isClosing) this.#open(element, attributesIn(rest), begin);
      if (element === "object" && (isClosing || rest.endsWith("/"))) this.#close();
    }
    if (this.#scale === undefined) return this.#fail("the model has no tag <model>", 0);
    if (this.#object !== undefined)
      return this.#fail(`object ${this.#object.id} does not end: the file is truncated`, this.#bytes.length);
    return {
      scale: this.#scale,
      objects: this.#objects,
      properties: this.#properties,
      items: this.#items,
    };
  }

  #open(element: string, given: Attributes, at: number): void {
    switch (element) {
      case "model":
        return this.#openModel(given, at);
      case "object":
        return this.#openObject(given, at);
      case "vertex":
        for (const axis of ["x", "y", "z"]) this.#open3d(at).points.push(this.#number(given, axis, at));
        return;
      case "triangle":
        return this.#addTriangle(given, at);
      case "component":
        this.#open3d(at).components.push(this.#use(given, at));
        return;
      case "item":
        this.#items.push(this.#use(given, at));
        return;
      case "basematerials":
      case "colorgroup":
        this.#group = { id: given.get("id") ?? "", count: 0 };
        return;
      case "base":
        return this.#addProperty(given.get("name") ?? "", given.get("displaycolor"));
      case "color":
        return this.#addProperty("", given.get("color"));
    }
  }

  #openModel(given: Attributes, at: number): void {
    const unit = given.get("unit") ?? "millimeter";
    this.#scale = SCALES[unit] ?? this.#fail(`unknown unit "${unit.slice(0, 24)}"`, at);
  }

  #openObject(given: Attributes, at: number): void {
    if (this.#object !== undefined) this.#fail(`object ${this.#object.id} does not end`, at);
    const id = given.get("id") ?? this.#fail("an object has no id", at);
    if (this.#objects.has(id)) this.#fail(`two objects have the id ${id.slice(0, 24)}`, at);
    this.#object = {
      id,
      name: given.get("name") ?? "",
      isSupport: /support/.test(given.get("type") ?? ""),
      group: given.get("pid"),
      property: this.#property(given.get("pid"), given.get("pindex")),
      points: new Column(Float64Array),
      triangles: new Column(Uint32Array),
      owners: new Column(Uint32Array),
      components: [],
    };
  }

  #open3d(at: number): OpenObject {
    return this.#object ?? this.#fail("a part of a mesh is outside objects", at);
  }

  #addTriangle(given: Attributes, at: number): void {
    const object = this.#open3d(at);
    const nodes = object.points.length / 3;
    for (const corner of ["v1", "v2", "v3"]) {
      const node = this.#number(given, corner, at);
      if (!Number.isInteger(node) || node < 0 || node >= nodes)
        this.#fail(`${corner} is ${node}, but the object has no such vertex`, at);
      object.triangles.push(node);
    }
    const own = given.has("p1") || given.has("pid");
    object.owners.push(
      own
        ? this.#property(given.get("pid") ?? object.group, given.get("p1")) || object.property
        : object.property,
    );
  }

  #use(given: Attributes, at: number): Use {
    if ([...given.keys()].some((name) => /(^|:)path$/.test(name)))
      this.#fail(
        "the model is divided into several files (production extension), which is not supported",
        at,
      );
    const object = given.get("objectid") ?? this.#fail("the objectid is missing", at);
    const text = given.get("transform");
    const transform = text === undefined ? IDENTITY : text.trim().split(/\s+/).map(Number);
    if (transform.length !== NUMBERS_OF_TRANSFORM || !transform.every(Number.isFinite))
      this.#fail(
        `a transform needs ${NUMBERS_OF_TRANSFORM} numbers, found "${(text ?? "").slice(0, 40)}"`,
        at,
      );
    return { object, transform, at };
  }

  #addProperty(name: string, color: string | undefined): void {
    const { id } = this.#group;
    const key = `${id} ${this.#group.count++}`;
    const parsed = colorIn(color);
    const own = name || (parsed === undefined ? key : (color ?? "").slice(0, 7).toLowerCase());
    this.#propertyOf.set(key, this.#properties.push({ name: own, ...(parsed && { color: parsed }) }) - 1);
  }

  /** Returns the index of a property; that of nothing in particular if it is not known. */
  #property(group: string | undefined, index: string | undefined): number {
    return this.#propertyOf.get(`${group ?? ""} ${index ?? "0"}`) ?? 0;
  }

  #number(given: Attributes, name: string, at: number): number {
    const text = given.get(name);
    if (text === undefined) return this.#fail(`${name} is missing`, at);
    const value = Number(text);
    if (text.trim() === "" || !Number.isFinite(value))
      return this.#fail(`${name} must be a number, found "${text.slice(0, 24)}"`, at);
    return value;
  }

  #close(): void {
    if (this.#object === undefined) return;
    const { id, name, isSupport, points, triangles, owners, components } = this.#object;
    this.#object = undefined;
    const arrays = { points: points.taken(), triangles: triangles.taken(), property: owners.taken() };
    this.#objects.set(id, { name, isSupport, ...arrays, components });
  }

  #fail(message: string, at: number): never {
    return failInModel(this.#bytes, message, at);
  }
}

/** Fails at a byte of the model; the message states its line. */
export function failInModel(bytes: Uint8Array, message: string, at: number): never {
  throw failureAt({ line: lineAt(bytes, at) }, `${message} (in the model of the 3MF file)`, THREE_MF_REMEDY);
}

export function parseModel(bytes: Uint8Array): Steps<Model> {
  return new ModelParser(bytes).parse();
}

/** Parses "#rrggbb", which may be followed by the opacity. */
function colorIn(text: string | undefined): readonly [number, number, number] | undefined {
  const [, red = "", green = "", blue = ""] = /^#(..)(..)(..)(..)?$/.exec(text ?? "") ?? [];
  const parts = [red, green, blue].map((part) => (part === "" ? NaN : Number(`0x${part}`) / 255));
  return parts.every(Number.isFinite) ? (parts as [number, number, number]) : undefined;
}
