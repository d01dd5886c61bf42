/** Reading of trace files (docs/TRACE.md). */
import * as v from "valibot";
import { PAUSE, type Steps, withoutPause } from "../base/steps.js";
import { isA } from "../base/values.js";
import { checkArgument } from "../calls/argument-checks.js";
import { throwIfCancelled } from "../calls/cancelling.js";
import { watch } from "../calls/schemas.js";
import { inSteps } from "../calls/yielder.js";
import type { ReadResult } from "../diagnostics/read-error.js";
import { asTooLarge, ReadFailure, readSafely } from "../formats/read-result.js";
import { parseHeader, type TraceHeader } from "./header.js";
import {
  FRONT_ONLY_VERSION,
  MAGIC,
  SHORT_SCORE_VERSION,
  TRACE_VERSION,
  VOLUME_ONLY_VERSION,
} from "./layout.js";
import { TracedOptimization } from "./optimization.js";
import { Replay } from "./replay.js";
import { readScore, readShortScore } from "./score.js";
import { SurfaceReplay } from "./surface-replay.js";
import { SurfaceTrace } from "./surface-trace.js";
import { readSweeps } from "./sweep-events.js";
import { Trace } from "./trace.js";
import { TraceCursor } from "./trace-cursor.js";

/** More bytes cannot be addressed by 32 bits. */
const MAX_BYTES = 0xffffffff;

const TOO_LARGE = {
  message: "the steps of the trace do not fit into memory",
  remedy: "Record a coarser mesh: a step takes about 100 bytes.",
};

/**
 * Reads a trace, checks every event and returns it with all its states. Of a damaged file, the error names the byte. The
 * trace keeps `bytes`; do not change them. O(bytes); about 100 bytes of memory per step.
 *
 *     const trace = readTrace(await readFile("cube.tft"));
 *     if (trace.success) console.log(trace.value.stepAt(1));
 */
export function readTrace(bytes: Uint8Array): ReadResult<Trace> {
  try {
    return { success: true, value: withoutPause(traceIn(cursorOf(bytes))) };
  } catch (failure) {
    return failed(failure);
  }
}

/** Options of `loadTrace`. */
export interface LoadTraceOptions {
  /** Called between slices with the fraction of the bytes read, and with 1 at the end. */
  readonly onProgress?: ((fraction: number) => void) | undefined;
  /** Aborting it rejects with a `MesherError` of code `cancelled` at the end of the slice. */
  readonly signal?: AbortSignal | undefined;
}

const loadOptions = v.object(watch);

/**
 * Reads a trace as `readTrace` does, in slices of about 12 milliseconds, so that a page responds meanwhile. The last
 * slices copy the arrays, and take longer for very long traces. Rejects with a `MesherError` if it is cancelled, or if an option
 * is invalid.
 */
export async function loadTrace(
  bytes: Uint8Array,
  options: LoadTraceOptions = {},
): Promise<ReadResult<Trace>> {
  checkArgument("options", options, loadOptions);
  const { onProgress, signal } = options;
  throwIfCancelled(signal);
  try {
    const cursor = cursorOf(bytes);
    const onPause = onProgress && (() => onProgress(cursor.at / bytes.length));
    const value = await inSteps(traceIn(cursor), signal, onPause);
    onProgress?.(1);
    return { success: true, value };
  } catch (failure) {
    return failed(failure);
  }
}

function failed(failure: unknown): ReadResult<Trace> {
  return readSafely(() => {
    throw asTooLarge(failure, TOO_LARGE);
  });
}

function cursorOf(bytes: Uint8Array): TraceCursor {
  if (!isA("Uint8Array", bytes)) {
    throw new ReadFailure({
      code: "invalid-argument",
      message: "the bytes of the trace are no Uint8Array",
      remedy: "Pass the content of a trace file.",
    });
  }
  if (bytes.length > MAX_BYTES) {
    throw new ReadFailure({
      code: "too-large-file",
      message: "the trace has more than 4 GB",
      remedy: "Record a coarser mesh.",
    });
  }
  return new TraceCursor(bytes);
}

function* traceIn(cursor: TraceCursor): Steps<Trace> {
  const { header, version } = readHeader(cursor);
  const readAnyScore = version === TRACE_VERSION ? readScore : readShortScore;
  const replay = new Replay(cursor, header.nodes, readAnyScore);
  yield* replay.readNodes();
  const surface = version === VOLUME_ONLY_VERSION ? undefined : yield* new SurfaceReplay(cursor).readEvents();
  yield* replay.readEvents();
  const sweeps = yield* readSweeps(cursor, header.nodes);
  if (replay.steps.count !== header.steps)
    cursor.fail(`the header has ${header.steps} steps, but the trace has ${replay.steps.count}`);
  const passes = replay.passes.map(({ nodeOf, elementOf }) => ({
    nodes: nodeOf.copy(header.nodes),
    elements: elementOf.copy(),
  }));
  yield PAUSE;
  const lists = { boundaryNodes: header.nodes, passes };
  const nodes = replay.nodes.taken();
  const faces = replay.faces.taken();
  yield PAUSE;
  const elements = replay.elements.taken();
  yield PAUSE;
  const steps = replay.steps.taken();
  yield PAUSE;
  const hasSurface = surface !== undefined && surface.divisions.length > 0;
  const traced = hasSurface ? new SurfaceTrace(cursor.file, surface, nodes.positions) : null;
  const boundary = nodes.positions.subarray(0, 3 * header.nodes);
  const optimization = sweeps && new TracedOptimization(cursor.file, sweeps, boundary);
  const columns = [nodes, faces, elements, steps] as const;
  return new Trace(cursor.file, header, ...columns, replay.fronts, traced, optimization, lists, readAnyScore);
}

function readHeader(cursor: TraceCursor): { readonly header: TraceHeader; readonly version: number } {
  if (cursor.ahead === 0) {
    const remedy = "Choose a trace file.";
    throw new ReadFailure({ code: "empty-file", message: "the file is empty", remedy, offset: 0 });
  }
  const isTrace = cursor.ahead > MAGIC.length && textOf(cursor.bytes(MAGIC.length)) === MAGIC;
  if (!isTrace) {
    const remedy = "Choose a file that was written by `tetrafront trace` or recorded in the app.";
    throw new ReadFailure({ message: "byte 0: this is no trace of a front", remedy, offset: 0 });
  }
  const version = cursor.byte();
  if (![VOLUME_ONLY_VERSION, FRONT_ONLY_VERSION, SHORT_SCORE_VERSION, TRACE_VERSION].includes(version)) {
    const remedy = "Use the version of Tetrafront that recorded the trace, or record it again.";
    const offset = MAGIC.length;
    const message = `byte ${offset}: version ${version} of the format is not known`;
    throw new ReadFailure({ code: "malformed-file", message, remedy, offset });
  }
  const length = cursor.count("bytes of the header", 1);
  const begin = cursor.at;
  const parsed = parseHeader(textOf(cursor.bytes(length)));
  return "header" in parsed ? { header: parsed.header, version } : cursor.fail(parsed.problem, begin);
}

const textOf = (bytes: Uint8Array): string => new TextDecoder().decode(bytes);
