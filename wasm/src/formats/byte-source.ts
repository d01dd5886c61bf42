/** Where the bytes of a file come from: all at once, or piece by piece while it is read. */
import { isDetached } from "../argument-checks.js";
import { ReadFailure } from "../read-result.js";

/** A Node stream is an AsyncIterable, a browser's File is a Blob, `fetch(…).body` is a ReadableStream. */
export type ByteSource =
  | Uint8Array
  | ArrayBuffer
  | Blob
  | ReadableStream<Uint8Array>
  | AsyncIterable<Uint8Array>
  | Iterable<Uint8Array>;

/** What is in memory already is handed on in pieces of this size, between which others may run. */
const PIECE_BYTES = 1 << 20;
/** Longest time without letting others run, in milliseconds. */
export const BREATH_MS = 12;

/** The pieces in order. Lets timers and messages in between them, also where all bytes are at hand. */
export async function* piecesOf(source: ByteSource): AsyncGenerator<Uint8Array, void> {
  let breathed = performance.now();
  for await (const piece of rawPiecesOf(source)) {
    if (!(ArrayBuffer.isView(piece) && isBytes(piece))) throw noBytes("what it gives is no Uint8Array");
    // Decoders of text take nothing that others may change meanwhile.
    yield piece.buffer instanceof ArrayBuffer ? piece : piece.slice();
    if (performance.now() - breathed > BREATH_MS) {
      await new Promise((resolve) => setTimeout(resolve));
      breathed = performance.now();
    }
  }
}

function rawPiecesOf(source: ByteSource): AsyncIterable<Uint8Array> | Iterable<Uint8Array> {
  if (source instanceof Uint8Array) return cut(source);
  if (source instanceof ArrayBuffer) {
    if (isDetached(source)) throw noBytes("it was transferred");
    return cut(new Uint8Array(source));
  }
  if (source instanceof Blob) return fromStream(source.stream());
  return "getReader" in source ? fromStream(source) : source;
}

/** Throws a ReadFailure where this cannot be read from, as callers without type checks may give anything. */
export function checkSource(source: unknown): asserts source is ByteSource {
  const isObject = typeof source === "object" && source !== null;
  const isSource =
    isObject &&
    !(ArrayBuffer.isView(source) && (!isBytes(source) || isDetached(source))) &&
    (source instanceof ArrayBuffer ||
      source instanceof Blob ||
      source instanceof Uint8Array ||
      "getReader" in source ||
      Symbol.asyncIterator in source ||
      Symbol.iterator in source);
  if (!isSource) throw noBytes(`it is ${isObject ? "an object without bytes" : typeof source}`);
}

/** Also of another realm, as tests have them. */
function isBytes(view: ArrayBufferView): view is Uint8Array {
  return Object.prototype.toString.call(view) === "[object Uint8Array]";
}

function noBytes(why: string): ReadFailure {
  return new ReadFailure({
    code: "invalid-argument",
    message: `the source cannot be read: ${why}`,
    remedy: "Give a Uint8Array, an ArrayBuffer, a Blob, or a stream or iterable of Uint8Arrays.",
  });
}

function* cut(bytes: Uint8Array): Generator<Uint8Array, void> {
  for (let begin = 0; begin < bytes.length; begin += PIECE_BYTES) {
    yield bytes.subarray(begin, begin + PIECE_BYTES);
  }
}

/** Streams are not iterable in every browser. Whoever stops early cancels the stream. */
async function* fromStream(stream: ReadableStream<Uint8Array>): AsyncGenerator<Uint8Array, void> {
  const reader = stream.getReader();
  try {
    for (let next = await reader.read(); !next.done; next = await reader.read()) yield next.value;
  } finally {
    await reader.cancel();
  }
}

/** All bytes together, for formats whose parts refer to places further on. */
export async function allBytes(source: ByteSource): Promise<Uint8Array> {
  if (source instanceof Uint8Array && source.buffer instanceof ArrayBuffer) return source;
  const pieces: Uint8Array[] = [];
  let length = 0;
  for await (const piece of piecesOf(source)) {
    pieces.push(piece);
    length += piece.length;
  }
  const bytes = new Uint8Array(length);
  let at = 0;
  for (const piece of pieces) {
    bytes.set(piece, at);
    at += piece.length;
  }
  return bytes;
}

export interface Watch {
  /** Called with the number of bytes so far, once per piece. */
  readonly onProgress?: ((bytes: number) => void) | undefined;
  /** Aborting ends the reading with the signal's reason. */
  readonly signal?: AbortSignal | undefined;
}

/** The same bytes, with someone who watches them go by. */
export function watched(source: ByteSource, { onProgress, signal }: Watch): ByteSource {
  if (onProgress === undefined && signal === undefined) return source;
  return (async function* () {
    let bytes = 0;
    for await (const piece of piecesOf(source)) {
      signal?.throwIfAborted();
      onProgress?.((bytes += piece.length));
      yield piece;
    }
  })();
}
