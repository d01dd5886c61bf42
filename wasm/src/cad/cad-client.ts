/** Reads a CAD file in a worker of its own, which is terminated when the file is read or the signal is aborted. */
import { cadHost } from "#cad-host";
import { untilCancelled } from "../calls/cancelling.js";
import { cadLibrary } from "./cad-library.js";
import type { CadWorker } from "./cad-host.js";
import { startFailure } from "./crash.js";
import type { CadReply, CadRequest } from "./protocol.js";

export const notLoadedRemedy = cadHost.remedy;

/**
 * Seconds after which the worker is terminated: OpenCascade cannot be interrupted or asked how far it is, and some damaged
 * files keep it busy forever. On a very busy machine, real parts took at most 25 s, and 220 s per megabyte.
 */
const LIMIT = { base: 30, perMegabyte: 500 } as const;
const MEGABYTE = 1e6;

/** Returns the longest time that the worker gets for a file, in seconds. */
export function secondsFor(bytes: number): number {
  return LIMIT.base + Math.ceil((LIMIT.perMegabyte * bytes) / MEGABYTE);
}

/**
 * Resolves with the reply of the worker; a crash of the worker and the end of its time are replies, too. Rejects with a
 * `MesherError` of code `cancelled` if the signal is aborted.
 */
export async function askForCad(
  request: Omit<CadRequest, "library">,
  signal: AbortSignal | undefined,
  seconds = secondsFor(request.bytes.length),
): Promise<CadReply> {
  let timer: ReturnType<typeof setTimeout> | undefined;
  let worker: CadWorker | undefined;
  try {
    return await untilCancelled(
      () =>
        new Promise<CadReply>((resolve) => {
          timer = setTimeout(() => resolve({ kind: "timed-out", seconds }), seconds * 1000);
          try {
            worker = cadHost.start({ onReply: resolve, onCrash: resolve });
            worker.post({ ...request, library: cadLibrary() });
          } catch (failure) {
            resolve(startFailure(failure));
          }
        }),
      signal,
    );
  } finally {
    clearTimeout(timer);
    worker?.terminate();
  }
}
