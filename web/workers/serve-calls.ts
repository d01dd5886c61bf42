import { receiveWatched } from "tetrafront/internal";
import type { Call, Message, Protocol, Reply } from "./worker-client";

/** An answer and the buffers in it that move to the page instead of being copied. */
export interface Answer<T> {
  readonly answer: T;
  readonly transfer?: readonly Transferable[];
}

/** Handlers of a worker, one for each call of its protocol. */
export type Handlers<P extends Protocol<P>> = {
  readonly [K in keyof P]: (
    argument: P[K]["argument"],
  ) => Answer<P[K]["answer"]> | Promise<Answer<P[K]["answer"]>>;
};

/** The part of a worker's global scope used here; the DOM types describe a window's. */
export interface WorkerScope {
  postMessage(reply: Reply, transfer: Transferable[]): void;
  onmessage: ((event: MessageEvent<Message>) => void) | null;
}

/** Answers the calls of a `WorkerClient`. An error thrown by a handler rejects its call. */
export function serveCalls<P extends Protocol<P>>(
  handlers: Handlers<P>,
  scope: WorkerScope = globalThis as unknown as WorkerScope,
): void {
  const reply = async ({ id, name, argument }: Call): Promise<void> => {
    try {
      // The client sends only calls of the protocol, each with its argument.
      const handler = handlers[name as keyof P];
      const { answer, transfer = [] } = await handler(argument);
      scope.postMessage({ kind: "answer", id, answer }, [...transfer]);
    } catch (error) {
      const message = error instanceof Error ? error.message : String(error);
      scope.postMessage({ kind: "failure", id, message }, []);
    }
  };
  const receive = receiveWatched<Call>(
    (call) => void reply(call),
    (lives) => scope.postMessage(lives, []),
  );
  scope.onmessage = ({ data }) => receive(data);
}
