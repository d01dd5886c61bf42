/** The arrays of VTK's XML files: text, base64 or raw bytes, whole or in blocks compressed with zlib. */
import { unzlibSync } from "fflate";

export interface ArrayCoding {
  readonly isLittleEndian: boolean;
  /** Bytes of the numbers that tell lengths: 4 or 8. */
  readonly headerBytes: number;
  readonly isCompressed: boolean;
  /** Text in base64, or raw bytes. */
  readonly appended: string | Uint8Array | undefined;
  /** Where the next array begins, by where one does; the last one has none. */
  readonly nextOffsets: ReadonlyMap<number, number>;
  /** What may still be unpacked, in bytes. */
  readonly budget: UnpackingBudget;
  /** `within`: so many characters or bytes from the array's begin. */
  readonly fail: ArrayFail;
}

export type ArrayFail = (message: string, within?: number) => never;

/**
 * Arrays may share their bytes, and zlib packs a thousandfold: without a bound a small file could fill any
 * memory. Files that hold meshes stay far below it.
 */
export class UnpackingBudget {
  #left: number;

  constructor(fileBytes: number) {
    this.#left = MOST_UNPACKED_ANYWAY + MOST_UNPACKED_PER_BYTE * fileBytes;
  }

  spend(bytes: number, fail: ArrayFail): void {
    this.#left -= bytes;
    if (this.#left < 0) fail("the arrays unpack to far more than such a file can hold");
  }
}

/** Characters are slow to decode, and every file has room for them once. */
const COST_OF_BASE64 = 64;
const MOST_UNPACKED_ANYWAY = 1 << 20;
const MOST_UNPACKED_PER_BYTE = 256;

export interface CodedArray {
  /** VTK's name of the type of its numbers. */
  readonly type: string;
  readonly format: string;
  /** In the appended data. */
  readonly offset: number;
  readonly content: string;
}

type Get = (view: DataView, at: number, isLittleEndian: boolean) => number;

const NUMBERS: Readonly<Record<string, { readonly bytes: number; readonly get: Get }>> = {
  Int8: { bytes: 1, get: (view, at) => view.getInt8(at) },
  UInt8: { bytes: 1, get: (view, at) => view.getUint8(at) },
  Int16: { bytes: 2, get: (view, at, little) => view.getInt16(at, little) },
  UInt16: { bytes: 2, get: (view, at, little) => view.getUint16(at, little) },
  Int32: { bytes: 4, get: (view, at, little) => view.getInt32(at, little) },
  UInt32: { bytes: 4, get: (view, at, little) => view.getUint32(at, little) },
  Int64: { bytes: 8, get: (view, at, little) => Number(view.getBigInt64(at, little)) },
  UInt64: { bytes: 8, get: (view, at, little) => Number(view.getBigUint64(at, little)) },
  Float32: { bytes: 4, get: (view, at, little) => view.getFloat32(at, little) },
  Float64: { bytes: 8, get: (view, at, little) => view.getFloat64(at, little) },
};

/** zlib does not compress by more than about this factor: larger claims are not believed. */
const MAX_RATIO = 1100;

/** The numbers of an array. Calls `coding.fail` where they cannot be read. */
export function decodeArray(coding: ArrayCoding, array: CodedArray): Float64Array {
  if (array.format === "ascii") return textNumbers(coding, array.content);
  const number = Object.hasOwn(NUMBERS, array.type) ? NUMBERS[array.type] : undefined;
  if (number === undefined) return coding.fail(`numbers of type "${array.type}" cannot be read`);
  const encoded = encodedBytes(coding, array);
  const bytes = contentOf(coding, encoded);
  coding.budget.spend((8 * bytes.length) / number.bytes, coding.fail);
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const values = new Float64Array(Math.floor(bytes.length / number.bytes));
  for (let i = 0; i < values.length; i++)
    values[i] = number.get(view, number.bytes * i, coding.isLittleEndian);
  return values;
}

function textNumbers({ fail }: ArrayCoding, content: string): Float64Array {
  const words = content.match(/\S+/g) ?? [];
  return Float64Array.from(words, (word, i) => {
    const value = Number(word);
    return Number.isFinite(value)
      ? value
      : fail(`"${word.slice(0, 24)}" is not a finite number`, placeOfWord(content, i));
  });
}

/** Where word number `index` of a text begins. */
function placeOfWord(content: string, index: number): number {
  const words = content.matchAll(/\S+/g);
  for (let i = 0; i < index; i++) words.next();
  return words.next().value?.index ?? 0;
}

/** The bytes from the array's length on; what follows the array may be among them. */
function encodedBytes(coding: ArrayCoding, { format, offset, content }: CodedArray): Uint8Array {
  const { appended, nextOffsets, budget, fail } = coding;
  if (format === "binary") return fromBase64(content, fail);
  if (format !== "appended" || appended === undefined) {
    return fail(`the format "${format}" of an array cannot be read`);
  }
  if (Number.isNaN(offset)) return fail("an array does not say where in the appended data it begins");
  if (!(Number.isInteger(offset) && offset >= 0 && offset < appended.length)) {
    return fail(`an array begins ${offset} bytes into ${appended.length} bytes of appended data`);
  }
  if (typeof appended !== "string") return appended.subarray(offset);
  const text = appended.slice(offset, nextOffsets.get(offset));
  budget.spend(COST_OF_BASE64 * text.length, fail);
  return fromBase64(text, fail);
}

/** Base64 in one or more padded pieces, up to the first character that is none of it. */
function fromBase64(text: string, fail: ArrayFail): Uint8Array {
  const coded = /^[A-Za-z0-9+/=\s]*/.exec(text)?.[0].replace(/\s+/g, "") ?? "";
  const pieces = (coded.match(/[A-Za-z0-9+/]+={0,2}/g) ?? []).map((piece) => {
    try {
      return atob(piece);
    } catch {
      return fail("an array is not in base64");
    }
  });
  const decoded = pieces.join("");
  const bytes = new Uint8Array(decoded.length);
  for (let i = 0; i < bytes.length; i++) bytes[i] = decoded.charCodeAt(i);
  return bytes;
}

function contentOf(coding: ArrayCoding, bytes: Uint8Array): Uint8Array {
  const { headerBytes, isCompressed, isLittleEndian, fail } = coding;
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const header = (index: number): number => {
    const at = headerBytes * index;
    if (at + headerBytes > bytes.length) return fail("an array ends before its length");
    return headerBytes === 8
      ? Number(view.getBigUint64(at, isLittleEndian))
      : view.getUint32(at, isLittleEndian);
  };
  const piece = (begin: number, length: number): Uint8Array =>
    begin + length <= bytes.length
      ? bytes.subarray(begin, begin + length)
      : fail(`an array of ${length} bytes has only ${bytes.length - begin}`);
  if (!isCompressed) return piece(headerBytes, header(0));
  const blocks = header(0);
  if (blocks === 0) return new Uint8Array();
  if (blocks * headerBytes > bytes.length)
    return fail(`an array of ${blocks} blocks has ${bytes.length} bytes`);
  const lastLength = header(2);
  const contents: Uint8Array[] = [];
  let begin = headerBytes * (3 + blocks);
  for (let b = 0; b < blocks; b++) {
    const packed = piece(begin, header(3 + b));
    const isShort = b === blocks - 1 && lastLength !== 0;
    const length = isShort ? lastLength : header(1);
    contents.push(inflated(packed, length, coding));
    begin += packed.length;
  }
  return joined(contents);
}

/** Undoes zlib. The length is known beforehand; a block of any other length is damaged. */
function inflated(packed: Uint8Array, length: number, { budget, fail }: ArrayCoding): Uint8Array {
  if (length > MAX_RATIO * packed.length) {
    return fail(`a block of ${packed.length} bytes claims to hold ${length}`);
  }
  budget.spend(length, fail);
  try {
    // One byte more, by which a longer block betrays itself.
    const block = unzlibSync(packed, { out: new Uint8Array(length + 1) });
    if (block.length === length) return block;
  } catch {
    return fail("a compressed block is damaged");
  }
  return fail(`a block holds other than the ${length} bytes it announces`);
}

function joined(pieces: readonly Uint8Array[]): Uint8Array {
  const bytes = new Uint8Array(pieces.reduce((sum, piece) => sum + piece.length, 0));
  let at = 0;
  for (const piece of pieces) {
    bytes.set(piece, at);
    at += piece.length;
  }
  return bytes;
}
