/**
 * Calls between the page and its workers. A protocol lists the calls that a worker answers; the client matches
 * each answer to its call by id. Workers answer in the order of the calls unless their handlers are asynchronous.
 */

import { workerStrings } from "../strings/passing";
import { type LifeReply, type LifeRequest, type LifeWatch, watchLife } from "tetrafront/internal";

/** The calls of a worker: argument and answer of each, by name. */
export type Protocol<P> = {
  readonly [K in keyof P]: { readonly argument: unknown; readonly answer: unknown };
};

/** Why calls reject when their worker has ended without a word. */
const killed = "A worker of the app has ended, for example because memory ran out";

/** Workers of a client that may end one after the other without ever answering: with each, the next one is less likely to. */
export const maxFailedStarts = 3;

/** `isReplaced`: the next call starts another worker; else too many have not started. */
type Listener = (reason: string, isReplaced: boolean) => void;
const listeners = new Set<Listener>();

/** Calls back when a worker of this page has ended by itself. */
export function onWorkerLost(listener: Listener): () => void {
  listeners.add(listener);
  return () => listeners.delete(listener);
}

type Name<P> = keyof P & string;

export interface Call {
  readonly id: number;
  readonly name: string;
  readonly argument: unknown;
}

export type Message = Call | LifeRequest;

export type Reply =
  | LifeReply
  | { readonly kind: "answer"; readonly id: number; readonly answer: unknown }
  | { readonly kind: "failure"; readonly id: number; readonly message: string };

interface PendingCall {
  readonly resolve: (answer: unknown) => void;
  readonly reject: (failure: Error) => void;
}

/** The part of `Worker` that the client uses. */
export type WorkerPort = Pick<Worker, "postMessage" | "terminate" | "onmessage" | "onerror">;

/**
 * Starts a worker when it is first needed and calls it. A call that fails in its handler rejects alone. If the
 * worker itself fails, for example out of memory, all pending calls reject, and the next call starts a new worker, unless several
 * have ended one after the other before they were running.
 */
export class WorkerClient<P extends Protocol<P>> {
  readonly #startWorker: () => WorkerPort;
  readonly #onLost: () => void;
  #worker: WorkerPort | null = null;
  #life: LifeWatch | undefined;
  /** Whether the worker has replied. */
  #isRunning = false;
  #lastId = 0;
  /** Workers that ended before they were running, since the last one that was. */
  #failedStarts = 0;
  /** Why the last of too many workers has ended. */
  #givenUp: string | null = null;
  readonly #pending = new Map<number, PendingCall>();

  /** `onLost` is called when a worker has ended: the next worker has no state of earlier calls. */
  constructor(startWorker: () => WorkerPort, onLost: () => void = () => undefined) {
    this.#startWorker = startWorker;
    this.#onLost = onLost;
  }

  /** Starts the worker unless it runs already. */
  start(): void {
    if (this.#givenUp === null) this.#running();
  }

  /** Calls the worker. The buffers in `transfer` move to it. */
  call<K extends Name<P>>(
    name: K,
    argument: P[K]["argument"],
    transfer: readonly Transferable[] = [],
  ): Promise<P[K]["answer"]> {
    return new Promise((resolve, reject) => {
      if (this.#givenUp !== null) throw new Error(workerStrings.notStarted(this.#givenUp, maxFailedStarts));
      const id = ++this.#lastId;
      const call: Call = { id, name, argument };
      this.#running().postMessage(call, [...transfer]);
      this.#pending.set(id, { resolve, reject });
    });
  }

  /** Ends the worker. Pending calls reject. */
  dispose(): void {
    this.#end("The worker was stopped");
  }

  #running(): WorkerPort {
    if (this.#worker) return this.#worker;
    const worker = this.#startWorker();
    worker.onmessage = ({ data }: MessageEvent<Reply>) => this.#receive(data);
    this.#isRunning = false;
    const lose = (reason: string): void => {
      if (!this.#isRunning) this.#failedStarts += 1;
      const isReplaced = this.#failedStarts < maxFailedStarts;
      if (!isReplaced) this.#givenUp = reason;
      this.#end(isReplaced ? reason : workerStrings.notStarted(reason, maxFailedStarts));
      for (const listener of listeners) listener(reason, isReplaced);
    };
    worker.onerror = (event) => {
      event.preventDefault();
      lose(failureOf(event));
    };
    this.#worker = worker;
    this.#life = watchLife(() => lose(killed));
    if (this.#life) worker.postMessage(this.#life.request);
    return worker;
  }

  #receive(reply: Reply): void {
    this.#isRunning = true;
    this.#failedStarts = 0;
    if (reply.kind === "lives") return this.#life?.begin();
    const call = this.#pending.get(reply.id);
    this.#pending.delete(reply.id);
    if (reply.kind === "answer") call?.resolve(reply.answer);
    else call?.reject(new Error(reply.message));
  }

  #end(reason: string): void {
    if (!this.#worker) return;
    this.#life?.stop();
    this.#life = undefined;
    this.#worker.terminate();
    this.#worker = null;
    const calls = [...this.#pending.values()];
    this.#pending.clear();
    this.#onLost();
    for (const { reject } of calls) reject(new Error(reason));
  }
}

/** Starts a worker, calls it once and ends it: its memory is freed with it. */
export async function callOnce<P extends Protocol<P>, K extends Name<P>>(
  startWorker: () => WorkerPort,
  name: K,
  argument: P[K]["argument"],
  transfer: readonly Transferable[] = [],
): Promise<P[K]["answer"]> {
  const client = new WorkerClient<P>(startWorker);
  try {
    return await client.call(name, argument, transfer);
  } finally {
    client.dispose();
  }
}

/** An error inside the worker has a message. If the worker could not be loaded, the event has none. */
function failureOf(event: Event): string {
  return "message" in event ? String(event.message) : "A part of the app could not be loaded";
}
