import type { Project } from "tetrafront";
import { numbersPerNode, packedNodes, packedTetrahedra, partsOf } from "./packed-grid";
import { forEachInSlices } from "./slices";

const keys = new WeakMap<Project, string>();
const partKeys = new WeakMap<object, string>();

/** Odd constants of about 32 random bits, and the two states of the hash to begin with. */
const factors = [0x9e3779b1, 0x85ebca77] as const;
const seeds = [0x243f6a88, 0x13198a2e] as const;

/** A hash of 64 bits, fed with whole numbers. */
class Hash {
  #a: number = seeds[0];
  #b: number = seeds[1];

  add(value: number): void {
    this.#a = Math.imul(this.#a ^ value, factors[0]);
    this.#b = Math.imul(this.#b ^ value, factors[1]);
    this.#a ^= this.#b >>> 15;
    this.#b ^= this.#a >>> 13;
  }

  /** As hexadecimal digits. */
  get text(): string {
    return [this.#a, this.#b].map((half) => (half >>> 0).toString(16).padStart(8, "0")).join("");
  }
}

const scratch = new DataView(new ArrayBuffer(8));

function addReal(hash: Hash, value: number): void {
  scratch.setFloat64(0, value);
  hash.add(scratch.getUint32(0));
  hash.add(scratch.getUint32(4));
}

/** Of a text; equal for different texts once in 10^19. */
function hashText(text: string): string {
  const hash = new Hash();
  for (let i = 0; i < text.length; ++i) hash.add(text.charCodeAt(i));
  return hash.text;
}

/** The lists that may be long are hashed number by number, without a text in between. */
function hashNodes(nodes: Project["background"]["nodes"]): string {
  const hash = new Hash();
  const packed = packedNodes(nodes);
  for (let first = 0; first < packed.length; first += numbersPerNode) addNode(hash, packed, first);
  return hash.text;
}

function addNode(hash: Hash, packed: Float64Array, first: number): void {
  hash.add(packed[first] ?? 0);
  const { stretching, direction } = partsOf(packed, first);
  hash.add((stretching ? 1 : 0) + (direction ? 2 : 0));
  for (let k = 1; k < 5; ++k) addReal(hash, packed[first + k] ?? 0);
  if (stretching) addReal(hash, packed[first + 5] ?? 0);
  if (direction) for (let k = 6; k < 9; ++k) addReal(hash, packed[first + k] ?? 0);
}

function hashTetrahedra(tetrahedra: Project["background"]["tetrahedra"]): string {
  const hash = new Hash();
  const packed = packedTetrahedra(tetrahedra);
  for (let i = 0; i < packed.length; ++i) hash.add(packed[i] ?? 0);
  return hash.text;
}

/** Finds the keys of a large grid's lists while the page goes on, so that `contentKey` has them at once. */
export async function prepareKeys({
  nodes,
  tetrahedra,
}: Pick<Project["background"], "nodes" | "tetrahedra">) {
  const ofNodes = new Hash();
  const places = packedNodes(nodes);
  await forEachInSlices(nodes.length, (i) => addNode(ofNodes, places, numbersPerNode * i));
  partKeys.set(nodes, ofNodes.text);
  const ofTetrahedra = new Hash();
  const ids = packedTetrahedra(tetrahedra);
  await forEachInSlices(ids.length, (i) => ofTetrahedra.add(ids[i] ?? 0));
  partKeys.set(tetrahedra, ofTetrahedra.text);
}

function keyOf<Part extends object>(part: Part, compute: (part: Part) => string): string {
  let key = partKeys.get(part);
  if (key === undefined) {
    key = compute(part);
    partKeys.set(part, key);
  }
  return key;
}

const hashJson = (part: object): string => hashText(JSON.stringify(part));

/**
 * Equal for projects of equal content, whatever their identity. Each list is looked at once only, so
 * that moving a point costs nothing for a large background grid.
 */
export function contentKey(project: Project): string {
  let key = keys.get(project);
  if (key === undefined) {
    const { points, lines, patches, background, ...head } = project;
    const { nodes, tetrahedra, sources = [], coverageMargin: overhang = 0 } = background;
    const parts = [
      ...[points, lines, patches, sources].map((part) => keyOf(part, hashJson)),
      keyOf(nodes, hashNodes),
      keyOf(tetrahedra, hashTetrahedra),
    ];
    key = [JSON.stringify(head), overhang, ...parts].join(" ");
    keys.set(project, key);
  }
  return key;
}
