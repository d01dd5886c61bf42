// Measures picking: the time from a position of the pointer to the entity under it, for a model of 2000 entities in front of
// the boundary of a mesh of a million tetrahedra. The goal is 20 ms.
import { moduleServer } from "./support/modules.mjs";

const server = await moduleServer();
try {
  const { measurePicking } = await server.ssrLoadModule("/tests/bench/support/picking.ts");
  for (const { what, median, most } of await measurePicking()) {
    console.log(`${what.padEnd(52)} median ${median.toFixed(2)} ms, 95 % below ${most.toFixed(2)} ms`);
  }
} finally {
  await server.close();
}
