import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { keepEverything } from "../../../web/session/offline";
import { offlineStrings } from "../../../web/strings/passing";

/** A service worker whose state a test sets. `answers`: whether it replies when it is asked to keep all files. */
class TestWorker extends EventTarget {
  state: ServiceWorkerState = "installing";
  readonly #answers: boolean;

  constructor(answers: boolean) {
    super();
    this.#answers = answers;
  }

  become(state: ServiceWorkerState): void {
    this.state = state;
    this.dispatchEvent(new Event("statechange"));
  }

  postMessage(_message: unknown, [port]: readonly MessagePort[]): void {
    if (this.#answers) port?.postMessage({ kind: "kept", bytes: 12 });
  }
}

/** A browser that registers workers like this. `ready` stays pending, as it does without an active worker. */
function browser(register: () => Promise<unknown>): void {
  const serviceWorker = { register, ready: new Promise(() => undefined) };
  vi.stubGlobal("navigator", { serviceWorker });
}

describe("keeping the site", () => {
  beforeEach(() => {
    vi.stubGlobal("document", { baseURI: "http://localhost/" });
  });
  afterEach(() => {
    vi.unstubAllGlobals();
    vi.useRealTimers();
  });

  it("registers the service worker, and waits until it is active", async () => {
    const worker = new TestWorker(true);
    browser(() => Promise.resolve({ installing: worker, waiting: null, active: null }));
    setTimeout(() => worker.become("installed"));
    setTimeout(() => worker.become("activated"), 5);
    expect(await keepEverything()).toEqual({ kind: "kept", bytes: 12 });
  });

  it("says why there is no service worker", async () => {
    browser(() => Promise.reject(new Error("Storage is not allowed")));
    expect(await keepEverything()).toEqual({ kind: "failed", reason: "Storage is not allowed" });
  });

  it("says that a file could not be fetched", async () => {
    const worker = new TestWorker(true);
    browser(() => Promise.resolve({ installing: worker, waiting: null, active: null }));
    setTimeout(() => worker.become("redundant"));
    expect(await keepEverything()).toEqual({ kind: "failed", reason: offlineStrings.notInstalled });
  });

  it("ends though the worker never answers", async () => {
    vi.useFakeTimers();
    browser(() => Promise.resolve({ installing: null, waiting: null, active: new TestWorker(false) }));
    const kept = keepEverything();
    await vi.advanceTimersByTimeAsync(300_000);
    expect(await kept).toEqual({ kind: "failed", reason: offlineStrings.tooLong(5) });
  });
});
