/** Sources of the bytes of a file: all at once, or piece by piece while the file is read. */
import { isA, isArrayOf, isDetached } from "../base/values.js";
import { throwIfCancelled, untilCancelled } from "../calls/cancelling.js";
import { Yielder } from "../calls/yielder.js";
import { ReadFailure } from "./read-result.js";

/** A Node stream is an AsyncIterable, a browser's File is a Blob, and `fetch(…).body` is a ReadableStream. */
export type ByteSource =
  | Uint8Array
  | ArrayBuffer
  | Blob
  | ReadableStream<Uint8Array>
  | AsyncIterable<Uint8Array>
  | Iterable<Uint8Array>;

/** Bytes in memory are processed in pieces of this size; other work may run between two pieces. */
const PIECE_BYTES = 1 << 16;

/**
 * Yields the pieces in order. Timers and messages run between them, even if all bytes are in memory. Aborting the
 * signal cancels the iteration, also while a piece is awaited.
 */
export async function* piecesOf(source: ByteSource, signal?: AbortSignal): AsyncGenerator<Uint8Array, void> {
  const yielder = new Yielder(signal);
  const pieces = rawPiecesOf(source);
  for await (const piece of signal === undefined ? pieces : cancellable(pieces, signal)) {
    if (!isArrayOf(Uint8Array, piece)) throw unreadableSource("it yields a value that is not a Uint8Array");
    // Copy bytes of shared memory: text decoders reject buffers that another thread could change.
    yield isA("ArrayBuffer", piece.buffer) ? piece : piece.slice();
    if (yielder.isDue) await yielder.yield();
  }
}

type Pieces = AsyncIterable<Uint8Array> | Iterable<Uint8Array>;

async function* cancellable(pieces: Pieces, signal: AbortSignal): AsyncGenerator<Uint8Array, void> {
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
    // The pending piece may never arrive, and a generator does not return before it does.
    else if (!isOver) release(pieces, iterator);
  }
}

/**
 * Releases the source without waiting. A Node stream is destroyed, because its iterator returns only with its next
 * piece.
 */
function release(pieces: Pieces, iterator: AsyncIterator<unknown> | Iterator<unknown>): void {
  if ("destroy" in pieces && typeof pieces.destroy === "function") (pieces.destroy as () => void)();
  Promise.resolve(iterator.return?.()).catch(() => undefined);
}

function rawPiecesOf(source: ByteSource): Pieces {
  if (isArrayOf(Uint8Array, source)) return cut(source);
  if (isBuffer(source)) {
    if (isDetached(source)) throw unreadableSource("its buffer was transferred");
    return cut(new Uint8Array(source));
  }
  if (isBlob(source)) return fromStream(source.stream());
  return "getReader" in source ? fromStream(source) : source;
}

/** Throws a ReadFailure if `source` is not readable; callers without type checks may pass anything. */
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
  if (!isSource) throw unreadableSource(`it is ${isObject ? "an object without bytes" : typeof source}`);
}

function isBuffer(source: object): source is ArrayBuffer {
  return isA("ArrayBuffer", source);
}

/** Tests by method: a Blob of another realm, such as a frame or a test environment, has another constructor. */
function isBlob(source: object): source is Blob {
  return "stream" in source && typeof source.stream === "function";
}

function unreadableSource(why: string): ReadFailure {
  return new ReadFailure({
    code: "invalid-argument",
    message: `the source is not readable: ${why}`,
    remedy: "Pass a Uint8Array, an ArrayBuffer, a Blob, or a stream or iterable of Uint8Arrays.",
  });
}

function* cut(bytes: Uint8Array): Generator<Uint8Array, void> {
  for (let begin = 0; begin < bytes.length; begin += PIECE_BYTES) {
    yield bytes.subarray(begin, begin + PIECE_BYTES);
  }
}

/** Reads a stream by its reader, because not every browser can iterate streams. Stopping early cancels the stream. */
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

/** Collects all bytes, for formats whose parts refer to later offsets. */
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
  /** Called after each piece with the number of bytes so far. */
  readonly onProgress?: ((bytes: number) => void) | undefined;
  /** Aborting it cancels reading. */
  readonly signal?: AbortSignal | undefined;
}

/** Returns a function that wraps sources so that their bytes, of all files together, are reported to `onProgress`. */
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
