/**
 * Finds the products (parts) of a STEP file that its solids belong to. OpenCascade's list of shapes stops at the assemblies of
 * some files, so their solids have no name. The products are followed from the roots of the assemblies to the solids
 * (ISO 10303-44), in the order of the file, and then compared with the solids that OpenCascade has read.
 */
import { PAUSE, STEP, type Steps } from "../base/steps.js";
import { plainText } from "../cad/step-strings.js";
import { INSTANCE } from "./step-text.js";
import { textOf } from "./text-bytes.js";

/** A solid of a file: the product that it belongs to, and its number of faces. */
export interface ProductSolid {
  readonly product: string;
  readonly faces: number;
}

/** Entities that lead from an assembly to its solids, and those that state the faces of a solid. */
const USED =
  /^\(?\s*(PRODUCT|PRODUCT_DEFINITION_FORMATION\w*|PRODUCT_DEFINITION|PRODUCT_DEFINITION_WITH\w*|PRODUCT_DEFINITION_SHAPE|SHAPE_DEFINITION_REPRESENTATION|\w*SHAPE_REPRESENTATION|SHAPE_REPRESENTATION_RELATIONSHIP|NEXT_ASSEMBLY_USAGE_OCCURRENCE|MAPPED_ITEM|REPRESENTATION_MAP|MANIFOLD_SOLID_BREP|BREP_WITH_VOIDS|FACETED_BREP\w*|(?:ORIENTED_)?(?:CLOSED|OPEN)_SHELL)\s*\(/;

interface Entity {
  readonly type: string;
  /** Texts in quotes, and numbers of other entities, in their order. */
  readonly texts: readonly string[];
  readonly refs: readonly string[];
}

/** Largest number of solids that are followed: an assembly may contain itself in a damaged file, or grow like a power. */
const MAX_SOLIDS = 100_000;
const MAX_DEPTH = 100;

/** Returns the solids of all assemblies and parts of a STEP file, in the order in which they are used. O(bytes). */
export function* productSolids(bytes: Uint8Array): Steps<ProductSolid[]> {
  const entities = new Map<string, Entity>();
  let instances = 0;
  for (const [, id = "", definition = ""] of textOf(bytes).matchAll(INSTANCE)) {
    if (++instances % STEP === 0) yield PAUSE;
    const type = USED.exec(definition)?.[1];
    if (type !== undefined) entities.set(id, entityOf(type, definition));
  }
  return new Products(entities).solids();
}

function entityOf(type: string, definition: string): Entity {
  const texts: string[] = [];
  const bare = definition.replace(/'((?:[^']|'')*)'/g, (_, text: string) => {
    texts.push(text);
    return "";
  });
  return { type, texts, refs: Array.from(bare.matchAll(/#(\d+)/g), ([, id = ""]) => id) };
}

class Products {
  readonly #entities: ReadonlyMap<string, Entity>;
  /** Per product definition: its representations, and the definitions that it is assembled of. */
  readonly #shapes = new Map<string, string[]>();
  readonly #components = new Map<string, string[]>();
  /** Representations of the same shape. */
  readonly #related = new Map<string, string[]>();

  constructor(entities: ReadonlyMap<string, Entity>) {
    this.#entities = entities;
    for (const { type, refs } of entities.values()) {
      const [one = "", other = ""] = refs;
      if (type === "NEXT_ASSEMBLY_USAGE_OCCURRENCE") push(this.#components, one, other);
      else if (type === "SHAPE_REPRESENTATION_RELATIONSHIP") {
        push(this.#related, one, other);
        push(this.#related, other, one);
      } else if (type === "SHAPE_DEFINITION_REPRESENTATION") {
        const shape = entities.get(one);
        if (shape?.type === "PRODUCT_DEFINITION_SHAPE") push(this.#shapes, shape.refs[0] ?? "", other);
      }
    }
  }

  /** Returns the solids of the products that are part of no other, and of their components. */
  solids(): ProductSolid[] {
    const used = new Set([...this.#components.values()].flat());
    const found: ProductSolid[] = [];
    for (const [id, { type }] of this.#entities) {
      if (/^PRODUCT_DEFINITION(_WITH\w*)?$/.test(type) && !used.has(id)) this.#addProduct(id, found, 0);
    }
    return found;
  }

  #addProduct(id: string, found: ProductSolid[], depth: number): void {
    if (depth > MAX_DEPTH || found.length > MAX_SOLIDS) return;
    for (const component of this.#components.get(id) ?? []) this.#addProduct(component, found, depth + 1);
    const product = this.#nameOf(id);
    const seen = new Set<string>();
    const open = [...(this.#shapes.get(id) ?? [])];
    for (let shape = open.shift(); shape !== undefined; shape = open.shift()) {
      if (seen.has(shape)) continue;
      seen.add(shape);
      open.push(...(this.#related.get(shape) ?? []));
      this.#addItems(shape, product, found, depth);
    }
  }

  /** Adds the solids among the items of a representation, and those of representations that are mapped into it. */
  #addItems(shape: string, product: string, found: ProductSolid[], depth: number): void {
    if (depth > MAX_DEPTH || found.length > MAX_SOLIDS) return;
    for (const item of this.#entities.get(shape)?.refs ?? []) {
      const { type = "", refs = [] } = this.#entities.get(item) ?? {};
      if (/BREP/.test(type) && !/REPRESENTATION/.test(type))
        found.push({ product, faces: this.#facesOf(refs) });
      if (type !== "MAPPED_ITEM") continue;
      const mapped = this.#entities.get(refs[0] ?? "")?.refs[1] ?? "";
      this.#addItems(mapped, this.#ownerOf(mapped) ?? product, found, depth + 1);
    }
  }

  /** Returns the name of the product whose shape a representation is. */
  #ownerOf(shape: string): string | undefined {
    const owner = [...this.#shapes].find(([, shapes]) => shapes.includes(shape))?.[0];
    return owner === undefined ? undefined : this.#nameOf(owner);
  }

  #nameOf(definition: string): string {
    const formation = this.#entities.get(this.#entities.get(definition)?.refs[0] ?? "");
    const [id = "", name = ""] = this.#entities.get(formation?.refs[0] ?? "")?.texts ?? [];
    return plainText(name.trim() === "" ? id : name);
  }

  #facesOf(shells: readonly string[]): number {
    return shells.reduce((sum, id) => {
      const { type = "", refs = [] } = this.#entities.get(id) ?? {};
      return sum + (type.startsWith("ORIENTED_") ? this.#facesOf(refs) : refs.length);
    }, 0);
  }
}

function push(lists: Map<string, string[]>, key: string, value: string): void {
  const list = lists.get(key);
  if (list === undefined) lists.set(key, [value]);
  else list.push(value);
}

/**
 * Returns the product of each solid that was read; undefined where it cannot be known. `faces`: their numbers of faces. If they are
 * those of the file in its order, or if there is only one product, each solid has its product; otherwise those whose number of
 * faces only one product has.
 */
export function productsOf(
  faces: readonly number[],
  solids: readonly ProductSolid[],
): (string | undefined)[] {
  const isSame = faces.length === solids.length && faces.every((count, s) => count === solids[s]?.faces);
  if (isSame) return solids.map(({ product }) => product || undefined);
  const names = new Set(solids.map(({ product }) => product));
  const [only] = names;
  if (names.size === 1) return faces.map(() => only || undefined);
  const products = new Map<number, Set<string>>();
  for (const { product, faces: count } of solids) {
    products.set(count, (products.get(count) ?? new Set()).add(product));
  }
  return faces.map((count) => {
    const [product, another] = products.get(count) ?? [];
    return another === undefined ? product || undefined : undefined;
  });
}
