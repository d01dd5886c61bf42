/** The creator as the worker sees it, the same in browsers and Node. */
import type { CompileModule } from "./instantiated.js";
import type { Reply, Request } from "./protocol.js";

export interface WorkerPort {
  readonly compile: CompileModule;
  post(reply: Reply, transfer?: readonly ArrayBuffer[]): void;
  onRequest(handle: (request: Request) => void): void;
  /** Resolves after pending requests have been handled. A timer would take 4 ms or more. */
  readonly letRequestsIn: () => Promise<void>;
}
