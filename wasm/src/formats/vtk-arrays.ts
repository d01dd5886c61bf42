/** Decodes the arrays of VTK's XML files: text, base64 or raw bytes, whole or in blocks compressed with zlib. */
import { Unzlib } from "fflate";
import { inRanges, type Steps, stepwise } from "../base/steps.js";
import { decimalIn, otherNumber } from "./decimal.js";

export interface ArrayCoding {
  readonly isLittleEndian: boolean;
  /** Bytes per length in array headers: 4 or 8. */
  readonly headerBytes: number;
  readonly isCompressed: boolean;
  readonly appended: Uint8Array | undefined;
  /** Whether the appended data are text in base64; otherwise they are raw. */
  readonly isBase64: boolean;
  /** Offset of the next array by the offset of an array; the last array has none. */
  readonly nextOffsets: ReadonlyMap<number, number>;
  /** Number of bytes that may still be unpacked. */
  readonly budget: UnpackingBudget;
  /** `within`: number of characters or bytes from the beginning of the array. */
  readonly fail: ArrayFail;
}

export type ArrayFail = (message: string, within?: number) => never;

/**
 * Arrays may share their bytes, and zlib compresses up to a thousandfold. Without a limit, a small file could fill
 * any memory. Real mesh files stay far below the limit.
 */
export class UnpackingBudget {
  #left: number;

  constructor(fileBytes: number) {
    this.#left = MIN_UNPACKED_LIMIT + MAX_UNPACKED_PER_BYTE * fileBytes;
  }

  spend(bytes: number, fail: ArrayFail): void {
    this.#left -= bytes;
    if (this.#left < 0) fail("the arrays unpack to far more data than a file of this size can hold");
  }
}

/** Bytes charged per character: base64 is slow to decode, and no real file decodes its bytes more than a few times. */
const COST_OF_BASE64 = 64;
const MIN_UNPACKED_LIMIT = 1 << 20;
const MAX_UNPACKED_PER_BYTE = 256;

export interface CodedArray {
  /** VTK's name of the number type. */
  readonly type: string;
  readonly format: string;
  /** Offset in the appended data. */
  readonly offset: number;
  /** Bytes between the tags. */
  readonly content: Uint8Array;
  /** Whether the values may be NaN or infinite. */
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

/** Approximate upper bound of zlib's compression ratio; larger claims are rejected. */
const MAX_RATIO = 1100;

/** Returns whether arrays of this type can be read; text and single bits cannot. */
export function isReadable(type: string): boolean {
  return Object.hasOwn(NUMBERS, type);
}

/** Returns the numbers of an array. Calls `coding.fail` if they cannot be read. */
export function* decodeArray(coding: ArrayCoding, array: CodedArray): Steps<Float64Array> {
  if (array.format === "ascii") return yield* textNumbers(coding, array);
  const number = Object.hasOwn(NUMBERS, array.type) ? NUMBERS[array.type] : undefined;
  if (number === undefined) return coding.fail(`unknown number type "${array.type}"`);
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
      fail(`expected a finite number, found "${word}"`, begin);
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

/** Number of bytes per slice. */
const STEP_BYTES = 1 << 16;

function isBlank(content: Uint8Array, at: number): boolean {
  return (content[at] ?? SPACE + 1) <= SPACE;
}

const SPACE = 32;

/** Returns the bytes from the array's length on; bytes after the array may follow. */
function* encodedBytes(coding: ArrayCoding, { format, offset, content }: CodedArray): Steps<Uint8Array> {
  const { appended, isBase64, nextOffsets, budget, fail } = coding;
  if (format === "binary") return yield* fromBase64(content, fail);
  if (format !== "appended" || appended === undefined) {
    return fail(`an array has the unknown format "${format}"`);
  }
  if (Number.isNaN(offset)) return fail("an array has no offset in the appended data");
  if (!(Number.isInteger(offset) && offset >= 0 && offset < appended.length)) {
    return fail(`an array begins at offset ${offset}, but the appended data has ${appended.length} bytes`);
  }
  if (!isBase64) return appended.subarray(offset);
  const text = appended.subarray(offset, nextOffsets.get(offset));
  budget.spend(COST_OF_BASE64 * text.length, fail);
  return yield* fromBase64(text, fail);
}

/** Decodes base64 in one or more padded pieces, up to the first other character. */
function* fromBase64(text: Uint8Array, fail: ArrayFail): Steps<Uint8Array> {
  const bytes = new Uint8Array(Math.ceil((3 * text.length) / 4));
  let length = 0;
  /** The latest bits, and the number of characters in this piece. */
  let bits = 0;
  let characters = 0;
  const endPiece = () => {
    if (characters % 4 === 1) fail("an array is not valid base64");
    characters = 0;
  };
  let isOver = false;
  const decode = (begin: number, end: number) => {
    for (let at = begin; at < end && !isOver; at++) {
      const byte = text[at] ?? 0;
      const value = BASE64[byte] ?? NONE;
      if (value < NONE) {
        bits = (bits << 6) | value;
        // Four characters give three bytes; the first character completes none.
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
    if (at + headerBytes > bytes.length) return fail("an array ends before its length is stated");
    return headerBytes === 8
      ? Number(view.getBigUint64(at, isLittleEndian))
      : view.getUint32(at, isLittleEndian);
  };
  const piece = (begin: number, length: number): Uint8Array =>
    begin + length <= bytes.length
      ? bytes.subarray(begin, begin + length)
      : fail(`an array announces ${length} bytes, but only ${bytes.length - begin} follow`);
  if (!isCompressed) return piece(headerBytes, header(0));
  const blocks = header(0);
  if (blocks === 0) return new Uint8Array();
  if (blocks * headerBytes > bytes.length)
    return fail(`an array announces ${blocks} blocks, but has only ${bytes.length} bytes`);
  const lastLength = header(2);
  const lengthOf = (block: number) => (block === blocks - 1 && lastLength !== 0 ? lastLength : header(1));
  let total = 0;
  for (let b = 0; b < blocks; b++) {
    const [packed, length] = [header(3 + b), lengthOf(b)];
    if (length > MAX_RATIO * packed)
      return fail(
        `a compressed block of ${packed} bytes announces ${length} bytes, more than zlib can compress`,
      );
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

/** Decompresses a zlib block. A block of another length or checksum than announced is damaged. */
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
  if (end !== block.length)
    return fail(`a compressed block does not contain the ${block.length} bytes it announces`);
  const view = new DataView(packed.buffer, packed.byteOffset + packed.length - 4);
  if (view.getUint32(0) !== sum.value) fail("a compressed block is damaged");
}

/** Number of compressed bytes per slice; they expand at most a thousandfold. */
const PACKED_STEP = 1 << 13;

/** zlib's checksum (RFC 1950), which fflate does not verify. */
class Adler32 {
  #low = 1;
  #high = 0;

  add(bytes: Uint8Array): void {
    let [low, high] = [this.#low, this.#high];
    for (let i = 0; i < bytes.length; i++) {
      low += bytes[i] ?? 0;
      high += low;
      // Often enough that both stay below 2^32.
      if ((i & 2047) === 2047) [low, high] = [low % ADLER, high % ADLER];
    }
    [this.#low, this.#high] = [low % ADLER, high % ADLER];
  }

  get value(): number {
    return this.#high * 2 ** 16 + this.#low;
  }
}

const ADLER = 65521;
