/** The worker of a CAD file as its creator sees it, the same in browsers and Node. */
import type { CadCrash, CadFormat, CadProgress, CadReply, CadRequest } from "./protocol.js";

/** The library that reads a format. For STEP and BREP, the first one that can be loaded. */
export const cadLibrariesFor = (format: CadFormat): string =>
  format === "iges" ? "occt-import-js" : "replicad-opencascadejs or occt-import-js";

export interface CadWorker {
  post(request: CadRequest): void;
  /** Returns the processor time that it has taken, in full seconds; missing or undefined if it cannot be measured. */
  readonly processorSeconds?: () => number | undefined;
  terminate(): void;
}

export interface CadWorkerEvents {
  onReply(reply: CadReply | CadProgress): void;
  /** The worker ended by itself; no reply will follow. */
  onCrash(crash: CadCrash): void;
}

export interface CadHost {
  readonly start: (events: CadWorkerEvents) => CadWorker;
  /** What to do if the worker or the library cannot be loaded. */
  readonly remedyFor: (format: CadFormat) => string;
}
