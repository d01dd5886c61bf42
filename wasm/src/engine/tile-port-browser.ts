import { type LifeRequest, receiveWatched } from "../calls/worker-life.js";
import type { TilePort } from "./tile-port.js";
import type { TileRequest } from "./tile-protocol.js";

/** The part of a worker's global scope that is used here; the DOM types describe a window's. */
interface WorkerScope {
  postMessage(message: unknown, transfer: Transferable[]): void;
  onmessage: ((event: MessageEvent<TileRequest | LifeRequest>) => void) | null;
}

const scope = globalThis as unknown as WorkerScope;

export const tilePort: TilePort = {
  onRequest: (handle) => {
    const receive = receiveWatched(handle, (reply) => scope.postMessage(reply, []));
    scope.onmessage = ({ data }) => receive(data);
  },
  post: (reply, transfer) => scope.postMessage(reply, [...transfer]),
};
