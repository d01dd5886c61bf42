/** Reads a CAD file in a worker of its own, which is terminated when the file is read or the signal is aborted. */
import { cadHost } from "#cad-host";
import { untilCancelled } from "../calls/cancelling.js";
import { cadLibrary } from "./cad-library.js";
import type { CadWorker } from "./cad-host.js";
import { startFailure } from "./crash.js";
import type { CadReply, CadRequest } from "./protocol.js";

export const notLoadedRemedy = cadHost.remedy;

/**
 * Resolves with the reply of the worker; a crash of the worker is a reply, too. Rejects with a `MesherError` of
 * code `cancelled` if the signal is aborted.
 */
export async function askForCad(
  request: Omit<CadRequest, "library">,
  signal: AbortSignal | undefined,
): Promise<CadReply> {
  let worker: CadWorker | undefined;
  try {
    return await untilCancelled(
      () =>
        new Promise<CadReply>((resolve) => {
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
    worker?.terminate();
  }
}
