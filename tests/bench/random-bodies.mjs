/**
 * Remeshes and repairs random bodies, damaged at random, each with a time limit: none may hang, crash, or leave a surface that is not
 * valid. Bodies are Booleans of spheres, boxes and cylinders (Manifold), at random scales and distances from the origin, some
 * nested. Damages: flipped, missing and duplicate triangles, noise, needles, single precision.
 *
 *     node tests/bench/random-bodies.mjs [COUNT] [FIRST]
 *
 * Prints one line per body that took long or failed, and the counts at the end.
 */
import { createMesher } from "tetrafront";

import { randomBody } from "./support/random-bodies.mjs";

const COUNT = Number(process.argv[2] ?? 300);
const FIRST = Number(process.argv[3] ?? 0);
/** Seconds per call. */
const LIMIT = 60;
const SLOW = 15;

let mesher = await createMesher();
const counts = { bodies: 0, remeshed: 0, repaired: 0, refused: 0, stopped: 0, crashed: 0, invalid: 0 };
let longest = 0;

/** Calls with a time limit; resolves with undefined if the input was refused. */
async function call(words, run) {
  const control = new AbortController();
  const timer = setTimeout(() => control.abort(), 1000 * LIMIT);
  const began = performance.now();
  try {
    return await run({ signal: control.signal });
  } catch (failure) {
    if (failure.code === "invalid-input") counts.refused++;
    else if (failure.code === "cancelled") counts.stopped++;
    else counts.crashed++;
    if (failure.code !== "invalid-input") console.log(`${words}: ${failure.code ?? failure}`);
    if (failure.code === "disposed") mesher = await createMesher();
    return undefined;
  } finally {
    clearTimeout(timer);
    const seconds = (performance.now() - began) / 1000;
    longest = Math.max(longest, seconds);
    if (seconds > SLOW) console.log(`${words}: ${seconds.toFixed(1)} s`);
  }
}

async function isFillable(surface) {
  return (await mesher.inspectSurface(surface)).isFillable;
}

for (let seed = FIRST; seed < FIRST + COUNT; seed++) {
  const { surface, words } = randomBody(seed);
  const subject = `${seed} (${words})`;
  counts.bodies++;
  const repair = await call(`${subject} repair`, (control) => mesher.repairSurface(surface, {}, control));
  const repaired = repair?.mesh ?? surface;
  const canBeFilled = (await call(`${subject} inspect`, () => isFillable(repaired))) === true;
  if (canBeFilled) counts.repaired++;
  const remesh = await call(`${subject} remesh`, (control) => mesher.remeshSurface(repaired, {}, control));
  if (remesh === undefined) continue;
  counts.remeshed++;
  if (await isFillable(remesh.mesh)) continue;
  counts.invalid++;
  console.log(`${subject}: the remeshed surface is not valid`);
}
console.log({ ...counts, longest: `${longest.toFixed(1)} s` });
mesher.dispose();
