/** The code of a module shared by workers: which worker compiles it, which wait, and which receive it. */
import { beforeEach, expect, test } from "vitest";

import { SharedCode } from "../../../wasm/dist/engine/shared-code.js";
import type { CodeLoader } from "../../../wasm/src/engine/shared-code.js";

/** The smallest valid module: a header. */
const CODE = new WebAssembly.Module(Uint8Array.of(0, 0x61, 0x73, 0x6d, 1, 0, 0, 0));

let shared: SharedCode;
let events: string[];
beforeEach(() => {
  shared = new SharedCode();
  events = [];
});

function loaderCalled(name: string): CodeLoader {
  return {
    load: (module) => void events.push(module === CODE ? `${name} gets the module` : `${name} compiles`),
  };
}

test("the first worker compiles the code, concurrent workers wait, and later ones get the module", () => {
  const [first, second, third] = ["first", "second", "third"].map(loaderCalled) as [
    CodeLoader,
    CodeLoader,
    CodeLoader,
  ];
  shared.request(first);
  shared.request(second);
  expect(events).toEqual(["first compiles"]);
  shared.settle(first, CODE);
  shared.request(third);
  expect(events).toEqual(["first compiles", "second gets the module", "third gets the module"]);
});

test("if compiling fails or its worker ends, the next worker in the queue compiles, and no failure is stored", () => {
  const [first, gone, next, later] = ["first", "gone", "next", "later"].map(loaderCalled) as [
    CodeLoader,
    CodeLoader,
    CodeLoader,
    CodeLoader,
  ];
  for (const loader of [first, gone, next]) shared.request(loader);
  shared.settle(gone, undefined);
  expect(events).toEqual(["first compiles"]);
  shared.settle(first, undefined);
  expect(events).toEqual(["first compiles", "next compiles"]);
  // A worker that already failed does not affect the queue when it ends.
  shared.settle(first, undefined);
  shared.settle(next, undefined);
  shared.request(later);
  expect(events.at(-1)).toBe("later compiles");
  shared.settle(later, CODE);
  shared.request(next);
  expect(events.at(-1)).toBe("next gets the module");
});
