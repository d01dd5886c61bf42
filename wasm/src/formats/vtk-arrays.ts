/** The arrays of VTK's XML files: text, base64 or raw bytes, whole or in blocks compressed with zlib. */
import { Unzlib } from "fflate";

import { decimalIn, otherNumber } from "./decimal.js";
import { inRanges, stepwise, type Steps } from "./steps.js";

export interface ArrayCoding {
  readonly isLittleEndian: boolean;
  /** Bytes of the numbers that tell lengths: 4 or 8. */
  readonly headerBytes: number;
  readonly isCompressed: boolean;
  readonly appended: Uint8Array | undefined;
  /** Whether the appended data are text in base64; else they are raw. */
  readonly isBase64: boolean;
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
  /** What stands between its tags. */
  readonly content: Uint8Array;
  /** Whether some of its numbers may be none, or without bounds. */
  readonly mayBeNone: boolean;
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

/** Whether arrays of this type can be read; those of text and of single bits cannot. */
export function isReadable(type: string): boolean {
  return Object.hasOwn(NUMBERS, type);
}

/** The numbers of an array. Calls `coding.fail` where they cannot be read. */
export function* decodeArray(coding: ArrayCoding, array: CodedArray): Steps<Float64Array> {
  if (array.format === "ascii") return yield* textNumbers(coding, array);
  const number = Object.hasOwn(NUMBERS, array.type) ? NUMBERS[array.type] : undefined;
  if (number === undefined) return coding.fail(`numbers of type "${array.type}" cannot be read`);
  const encoded = yield* encodedBytes(coding, array);
  const bytes = yield* contentOf(coding, encoded);
  coding.budget.spend((8 * bytes.length) / number.bytes, coding.fail);
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const values = new Float64Array(Math.floor(bytes.length / number.bytes));
  yield* stepwise(values.length, (i) => {
    values[i] = number.get(view, number.bytes * i, coding.isLittleEndian);
  });
  return values;
}

function* textNumbers({ fail }: ArrayCoding, { content, mayBeNone }: CodedArray): Steps<Float64Array> {
  const values = new Float64Array(yield* wordCount(content));
  let at = 0;
  yield* stepwise(values.length, (i) => {
    while (isBlank(content, at)) at++;
    const begin = at;
    while (at < content.length && !isBlank(content, at)) at++;
    const value = decimalIn(content, begin, at);
    const isNone = !Number.isFinite(value);
    const other = isNone && mayBeNone ? otherNumber(content, begin, at) : undefined;
    if (isNone && other === undefined) {
      const word = new TextDecoder().decode(content.subarray(begin, Math.min(at, begin + SHOWN)));
      fail(`"${word}" is not a finite number`, begin);
    }
    values[i] = other ?? value;
  });
  return values;
}

const SHOWN = 24;

function* wordCount(content: Uint8Array): Steps<number> {
  let count = 0;
  const countIn = (begin: number, end: number) => {
    for (let at = begin; at < end; at++) {
      if (!isBlank(content, at) && (at === 0 || isBlank(content, at - 1))) count++;
    }
  };
  yield* inRanges(content.length, countIn, STEP_BYTES);
  return count;
}

/** As many bytes are a step. */
const STEP_BYTES = 1 << 16;

function isBlank(content: Uint8Array, at: number): boolean {
  return (content[at] ?? SPACE + 1) <= SPACE;
}

const SPACE = 32;

/** The bytes from the array's length on; what follows the array may be among them. */
function* encodedBytes(coding: ArrayCoding, { format, offset, content }: CodedArray): Steps<Uint8Array> {
  const { appended, isBase64, nextOffsets, budget, fail } = coding;
  if (format === "binary") return yield* fromBase64(content, fail);
  if (format !== "appended" || appended === undefined) {
    return fail(`the format "${format}" of an array cannot be read`);
  }
  if (Number.isNaN(offset)) return fail("an array does not say where in the appended data it begins");
  if (!(Number.isInteger(offset) && offset >= 0 && offset < appended.length)) {
    return fail(`an array begins ${offset} bytes into ${appended.length} bytes of appended data`);
  }
  if (!isBase64) return appended.subarray(offset);
  const text = appended.subarray(offset, nextOffsets.get(offset));
  budget.spend(COST_OF_BASE64 * text.length, fail);
  return yield* fromBase64(text, fail);
}

/** Base64 in one or more padded pieces, up to the first character that is none of it. */
function* fromBase64(text: Uint8Array, fail: ArrayFail): Steps<Uint8Array> {
  const bytes = new Uint8Array(Math.ceil((3 * text.length) / 4));
  let length = 0;
  /** The last bits, and how many characters this piece has. */
  let bits = 0;
  let characters = 0;
  const endPiece = () => {
    if (characters % 4 === 1) fail("an array is not in base64");
    characters = 0;
  };
  let isOver = false;
  const decode = (begin: number, end: number) => {
    for (let at = begin; at < end && !isOver; at++) {
      const byte = text[at] ?? 0;
      const value = BASE64[byte] ?? NONE;
      if (value < NONE) {
        bits = (bits << 6) | value;
        // Three bytes of four characters; the first one gives none.
        if (characters++ % 4 > 0) bytes[length++] = bits >> (2 * (3 - ((characters - 1) % 4)));
      } else if (byte === EQUALS) endPiece();
      else isOver = !isBlank(text, at);
    }
  };
  yield* inRanges(text.length, decode, STEP_BYTES);
  endPiece();
  return bytes.subarray(0, length);
}

const NONE = 64;
const EQUALS = 61;
/** By character: its six bits. */
const BASE64 = new Uint8Array(256).fill(NONE);
[..."ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/"].forEach((character, value) => {
  BASE64[character.charCodeAt(0)] = value;
});

function* contentOf(coding: ArrayCoding, bytes: Uint8Array): Steps<Uint8Array> {
  const { headerBytes, isCompressed, isLittleEndian, budget, fail } = coding;
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
  const lengthOf = (block: number) => (block === blocks - 1 && lastLength !== 0 ? lastLength : header(1));
  let total = 0;
  for (let b = 0; b < blocks; b++) {
    const [packed, length] = [header(3 + b), lengthOf(b)];
    if (length > MAX_RATIO * packed) return fail(`a block of ${packed} bytes claims to hold ${length}`);
    total += length;
  }
  budget.spend(total, fail);
  const content = new Uint8Array(total);
  let begin = headerBytes * (3 + blocks);
  let end = 0;
  for (let b = 0; b < blocks; b++) {
    const packed = piece(begin, header(3 + b));
    const block = content.subarray(end, (end += lengthOf(b)));
    yield* inflate(packed, block, fail);
    begin += packed.length;
  }
  return content;
}

/** Undoes zlib. The length is known beforehand; a block of any other length or sum is damaged. */
function* inflate(packed: Uint8Array, block: Uint8Array, fail: ArrayFail): Steps<void> {
  if (packed.length < 4) return fail("a compressed block is damaged");
  let end = 0;
  const sum = new Adler32();
  const stream = new Unzlib((piece) => {
    if (end + piece.length <= block.length) block.set(piece, end);
    end += piece.length;
    sum.add(piece);
  });
  try {
    const push = (begin: number, behind: number) =>
      stream.push(packed.subarray(begin, behind), behind === packed.length);
    yield* inRanges(packed.length, push, PACKED_STEP);
  } catch {
    return fail("a compressed block is damaged");
  }
  if (end !== block.length) return fail(`a block holds other than the ${block.length} bytes it announces`);
  const view = new DataView(packed.buffer, packed.byteOffset + packed.length - 4);
  if (view.getUint32(0) !== sum.value) fail("a compressed block is damaged");
}

/** As many bytes are a step of inflating: at most a thousandfold comes out of them. */
const PACKED_STEP = 1 << 13;

/** zlib's sum of bytes (RFC 1950), which fflate does not compare. */
class Adler32 {
  #low = 1;
  #high = 0;

  add(bytes: Uint8Array): void {
    let [low, high] = [this.#low, this.#high];
    for (let i = 0; i < bytes.length; i++) {
      low += bytes[i] ?? 0;
      high += low;
      // So often that both stay whole numbers of 32 bits.
      if ((i & 2047) === 2047) [low, high] = [low % ADLER, high % ADLER];
    }
    [this.#low, this.#high] = [low % ADLER, high % ADLER];
  }

  get value(): number {
    return this.#high * 2 ** 16 + this.#low;
  }
}

const ADLER = 65521;
