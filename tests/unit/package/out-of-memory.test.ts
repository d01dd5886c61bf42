/** Out of memory: the error reports what was requested and what would fit, and the mesher stays usable. */
import { execFile } from "node:child_process";
import { promisify } from "node:util";

import { expect, test } from "vitest";

import { cubeProject } from "../../support/projects.js";

const run = promisify(execFile);
const entry = new URL("../../../wasm/dist/index.js", import.meta.url).href;
const limit = new URL("../../support/little-memory.mjs", import.meta.url).href;
const MEMORY = 80 * 2 ** 20;

interface ReportedError {
  readonly code: string;
  readonly message: string;
  readonly data: Record<string, unknown>;
}

/** Runs the body in a process whose engines get little memory, and returns its result. */
async function withLittleMemory<T>(body: string): Promise<T> {
  const program = `import { createMesher } from ${JSON.stringify(entry)};
    const cube = ${JSON.stringify(cubeProject())};
    const reported = ({ code, message, data }) => ({ code, message, data });
    const mesher = await createMesher();
    const answer = await (async () => { ${body} })();
    console.log(JSON.stringify(answer));
    mesher.dispose();`;
  const limits = { TETRAFRONT_TEST_MEMORY: String(MEMORY), NODE_OPTIONS: `--import "${limit}"` };
  const args = ["--input-type=module", "-e", program];
  const { stdout } = await run(process.execPath, args, { env: { ...process.env, ...limits } });
  return JSON.parse(stdout) as T;
}

test("a mesh too large for the memory is rejected with statistics, and a size that fits can be meshed afterwards", async () => {
  const [failure, factor, status, expected] = await withLittleMemory<
    [ReportedError, number, string, number]
  >(`
    const size = 0.018;
    const options = { optimization: "none", interior: "front" };
    const failure = await mesher.meshProject(cube, { ...options, size }).catch(reported);
    const factor = failure.data?.sizeFactor;
    const { report } = await mesher.meshProject(cube, { ...options, size: factor * size });
    return [failure, factor, report.status, failure.data?.expectedTetrahedra];`);
  expect(failure.code).toBe("out-of-memory");
  expect(failure.message).toMatch(
    /^The engine ran out of memory \(\d+ MB\) in the phase "\w+", after \d+ of about \d+ tetrahedra\. Use elements at least \d\.\d times as large\.$/,
  );
  expect(failure.data["bytes"]).toBeGreaterThan(MEMORY / 2);
  expect(failure.data["bytes"]).toBeLessThanOrEqual(MEMORY);
  expect(failure.data["tetrahedra"]).toBeLessThan(expected);
  expect(factor).toBeGreaterThan(1);
  expect(factor).toBeLessThan(4);
  expect(status).toBe("done");
});

test("if a query runs out of memory, the run beside it is rejected with its progress", async () => {
  const [run, query] = await withLittleMemory<[ReportedError, ReportedError]>(`
    const count = 1_000_000;
    const mesh = {
      points: Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1),
      tetrahedra: Uint32Array.from({ length: 4 * count }, (_, i) => i % 4),
    };
    let query;
    const onProgress = ({ tetrahedra }) => {
      if (tetrahedra > 0) query ??= mesher.inspectMesh(mesh).catch(reported);
    };
    const run = await mesher.meshProject(cube, { size: 0.03 }, { onProgress }).catch(reported);
    return [run, await query];`);
  expect(run.code).toBe("out-of-memory");
  expect(run.data).toMatchObject({
    bytes: expect.any(Number) as number,
    phase: expect.any(String) as string,
    tetrahedra: expect.any(Number) as number,
    sizeFactor: expect.any(Number) as number,
  });
  expect(run.data["tetrahedra"]).toBeGreaterThan(0);
  expect(query).toMatchObject({ code: "out-of-memory", data: { tetrahedra: 0 } });
});

test("a query too large for the memory is rejected, and the next one is answered", async () => {
  const [failure, isValid] = await withLittleMemory<[ReportedError, boolean]>(`
    const count = 1_000_000;
    const mesh = {
      points: Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1),
      tetrahedra: Uint32Array.from({ length: 4 * count }, (_, i) => i % 4),
    };
    const failure = await mesher.inspectMesh(mesh).catch(reported);
    const one = { ...mesh, tetrahedra: mesh.tetrahedra.slice(0, 4) };
    return [failure, (await mesher.inspectMesh(one)).isValid];`);
  expect(failure).toMatchObject({ code: "out-of-memory", data: { tetrahedra: 0 } });
  expect(failure.message).toMatch(/^The engine ran out of memory \(\d+ MB\)\. Use a smaller/);
  expect(isValid).toBe(true);
});

test("a surface too large for the memory is rejected with the number of triangles that fit, and that many do fit", async () => {
  const [given, failures, isFillable] = await withLittleMemory<[number, ReportedError[], boolean]>(`
    const torus = (n) => {
      const points = Float64Array.from({ length: 3 * n * n }, (_, i) => {
        const [u, v] = [Math.floor(i / 3 / n), Math.floor(i / 3) % n].map((k) => (2 * Math.PI * k) / n);
        return [(2 + Math.cos(v)) * Math.cos(u), (2 + Math.cos(v)) * Math.sin(u), Math.sin(v)][i % 3];
      });
      const at = (i, j) => (i % n) * n + (j % n);
      const triangles = Uint32Array.from({ length: n * n }, (_, k) => k).reduce((all, k) => {
        const [i, j] = [Math.floor(k / n), k % n];
        all.set([at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j), at(i + 1, j + 1), at(i, j + 1)], 6 * k);
        return all;
      }, new Uint32Array(6 * n * n));
      return { points, triangles };
    };
    const large = torus(600);
    const failures = [await mesher.fillSurface(large).catch(reported), await mesher.inspectSurface(large).catch(reported)];
    const fitting = Math.min(...failures.map(({ data }) => data.fittingTriangles));
    const { isFillable } = await mesher.inspectSurface(torus(Math.floor(Math.sqrt(fitting / 2))));
    return [large.triangles.length / 3, failures, isFillable];`);
  for (const { code, data, message } of failures) {
    expect(code).toBe("out-of-memory");
    expect(data["fittingTriangles"]).toBeGreaterThan(given / 10);
    expect(data["fittingTriangles"]).toBeLessThan(given);
    expect(message).toMatch(/Use a coarser surface: about \d+ triangles fit, fewer with/);
  }
  expect(isFillable).toBe(true);
});
