/** The option `threads`: one mesh for any number, in the engine's worker, in Node programs and on the command line. */
import { execFile } from "node:child_process";
import { readFileSync } from "node:fs";
import { promisify } from "node:util";

import { createMesher, type MeshOptions } from "tetrafront";
import { expect, test } from "vitest";

import { nativeFingerprint } from "../../support/native.js";
import { offFile } from "../../support/surface-files.js";
import { boxSurface, sphereSurface } from "../../support/surfaces.js";
import { temporaryFolder } from "../../support/temporary-folder.js";

/** Its mesh has more than 60 000 elements: it is optimized in tiles. */
const sphere = sphereSurface(22);
const folder = temporaryFolder("all tests");

test("a large mesh is the same for any number of threads, natively, in Node and on the command line", async () => {
  const mesher = await createMesher();
  const filled = async (threads: number) =>
    (await mesher.fillSurface(sphere, { optimization: "fast", interior: "front", threads })).report;
  const alone = await filled(1);
  expect(alone.status).toBe("done");
  expect(alone.threads).toBe(1);
  expect(alone.tetrahedra).toBeGreaterThan(60_000);
  const shared = await filled(4);
  expect(shared.threads).toBe(4);
  expect(shared.fingerprint).toBe(alone.fingerprint);
  expect(shared.dihedral).toEqual(alone.dihedral);
  expect(shared.seconds.optimize).toBeGreaterThan(0);
  mesher.dispose();
  expect(nativeFingerprint(sphere, "--optimization=fast", "--interior=front", "--threads=3")).toBe(
    alone.fingerprint,
  );

  folder.save("sphere.off", offFile(sphere));
  const options = ["--optimize", "fast", "--interior", "front", "--surface", "keep", "--threads", "2"];
  const args = ["mesh", "sphere.off", "-o", "sphere.vtu", "--report", "report.json", ...options];
  const { code, stderr } = await folder.run(...args);
  expect(stderr).not.toContain("error");
  expect(code).toBe(0);
  const report = JSON.parse(readFileSync(folder.inFolder("report.json"), "utf8")) as unknown;
  expect(report).toMatchObject({ threads: 2, fingerprint: alone.fingerprint });
});

/** Cancels a run while its mesh is optimized, once with and once without waiting for the end, and leaves the mesher open. */
const CANCELLING = `import { readFileSync } from "node:fs";
import { createMesher } from ${JSON.stringify(new URL("../../../wasm/dist/index.js", import.meta.url).href)};
const { points, triangles } = JSON.parse(readFileSync(process.argv[2], "utf8"));
const surface = { points: Float64Array.from(points), triangles: Uint32Array.from(triangles) };
const options = { optimization: "fast", interior: "front", threads: 4 };
const mesher = await createMesher();
const stop = new AbortController();
let seen = 0;
const onProgress = ({ phase }) => {
  if (phase === "optimize" && ++seen === 2) stop.abort();
};
const { report } = await mesher.fillSurface(surface, options, { signal: stop.signal, onProgress });
const other = new AbortController();
const last = mesher.fillSurface(surface, options, { signal: other.signal });
other.abort();
console.log(report.status, (await last).report.status);`;

test("a Node program that has cancelled a mesh in tiles ends by itself", async () => {
  const given = JSON.stringify({ points: [...sphere.points], triangles: [...sphere.triangles] });
  folder.save("given.json", given);
  folder.save("cancelling.mjs", CANCELLING);
  const args = [folder.inFolder("cancelling.mjs"), folder.inFolder("given.json")];
  const { stdout } = await promisify(execFile)(process.execPath, args, { timeout: 150_000 });
  expect(stdout.trim()).toBe("cancelled cancelled");
});

test("a number of threads that cannot be used is refused with its limits", async () => {
  const mesher = await createMesher();
  for (const threads of [0, -1, 1.5, 65, NaN, "2"]) {
    const { report } = await mesher.fillSurface(boxSurface(2), { threads } as unknown as MeshOptions);
    expect(report.status).toBe("invalid-input");
    expect(report.diagnostics[0]?.message).toContain("number of threads");
    expect(report.diagnostics[0]?.remedy).toBe("Use a whole number from 1 to 64.");
  }
  expect((await mesher.refineSurface(boxSurface(2), { size: 0.3 })).mesh.triangles.length).toBeGreaterThan(0);
  mesher.dispose();
  folder.save("box.off", offFile(boxSurface(2)));
  const { code, stderr } = await folder.run("mesh", "box.off", "-o", "box.vtu", "--threads", "many");
  expect(code).toBe(2);
  expect(stderr).toMatch(/threads.*whole number from 1 to 64/s);
});
