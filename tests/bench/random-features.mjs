// Does random work with the features of solids by the kernel, undoes all of it and does it again, and prints what is wrong: documents
// that are not the same, exceptions, and files that cannot be read. Features are pieces, lofts, sweeps and changes with parameters.
//
//     node tests/bench/random-features.mjs [COUNT] [FIRST]
import { moduleServer } from "./support/modules.mjs";

const [COUNT = 500, FIRST = 1] = process.argv.slice(2).map(Number);
const STEPS = 8;

const server = await moduleServer();
const { findingsOf } = await server.ssrLoadModule("/tests/support/feature-work.ts");
const { kernelSolids } = await server.ssrLoadModule("/tests/support/kernel-solids.ts");
const { testKernel } = await server.ssrLoadModule("/tests/support/kernel-shapes.ts");

/** The kernel loses memory with each solid. */
const KERNEL_FOR = 25;
let solids = kernelSolids(testKernel);
let wrong = 0;
for (let seed = FIRST; seed < FIRST + COUNT; seed++) {
  if ((seed - FIRST) % KERNEL_FOR === 0) solids = kernelSolids(testKernel);
  try {
    const findings = await findingsOf(seed, STEPS, solids);
    if (findings.length === 0) continue;
    console.log(`${seed}: ${findings.join("; ")}`);
  } catch (failure) {
    console.log(`${seed}: ${failure instanceof Error ? failure.stack : failure}`);
  }
  wrong++;
}
await server.close();
console.log(`${COUNT} lists of features, ${wrong} with findings`);
process.exit(0);
