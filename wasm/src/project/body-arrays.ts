/** The arrays of a body: closed triangles that the project file stores as base64. */
import { base64Of, bytesOfBase64 } from "../base/base64.js";
import { LIMITS } from "../base/limits.js";
import { plural } from "../base/plural.js";
import type { TrueFaces } from "../mesh/mesh.js";
import { trueFacesOfText } from "./true-faces-text.js";

/** Texts of the arrays of a body. */
export interface BodyTexts {
  readonly points: string;
  readonly triangles: string;
  readonly trianglePatch?: string | undefined;
  readonly trueFaces?: string | undefined;
  readonly patches: readonly unknown[];
}

/** Arrays of a body before its placement. They are shared: never change or transfer them. */
export interface BodyArrays {
  /** x y z per node. */
  readonly points: Float64Array;
  /** Three node indices per triangle. */
  readonly triangles: Uint32Array;
  /** Per triangle: index of its patch in the body. */
  readonly trianglePatch: Uint32Array;
}

type Numbers = Float64Array | Uint32Array;
/** Array of a text with what its checks need; undefined if the text is not base64 of whole numbers. */
interface Decoded<T extends Numbers> {
  readonly array: T;
  /** Index of the first entry that is not finite or too large; -1 if there is none. */
  readonly invalid: number;
  /** Largest entry. */
  readonly largest: number;
}

/** Keeps the decoded arrays of the texts that were used last, because each edit of a project checks all of it. */
class DecodedTexts<Content> {
  readonly #decoded = new Map<string, Content | undefined>();
  readonly #decode: (text: string) => Content | undefined;
  #characters = 0;

  constructor(decode: (text: string) => Content | undefined) {
    this.#decode = decode;
  }

  get(text: string): Content | undefined {
    const isKnown = this.#decoded.has(text);
    const decoded = isKnown ? this.#decoded.get(text) : this.#decode(text);
    if (isKnown) this.#decoded.delete(text);
    else this.#characters += text.length;
    // The last entry of a Map is the newest.
    this.#decoded.set(text, decoded);
    for (const oldest of this.#decoded.keys()) {
      if (this.#characters <= MAX_CHARACTERS || oldest === text) break;
      this.#decoded.delete(oldest);
      this.#characters -= oldest.length;
    }
    return decoded;
  }
}

/** Of the texts whose arrays are kept: about ten million triangles. */
const MAX_CHARACTERS = 2 ** 28;

const doubleTexts = new DecodedTexts((text) => decode(Float64Array, text));
const integerTexts = new DecodedTexts((text) => decode(Uint32Array, text));
const faceTexts = new DecodedTexts(trueFacesOfText);

/** Texts in the file are little-endian, as are all machines that run WebAssembly. */
function decode<T extends Numbers>(
  type: new (buffer: ArrayBuffer) => T,
  text: string,
): Decoded<T> | undefined {
  const bytes = bytesOfBase64(text);
  const width = type === (Float64Array as unknown) ? 8 : 4;
  if (bytes === undefined || bytes.length % width !== 0) return undefined;
  const array = new type(bytes.buffer);
  let invalid = -1;
  let largest = 0;
  for (let i = 0; i < array.length; i++) {
    const value = array[i] ?? 0;
    if (value > largest) largest = value;
    if (invalid < 0 && width === 8 && !(Math.abs(value) <= LIMITS.length)) invalid = i;
  }
  return { array, invalid, largest };
}

/** Returns the text of an array in a project file. O(n). */
export function textOfArray(array: Numbers): string {
  return base64Of(new Uint8Array(array.buffer, array.byteOffset, array.byteLength));
}

/** Returns the arrays of a body that was checked; empty arrays for texts that are invalid. O(n) the first time. */
export function bodyArrays({ points, triangles, trianglePatch }: BodyTexts): BodyArrays {
  const corners = integerTexts.get(triangles)?.array ?? new Uint32Array();
  const patches = trianglePatch === undefined ? undefined : integerTexts.get(trianglePatch)?.array;
  return {
    points: doubleTexts.get(points)?.array ?? new Float64Array(),
    triangles: corners,
    trianglePatch: patches ?? new Uint32Array(corners.length / 3),
  };
}

/** Returns the true faces of a body that was checked; undefined if it has none. They are shared, as above. O(n) the first time. */
export function bodyTrueFaces({ trueFaces }: BodyTexts): readonly TrueFaces[] | undefined {
  return trueFaces === undefined ? undefined : faceTexts.get(trueFaces);
}

/** Checks the arrays of a body; reports each problem with the name of its field. O(n) the first time. */
export function checkBodyArrays(
  body: BodyTexts,
  report: (field: keyof BodyTexts, message: string) => void,
): void {
  const points = doubleTexts.get(body.points);
  if (points === undefined || points.array.length % 3 !== 0) {
    report("points", "expected base64 of x y z per node, three doubles (24 bytes) each");
  } else if (points.invalid >= 0) {
    const { array, invalid } = points;
    const node = `node ${Math.floor(invalid / 3)} (counted from 0)`;
    report("points", `${node} has the coordinate ${array[invalid]}, which is not finite or too large`);
  }
  const triangles = integerTexts.get(body.triangles);
  if (triangles === undefined || triangles.array.length % 3 !== 0 || triangles.array.length === 0) {
    report("triangles", "expected base64 of three node indices per triangle, four bytes each");
    return;
  }
  const nodes = (points?.array.length ?? Infinity) / 3;
  if (triangles.largest >= nodes) {
    const at = triangles.array.findIndex((node) => node >= nodes);
    const triangle = `triangle ${Math.floor(at / 3)} (counted from 0)`;
    report(
      "triangles",
      `${triangle} refers to node ${triangles.array[at]}, but there are ${plural(nodes, "node")}`,
    );
  }
  checkTrianglePatch(body, triangles.array.length / 3, (message) => report("trianglePatch", message));
  if (body.trueFaces !== undefined && bodyTrueFaces(body) === undefined)
    report("trueFaces", "expected what a reader of CAD files has written");
}

function checkTrianglePatch(
  { trianglePatch, patches }: BodyTexts,
  triangles: number,
  report: (message: string) => void,
): void {
  if (trianglePatch === undefined) {
    if (patches.length > 1) report(`it is missing, but there are ${patches.length} patches`);
    return;
  }
  const decoded = integerTexts.get(trianglePatch);
  if (decoded?.array.length !== triangles) {
    report(
      `expected base64 of one patch index for each of ${plural(triangles, "triangle")}, four bytes each`,
    );
  } else if (decoded.largest >= patches.length) {
    const triangle = decoded.array.findIndex((patch) => patch >= patches.length);
    report(
      `triangle ${triangle} (counted from 0) is in patch ${decoded.array[triangle]}, but there are ${plural(patches.length, "patch")}`,
    );
  }
}
