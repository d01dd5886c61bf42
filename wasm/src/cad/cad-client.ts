/** Reads a CAD file in a worker of its own, which is terminated when the file is read or the signal is aborted. */
import { cadHost } from "#cad-host";
import { untilCancelled } from "../calls/cancelling.js";
import { cadLibrary } from "./cad-library.js";
import type { CadWorker } from "./cad-host.js";
import type { CadReply, CadRequest } from "./protocol.js";

export const notLoadedRemedy = cadHost.remedy;

/**
 * Resolves with the reply of the worker; its crash counts as a failure of OpenCascade. Rejects with a `MesherError` of
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
          const onCrash = (message: string) => resolve({ kind: "failed", message });
          worker = cadHost.start({ onReply: resolve, onCrash });
          worker.post({ ...request, library: cadLibrary() });
        }),
      signal,
    );
  } finally {
    worker?.terminate();
  }
}
