/** The engine's code among workers: who compiles it, who waits for it, who is given it. */
import { beforeEach, expect, test, vi } from "vitest";

import type * as Shared from "../../../wasm/src/engine/shared-engine.js";

/** The smallest there is: a header. */
const CODE = new WebAssembly.Module(Uint8Array.of(0, 0x61, 0x73, 0x6d, 1, 0, 0, 0));

let shared: typeof Shared;
let told: string[];
beforeEach(async () => {
  vi.resetModules();
  shared = await import("../../../wasm/dist/engine/shared-engine.js");
  told = [];
});

function loaderCalled(name: string): Shared.EngineLoader {
  return { load: (module) => void told.push(module === CODE ? `${name} is given it` : `${name} compiles`) };
}

test("the first compiles, those beside it wait, later ones are given the code", () => {
  const [first, second, third] = ["first", "second", "third"].map(loaderCalled) as [
    Shared.EngineLoader,
    Shared.EngineLoader,
    Shared.EngineLoader,
  ];
  shared.requestEngine(first);
  shared.requestEngine(second);
  expect(told).toEqual(["first compiles"]);
  shared.settleEngine(first, CODE);
  shared.requestEngine(third);
  expect(told).toEqual(["first compiles", "second is given it", "third is given it"]);
});

test("where the first fails, or is ended, the next in line tries, and later ones too: no failure is kept", () => {
  const [first, gone, next, later] = ["first", "gone", "next", "later"].map(loaderCalled) as [
    Shared.EngineLoader,
    Shared.EngineLoader,
    Shared.EngineLoader,
    Shared.EngineLoader,
  ];
  for (const loader of [first, gone, next]) shared.requestEngine(loader);
  shared.settleEngine(gone, undefined);
  expect(told).toEqual(["first compiles"]);
  shared.settleEngine(first, undefined);
  expect(told).toEqual(["first compiles", "next compiles"]);
  // The end of a worker that was given up before is nothing to those in line.
  shared.settleEngine(first, undefined);
  shared.settleEngine(next, undefined);
  shared.requestEngine(later);
  expect(told.at(-1)).toBe("later compiles");
  shared.settleEngine(later, CODE);
  shared.requestEngine(next);
  expect(told.at(-1)).toBe("next is given it");
});
