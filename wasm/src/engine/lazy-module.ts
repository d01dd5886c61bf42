/** A module of the engine in this worker: one instance, loaded on first use. */
import type { CompiledModule } from "./instantiated.js";
import type { LoadedModule } from "./loader.js";

/** What loading needs from the worker. */
export interface LazyModuleEvents<Instance> {
  /** Asks the worker's creator for the code: `receive` gets it. */
  readonly askForCode: () => void;
  /** Makes an instance from the code, or without it from the module's file. */
  readonly load: (given: CompiledModule | undefined) => Promise<LoadedModule<Instance>>;
  readonly onReady: (module: CompiledModule) => void;
  readonly onUnusable: (message: string) => void;
}

export class LazyModule<Instance> {
  readonly #events: LazyModuleEvents<Instance>;
  #loading: Promise<Instance> | undefined;
  #receive: ((given: CompiledModule | undefined) => void) | undefined;

  constructor(events: LazyModuleEvents<Instance>) {
    this.#events = events;
  }

  /** Resolves with the one instance. Rejects if it cannot be loaded; the next call tries again. */
  instance(): Promise<Instance> {
    this.#loading ??= this.#load();
    return this.#loading;
  }

  /** Takes the code that was asked for; undefined if this worker is to compile it. */
  receive(given: CompiledModule | undefined): void {
    this.#receive?.(given);
  }

  async #load(): Promise<Instance> {
    try {
      const given = await new Promise<CompiledModule | undefined>((resolve) => {
        this.#receive = resolve;
        this.#events.askForCode();
      });
      const { instance, module } = await this.#events.load(given);
      this.#events.onReady(module);
      return instance;
    } catch (failure) {
      this.#loading = undefined;
      this.#events.onUnusable(textOf(failure));
      throw failure;
    }
  }
}

/** Returns the message of an error, or the text of anything else that was thrown. */
export function textOf(failure: unknown): string {
  return failure instanceof Error ? failure.message : String(failure);
}
