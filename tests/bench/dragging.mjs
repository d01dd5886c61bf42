// Measures dragging one point of a large project, without drawing: the time of a move, the size of the step in memory and in
// the storage, and what autosave writes after the step. The goals are 1 ms and 1 kB, however many points there are.
import { moduleServer } from "./support/modules.mjs";

const server = await moduleServer();
try {
  const { measureDragging } = await server.ssrLoadModule("/tests/bench/support/dragging.ts");
  for (const points of [1000, 10_000, 50_000]) {
    const { move, release, step, written, blocking, undo } = await measureDragging(points);
    const figures = [
      `move ${move.median.toFixed(3)} ms (95 % below ${move.most.toFixed(3)})`,
      `release ${release.toFixed(1)} ms`,
      `undo ${undo.toFixed(2)} ms`,
      `step ${bytes(step)}`,
      `autosave ${bytes(written)} in ${blocking.toFixed(2)} ms`,
    ];
    console.log(`${String(points).padStart(6)} points: ${figures.join(", ")}`);
  }
} finally {
  await server.close();
}

function bytes(count) {
  return count < 10_000 ? `${Math.round(count)} B` : `${(count / 1000).toFixed(0)} kB`;
}
