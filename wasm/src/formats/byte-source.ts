/** Where the bytes of a file come from: all at once, or piece by piece while it is read. */
import { isA, isArrayOf, isDetached } from "../base/argument-checks.js";
import { throwIfCancelled, untilCancelled } from "../base/cancelling.js";
import { ReadFailure } from "./read-result.js";
import { Breather } from "./steps.js";

/** A Node stream is an AsyncIterable, a browser's File is a Blob, `fetch(…).body` is a ReadableStream. */
export type ByteSource =
  | Uint8Array
  | ArrayBuffer
  | Blob
  | ReadableStream<Uint8Array>
  | AsyncIterable<Uint8Array>
  | Iterable<Uint8Array>;

/** What is in memory already is handed on in pieces of this size, between which others may run. */
const PIECE_BYTES = 1 << 16;

/**
 * The pieces in order. Lets timers and messages in between them, also where all bytes are at hand. The signal cancels
 * them, also while one is waited for.
 */
export async function* piecesOf(source: ByteSource, signal?: AbortSignal): AsyncGenerator<Uint8Array, void> {
  const breather = new Breather(signal);
  const pieces = rawPiecesOf(source);
  for await (const piece of signal === undefined ? pieces : heeding(pieces, signal)) {
    if (!isArrayOf(Uint8Array, piece)) throw noBytes("what it gives is no Uint8Array");
    // Decoders of text take nothing that others may change meanwhile.
    yield isA("ArrayBuffer", piece.buffer) ? piece : piece.slice();
    if (breather.isDue) await breather.breathe();
  }
}

type Pieces = AsyncIterable<Uint8Array> | Iterable<Uint8Array>;

async function* heeding(pieces: Pieces, signal: AbortSignal): AsyncGenerator<Uint8Array, void> {
  const iterator =
    Symbol.asyncIterator in pieces ? pieces[Symbol.asyncIterator]() : pieces[Symbol.iterator]();
  let isOver = false;
  try {
    for (;;) {
      const next = await untilCancelled(() => iterator.next(), signal);
      isOver = next.done === true;
      if (next.done === true) return;
      yield next.value;
    }
  } finally {
    if (!isOver && !signal.aborted) await iterator.return?.();
    // What was asked for may never come, and a generator ends no sooner.
    else if (!isOver) letGo(pieces, iterator);
  }
}

/** Without waiting for it. A stream of Node is destroyed: its iterator would end only with its next piece. */
function letGo(pieces: Pieces, iterator: AsyncIterator<unknown> | Iterator<unknown>): void {
  if ("destroy" in pieces && typeof pieces.destroy === "function") (pieces.destroy as () => void)();
  Promise.resolve(iterator.return?.()).catch(() => undefined);
}

function rawPiecesOf(source: ByteSource): Pieces {
  if (isArrayOf(Uint8Array, source)) return cut(source);
  if (isBuffer(source)) {
    if (isDetached(source)) throw noBytes("it was transferred");
    return cut(new Uint8Array(source));
  }
  if (isBlob(source)) return fromStream(source.stream());
  return "getReader" in source ? fromStream(source) : source;
}

/** Throws a ReadFailure where this cannot be read from, as callers without type checks may give anything. */
export function checkSource(source: unknown): asserts source is ByteSource {
  const isObject = typeof source === "object" && source !== null;
  const isSource =
    isObject &&
    !(ArrayBuffer.isView(source) && (!isArrayOf(Uint8Array, source) || isDetached(source))) &&
    (isBuffer(source) ||
      isBlob(source) ||
      ArrayBuffer.isView(source) ||
      "getReader" in source ||
      Symbol.asyncIterator in source ||
      Symbol.iterator in source);
  if (!isSource) throw noBytes(`it is ${isObject ? "an object without bytes" : typeof source}`);
}

function isBuffer(source: object): source is ArrayBuffer {
  return isA("ArrayBuffer", source);
}

/** By what it does: one of another realm, such as a frame's or a test environment's, has another constructor. */
function isBlob(source: object): source is Blob {
  return "stream" in source && typeof source.stream === "function";
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
function fromStream(stream: ReadableStream<Uint8Array>): AsyncIterable<Uint8Array> {
  return {
    [Symbol.asyncIterator]: () => {
      const reader = stream.getReader();
      return {
        next: () => reader.read() as Promise<IteratorResult<Uint8Array, undefined>>,
        return: async () => {
          await reader.cancel();
          return { done: true, value: undefined };
        },
      };
    },
  };
}

/** All bytes together, for formats whose parts refer to places further on. */
export async function allBytes(source: ByteSource): Promise<Uint8Array> {
  if (isArrayOf(Uint8Array, source) && isA("ArrayBuffer", source.buffer)) return source;
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
  /** Aborting cancels the reading. */
  readonly signal?: AbortSignal | undefined;
}

/** The same bytes of one file or several, with someone who watches them all go by. */
export function watcher({ onProgress, signal }: Watch): (source: ByteSource) => ByteSource {
  if (onProgress === undefined && signal === undefined) return (source) => source;
  let bytes = 0;
  return (source) =>
    (async function* () {
      for await (const piece of piecesOf(source, signal)) {
        throwIfCancelled(signal);
        onProgress?.((bytes += piece.length));
        yield piece;
      }
    })();
}
