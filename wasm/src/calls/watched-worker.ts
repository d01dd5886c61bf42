/** A worker of a browser as its creator sees it: its replies, and its end however it comes. */
import { ENDED, type LifeReply, watchLife } from "./worker-life.js";

export interface WatchedWorker<Request> {
  post(request: Request, transfer: readonly ArrayBuffer[]): void;
  terminate(): void;
}

interface WatchedWorkerEvents<Reply> {
  onReply(reply: Reply): void;
  /** The worker ended by itself; no reply will follow. */
  onCrash(message: string): void;
}

/** Watches a worker that has just been created by the script at this address. */
export function watchedWorker<Request, Reply extends { readonly kind: string }>(
  worker: Worker,
  events: WatchedWorkerEvents<Reply>,
  creator: string,
): WatchedWorker<Request> {
  const life = watchLife(() => events.onCrash(ENDED));
  worker.onmessage = ({ data }: MessageEvent<Reply | LifeReply>) =>
    isOfLife(data) ? life?.begin() : events.onReply(data);
  if (life !== undefined) worker.postMessage(life.request);
  worker.onmessageerror = () => events.onCrash("a reply could not be received");
  worker.onerror = (event) => {
    event.preventDefault();
    // If the script could not be loaded, the event has no message. Only the bundler knows the script's address.
    const message = event instanceof ErrorEvent ? event.message : "";
    events.onCrash(
      message || `the browser could not load its script, or a script that it imports, for ${creator}`,
    );
  };
  return {
    post: (request, transfer) => worker.postMessage(request, [...transfer]),
    terminate: () => {
      life?.stop();
      worker.terminate();
    },
  };
}

const isOfLife = (reply: { readonly kind: string }): reply is LifeReply => reply.kind === "lives";
