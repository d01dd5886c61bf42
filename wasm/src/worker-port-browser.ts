import type { Request } from "./protocol.js";
import type { WorkerPort } from "./worker-port.js";

/** The part of a worker's global scope used here; the DOM types describe a window's. */
interface WorkerScope {
  postMessage(message: unknown, transfer: Transferable[]): void;
  onmessage: ((event: MessageEvent<Request>) => void) | null;
}

const scope = globalThis as unknown as WorkerScope;
const channel = new MessageChannel();
/** A run and an inspection may both wait. */
const waiting: (() => void)[] = [];
channel.port1.onmessage = () => waiting.shift()?.();

export const workerPort: WorkerPort = {
  post: (reply, transfer = []) => scope.postMessage(reply, [...transfer]),
  onRequest: (handle) => {
    scope.onmessage = (event) => handle(event.data);
  },
  letRequestsIn: () =>
    new Promise((resolve) => {
      waiting.push(resolve);
      channel.port2.postMessage(null);
    }),
};
