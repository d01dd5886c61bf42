/** A worker that optimizes tiles of a mesh, one after the other; the worker of the run ends it. */
import { compile } from "#compile";
import { tilePort } from "#tile-port";
import { textOf } from "./lazy-module.js";
import { loadEngine } from "./loader.js";
import { failureOf } from "./slices.js";
import type { TileArrays, TileOptimizer, TileRequest } from "./tile-protocol.js";
import { buffersOf } from "./transfer.js";

/** Work per call: many short ones, because V8 never replaces the code of a running function. */
const BUDGET = 1000;

let optimizer: Promise<TileOptimizer> | undefined;

// Listens at once, because a browser drops messages sent before a worker listens.
tilePort.onRequest((request) => {
  serve(request).catch((failure: unknown) => tilePort.post({ kind: "failed", message: textOf(failure) }, []));
});

async function serve(request: TileRequest): Promise<void> {
  switch (request.kind) {
    case "begin":
      optimizer = begun(request);
      await optimizer;
      return;
    case "tile": {
      if (optimizer === undefined) throw new Error("a tile came before the engine");
      const mesh = optimized(await optimizer, request.mesh);
      tilePort.post({ kind: "done", id: request.id, mesh }, buffersOf(mesh));
    }
  }
}

async function begun({ module, steps }: Extract<TileRequest, { kind: "begin" }>): Promise<TileOptimizer> {
  const { instance } = await loadEngine(module, compile);
  const made = instance.tileOptimizer(steps);
  if (made === null) throw new Error("out of memory");
  return assertHealthy(made);
}

function optimized(optimizer: TileOptimizer, mesh: TileArrays): TileArrays {
  optimizer.begin(mesh);
  while (!optimizer.advance(BUDGET));
  const result = optimizer.result();
  assertHealthy(optimizer);
  return result;
}

/** After a failure the engine returns empty values, which must not pass for a result. */
function assertHealthy(optimizer: TileOptimizer): TileOptimizer {
  const failure = failureOf(optimizer);
  if (failure !== "none") throw new Error(`${failure} ${optimizer.failureMessage()}`.trim());
  return optimizer;
}
