/** The compiled engine shared by workers: which worker compiles it, which wait, and which receive it. */
import { beforeEach, expect, test, vi } from "vitest";

import type * as Shared from "../../../wasm/src/engine/shared-engine.js";

/** The smallest valid module: a header. */
const CODE = new WebAssembly.Module(Uint8Array.of(0, 0x61, 0x73, 0x6d, 1, 0, 0, 0));

let shared: typeof Shared;
let events: string[];
beforeEach(async () => {
  vi.resetModules();
  shared = await import("../../../wasm/dist/engine/shared-engine.js");
  events = [];
});

function loaderCalled(name: string): Shared.EngineLoader {
  return {
    load: (module) => void events.push(module === CODE ? `${name} gets the module` : `${name} compiles`),
  };
}

test("the first worker compiles the engine, concurrent workers wait, and later ones get the module", () => {
  const [first, second, third] = ["first", "second", "third"].map(loaderCalled) as [
    Shared.EngineLoader,
    Shared.EngineLoader,
    Shared.EngineLoader,
  ];
  shared.requestEngine(first);
  shared.requestEngine(second);
  expect(events).toEqual(["first compiles"]);
  shared.settleEngine(first, CODE);
  shared.requestEngine(third);
  expect(events).toEqual(["first compiles", "second gets the module", "third gets the module"]);
});

test("if compiling fails or its worker ends, the next worker in the queue compiles, and no failure is stored", () => {
  const [first, gone, next, later] = ["first", "gone", "next", "later"].map(loaderCalled) as [
    Shared.EngineLoader,
    Shared.EngineLoader,
    Shared.EngineLoader,
    Shared.EngineLoader,
  ];
  for (const loader of [first, gone, next]) shared.requestEngine(loader);
  shared.settleEngine(gone, undefined);
  expect(events).toEqual(["first compiles"]);
  shared.settleEngine(first, undefined);
  expect(events).toEqual(["first compiles", "next compiles"]);
  // A worker that already failed does not affect the queue when it ends.
  shared.settleEngine(first, undefined);
  shared.settleEngine(next, undefined);
  shared.requestEngine(later);
  expect(events.at(-1)).toBe("later compiles");
  shared.settleEngine(later, CODE);
  shared.requestEngine(next);
  expect(events.at(-1)).toBe("next gets the module");
});
