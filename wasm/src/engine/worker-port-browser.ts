import { compile } from "#compile";
import { receiveWatched, type LifeRequest } from "../calls/worker-life.js";
import type { Request } from "./protocol.js";
import type { WorkerPort } from "./worker-port.js";

/** The part of a worker's global scope that is used here; the DOM types describe a window's. */
interface WorkerScope {
  postMessage(message: unknown, transfer: Transferable[]): void;
  onmessage: ((event: MessageEvent<Request | LifeRequest>) => void) | null;
}

const scope = globalThis as unknown as WorkerScope;
const channel = new MessageChannel();
/** Several calls, for example a run and an inspection, may wait at the same time. */
const waiting: (() => void)[] = [];
channel.port1.onmessage = () => waiting.shift()?.();

export const workerPort: WorkerPort = {
  compile,
  post: (reply, transfer = []) => scope.postMessage(reply, [...transfer]),
  onRequest: (handle) => {
    const receive = receiveWatched(handle, (reply) => scope.postMessage(reply, []));
    scope.onmessage = ({ data }) => receive(data);
  },
  letRequestsIn: () =>
    new Promise((resolve) => {
      waiting.push(resolve);
      channel.port2.postMessage(null);
    }),
};
