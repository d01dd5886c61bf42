/** The creator of the worker as the worker sees it, the same in browsers and Node. */
import type { CadKernel } from "./kernel-classes.js";
import type { CreateOpenCascade } from "./opencascade.js";
import type { CadLibrary, CadProgress, CadReply, CadRequest } from "./protocol.js";

export interface CadPort {
  onRequest(handle: (request: CadRequest) => void): void;
  post(reply: CadReply | CadProgress, transfer: readonly ArrayBuffer[]): void;
  /** Loads the library: its function that makes an instance, and the options that this function needs. */
  readonly library: (
    addresses: CadLibrary,
  ) => Promise<{ readonly create: CreateOpenCascade; readonly options: object }>;
  /** Loads the kernel that reads true faces; undefined if it has no address. Rejects if it cannot be loaded. */
  readonly kernel: (addresses: CadLibrary) => Promise<CadKernel | undefined>;
}
