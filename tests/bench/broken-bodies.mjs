// Prints how many broken bodies end as a mesh: bodies of our own, cut, shifted, doubled and crossed by spheres, and soups of
// spheres, ten damages each (TETRAFRONT_DAMAGES), through repair, remeshing and filling with automatic options.
import { arch, cpus } from "node:os";
import { BODIES, DAMAGES, sphereSoup } from "./support/damages.mjs";
import { diagonalOf } from "./support/diagonal.mjs";
import { createMesher } from "../../wasm/dist/index.js";
import { hasWelded, remeshedBest, STEP_HEIGHT } from "../../wasm/dist/internal.js";

const COUNT = Number(process.env.TETRAFRONT_DAMAGES ?? 10);
const mesher = await createMesher();

/** Repairs, remeshes and fills as `tetrafront mesh --surface remesh` does. */
async function run(surface) {
  const began = performance.now();
  try {
    const repaired = async (weldIntersections) => {
      const {
        mesh: one,
        deviation,
        diagnostics,
      } = await mesher.repairSurface(surface, {
        weld: 0,
        weldIntersections,
      });
      return { surface: one, deviation, diagnostics };
    };
    const welded = await repaired(STEP_HEIGHT * diagonalOf(surface));
    const isWelded = hasWelded(surface, { repairDeviation: welded.deviation });
    const { made } = await remeshedBest(
      welded,
      isWelded ? () => repaired(0) : undefined,
      async ({ surface: one }) => ({ remesh: await mesher.remeshSurface(one) }),
    );
    const { report } = await mesher.fillSurface(made.remesh.mesh);
    const seconds = (performance.now() - began) / 1000;
    if (report.status !== "done") return { failure: report.diagnostics[0]?.code ?? report.status, seconds };
    return { angle: report.dihedral.min, ratio: report.radiusRatio.mean, seconds };
  } catch (error) {
    const found = error.data?.diagnostics?.[0]?.code ?? error.message;
    return { failure: found, seconds: (performance.now() - began) / 1000 };
  }
}

const cases = Object.entries(DAMAGES).map(([name, damage]) => [
  name,
  Object.values(BODIES).flatMap((make) =>
    Array.from({ length: COUNT }, (_, seed) => () => damage(make(), seed)),
  ),
]);
cases.push(["soup of 20 spheres", Array.from({ length: COUNT }, (_, seed) => () => sphereSoup(seed))]);

console.log(`${cpus()[0]?.model.trim() ?? arch()}, Node ${process.version}, WebAssembly\n`);
console.log("| damage | bodies | meshed | smallest dihedral angle at least 10° | mean radius ratio at least 0.80 | median time, s | longest, s |"); // prettier-ignore
console.log("| --- | ---: | ---: | ---: | ---: | ---: | ---: |");
const failures = new Map();
for (const [name, makers] of cases) {
  const runs = [];
  for (const make of makers) runs.push(await run(make()));
  const done = runs.filter(({ failure }) => failure === undefined);
  for (const { failure } of runs) if (failure) failures.set(`${name}: ${failure}`, (failures.get(`${name}: ${failure}`) ?? 0) + 1); // prettier-ignore
  const seconds = runs.map((one) => one.seconds).sort((a, b) => a - b);
  const cells = [
    name,
    runs.length,
    done.length,
    done.filter(({ angle }) => angle >= 10).length,
    done.filter(({ ratio }) => ratio >= 0.8).length,
    seconds[Math.floor(seconds.length / 2)].toFixed(1),
    seconds.at(-1).toFixed(1),
  ];
  console.log(`| ${cells.join(" | ")} |`);
}
for (const [failure, count] of failures) console.log(`${count} × ${failure}`);
mesher.dispose();
