/** The solids of the application without a worker: the kernel computes them in the thread of the test. */
import type { Mesher } from "tetrafront";
import { Solids } from "../../web/session/solids";
import { unpackedBody } from "../../web/workers/packed-bodies";
import { solidCalls } from "../../web/workers/solid-calls";
import type { FeatureKernel } from "../../wasm/dist/cad/features/session.js";

/** Returns the maker of solids of a page. */
export function kernelSolids(
  load: () => Promise<FeatureKernel>,
  mesher: Promise<Mesher> = Promise.reject(new Error("no mesher")),
): Solids {
  mesher.catch(() => undefined);
  const calls = solidCalls(load);
  const client = {
    evaluate: async (request: Parameters<typeof calls.evaluate>[0]) => {
      const { made, ...answer } = (await calls.evaluate(request)).answer;
      if (made === null) return { made, ...answer };
      return { made: { body: await unpackedBody(made.packed), loaded: made.loaded }, ...answer };
    },
    draw: async (features: Parameters<typeof calls.draw>[0]) => (await calls.draw(features)).answer,
    importPart: async (file: Parameters<typeof calls.import>[0]) => (await calls.import(file)).answer,
    dispose: () => undefined,
  };
  return new Solids({ keep: () => undefined }, mesher, client);
}
