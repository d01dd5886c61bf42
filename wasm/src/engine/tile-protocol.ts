/** Messages between the worker of a run and the workers that optimize tiles of its mesh. */
import type { CompiledModule } from "./instantiated.js";
import type { Engine } from "./loader.js";

/** Optimizes tiles in an instance of the engine. */
export type TileOptimizer = NonNullable<ReturnType<Engine["tileOptimizer"]>>;
/** A tile, or its result: its elements. */
export type TileArrays = ReturnType<TileOptimizer["result"]>;

export type TileRequest =
  /** The first message: the code of the engine, and what it does to all tiles of the run. */
  | { readonly kind: "begin"; readonly module: CompiledModule; readonly steps: Uint8Array }
  /** Answered by one reply. */
  | { readonly kind: "tile"; readonly id: number; readonly mesh: TileArrays };

export type TileReply =
  | { readonly kind: "done"; readonly id: number; readonly mesh: TileArrays }
  /** The worker can do no tile any more. */
  | { readonly kind: "failed"; readonly message: string };
