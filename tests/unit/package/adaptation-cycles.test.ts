/** `adapt` and `tetrafront adapt --solver`: cycles of solution and adaptation, checkpoints, failures of the solver. */
import { existsSync, readFileSync, rmSync } from "node:fs";
import { spawnSync } from "node:child_process";
import { fileURLToPath } from "node:url";

import {
  type AdaptationCycle,
  createMesher,
  type FieldValues,
  type Mesh,
  type Mesher,
  readMesh,
  type Solve,
  writeMesh,
} from "tetrafront";
import { afterAll, beforeAll, describe, expect, test } from "vitest";

import { meshVolume } from "../../support/check-mesh.js";
import { tetrafront } from "../../support/command-line.js";
import { offFile } from "../../support/surface-files.js";
import { boxSurface } from "../../support/surfaces.js";
import { temporaryFolder } from "../../support/temporary-folder.js";

let mesher: Mesher;
let box: Mesh;
beforeAll(async () => {
  mesher = await createMesher();
  box = (await mesher.fillSurface(boxSurface(3), { optimization: "fast" })).mesh;
});
afterAll(() => mesher.dispose());

const folder = temporaryFolder();
const { inFolder, save, run } = folder;

const layer = ([x = 0, y = 0]: readonly number[]) => Math.tanh(20 * (x + y / 2 - 0.6));

function layerOn({ points }: Mesh): FieldValues {
  const values = Float64Array.from({ length: points.length / 3 }, (_, node) =>
    layer([...points.subarray(3 * node, 3 * node + 3)]),
  );
  return { name: "u", components: 1, values };
}

async function all(cycles: AsyncIterable<AdaptationCycle>): Promise<AdaptationCycle[]> {
  const made: AdaptationCycle[] = [];
  for await (const cycle of cycles) made.push(cycle);
  return made;
}

const options = { cycles: 2, elements: 1500, sweeps: 4 };

describe("adapt", () => {
  test("makes meshes that follow the solution, whose error falls", async () => {
    const fractions: number[] = [];
    const starts: number[] = [];
    const solve: Solve = (mesh, { start, cycle }) => {
      starts.push(start.length);
      expect([...mesh.nodeData.keys()]).toEqual(cycle === 1 ? [] : ["u"]);
      return [layerOn(mesh)];
    };
    const onProgress = ({ fraction }: { readonly fraction: number }) => fractions.push(fraction);
    const made = await all(mesher.adapt(box, solve, options, { onProgress }));
    expect(made.map(({ cycle }) => cycle)).toEqual([1, 2]);
    expect(starts).toEqual([0, 1]);
    const [first, second] = made;
    const [before = 0, after = 0] = [first?.estimatedErrors[0], second?.estimatedErrors[0]];
    // The second mesh has few more elements, but they are where the layer is.
    expect(after).toBeLessThan(before / 2);
    const next = second?.next;
    expect(next?.after.unitEdges).toBeGreaterThan(0.9);
    expect(Math.abs((next?.after.tetrahedra ?? 0) / 1500 - 1)).toBeLessThan(0.5);
    expect(meshVolume(next?.mesh ?? box)).toBeCloseTo(1, 9);
    expect(next?.mesh.nodeData.get("u")?.values).toHaveLength((next?.mesh.points.length ?? 0) / 3);
    expect(fractions).toEqual(fractions.toSorted((a, b) => a - b));
  });

  test("has the wanted number of elements after some cycles, whatever the thin layers add", async () => {
    const solve: Solve = (mesh) => [layerOn(mesh)];
    const made = await all(mesher.adapt(box, solve, { cycles: 4, elements: 3000 }));
    const counts = made.map(({ next }) => next.after.tetrahedra);
    expect(Math.abs((counts.at(-1) ?? 0) / 3000 - 1), counts.join()).toBeLessThan(0.05);
  });

  test("follows an indicator of the solver's, and reports its largest value", async () => {
    const solve: Solve = (mesh) => {
      const eta = Float64Array.from({ length: mesh.tetrahedra.length / 4 }, (_, t) => 1 + (t % 3));
      return [layerOn(mesh), { name: "eta", components: 1, values: eta, isPerElement: true }];
    };
    const [cycle] = await all(mesher.adapt(box, solve, { ...options, cycles: 1, indicator: "eta" }));
    expect(cycle?.estimatedErrors).toEqual([3]);
    expect(cycle?.sizes.expectedErrors).toHaveLength(1);
    expect(Math.abs((cycle?.next.after.tetrahedra ?? 0) / 1500 - 1)).toBeLessThan(0.5);
    const missing = all(mesher.adapt(box, solve, { ...options, cycles: 1, indicator: "residual" }));
    await expect(missing).rejects.toThrow(/no field "residual".*"u", "eta"/s);
  });

  test("the estimated error of a quadratic field is near its interpolation error", async () => {
    const solve: Solve = ({ points }) => {
      const values = Float64Array.from(
        { length: points.length / 3 },
        (_, node) => (points[3 * node] ?? 0) ** 2,
      );
      return [{ name: "q", components: 1, values }];
    };
    const [only] = await all(mesher.adapt(box, solve, { cycles: 1, elements: 300, sweeps: 1 }));
    const mesh = only?.mesh ?? box;
    expect((only?.estimatedErrors[0] ?? 0) / interpolationError(mesh)).toBeCloseTo(1, 0);
  });

  test("replaces the triangles of a surface, so that the first solution has elements inside", async () => {
    for await (const { mesh } of mesher.adapt(boxSurface(1), (given) => [layerOn(given)], options)) {
      expect(mesh.points.length / 3).toBeGreaterThan(100);
      expect(meshVolume(mesh)).toBeCloseTo(1, 9);
      break;
    }
  });

  test("continues where it was left", async () => {
    const solve: Solve = (mesh) => [layerOn(mesh)];
    const [first, second] = await all(mesher.adapt(box, solve, options));
    if (first === undefined) throw new Error("no cycle");
    const resume = { cycle: 1, mesh: first.next.mesh, asked: first.sizes.elements };
    const [again, ...others] = await all(mesher.adapt(first.mesh, solve, { ...options, resume }));
    expect(others).toEqual([]);
    expect(again?.cycle).toBe(2);
    expect(again?.next.mesh.points).toEqual(second?.next.mesh.points);
    expect(again?.next.mesh.tetrahedra).toEqual(second?.next.mesh.tetrahedra);
  });

  test("ends when its signal is aborted, also while the solver runs", async () => {
    const stop = new AbortController();
    const solve: Solve = () => {
      stop.abort();
      return new Promise<never>(() => undefined);
    };
    const cycles = mesher.adapt(box, solve, options, { signal: stop.signal });
    await expect(all(cycles)).rejects.toMatchObject({ code: "cancelled" });
  });

  test.each<[string, Solve, object, RegExp]>([
    ["no list", () => 5 as never, {}, /The solver returned 5, not a list of fields/],
    ["few values", () => [{ components: 1, values: new Float64Array(2) }], {}, /has 2 values/],
    [
      "values that are not finite",
      ({ points }) => [{ name: "u", components: 1, values: new Float64Array(points.length / 3).fill(NaN) }],
      {},
      /The field "u" is NaN at node 0/,
    ],
    ["an unknown name", (mesh) => [layerOn(mesh)], { fields: ["p"] }, /no field "p"\. Use one of "u"/],
    [
      "no target",
      (mesh) => [layerOn(mesh)],
      { elements: undefined },
      /Neither a number of elements nor an error/,
    ],
    ["no cycle", (mesh) => [layerOn(mesh)], { cycles: 0 }, /whole number from 1 to 1000/],
  ])("refuses %s", async (_, solve, changes, message) => {
    await expect(all(mesher.adapt(box, solve, { ...options, ...changes }))).rejects.toThrow(message);
  });

  test("passes on what the solver throws", async () => {
    const solve: Solve = () => Promise.reject(new Error("diverged"));
    await expect(all(mesher.adapt(box, solve, options))).rejects.toThrow("diverged");
  });
});

/** Returns the L2 norm of the error of linear interpolation of x², integrated exactly in barycentric coordinates. */
function interpolationError({ points, tetrahedra }: Mesh): number {
  let sum = 0;
  for (let t = 0; t < tetrahedra.length; t += 4) {
    const nodes = [...tetrahedra.subarray(t, t + 4)];
    const at = (node: number, axis: number) => points[3 * node + axis] ?? 0;
    const [a = 0, ...rest] = nodes;
    const [u = [], v = [], w = []] = rest.map((node) =>
      [0, 1, 2].map((axis) => at(node, axis) - at(a, axis)),
    );
    const minor = (i: number, j: number) => (u[i] ?? 0) * (v[j] ?? 0) - (u[j] ?? 0) * (v[i] ?? 0);
    const volume = (minor(1, 2) * (w[0] ?? 0) + minor(2, 0) * (w[1] ?? 0) + minor(0, 1) * (w[2] ?? 0)) / 6;
    // The error is the sum of l_i l_j (x_i - x_j)² over the edges.
    const edges = nodes.flatMap((one, i) =>
      nodes.slice(i + 1).map((other, k) => ({ i, j: i + 1 + k, square: (at(one, 0) - at(other, 0)) ** 2 })),
    );
    for (const one of edges) {
      for (const other of edges) {
        const powers = [0, 0, 0, 0];
        for (const corner of [one.i, one.j, other.i, other.j]) powers[corner] = (powers[corner] ?? 0) + 1;
        const factorials = powers.reduce((product, power) => product * (power === 2 ? 2 : 1), 1);
        sum += (one.square * other.square * volume * 6 * factorials) / 5040;
      }
    }
  }
  return Math.sqrt(sum);
}

/** A solver in Node: reads Medit files, and writes the layer at the nodes. It fails on request. */
const SOLVER = `
import { existsSync, readFileSync, writeFileSync } from "node:fs";
const [, , mesh, solution] = process.argv;
const words = readFileSync(mesh, "utf8").replace(/^#.*$/gm, "").split(/\\s+/);
const begin = words.indexOf("Vertices");
const count = Number(words[begin + 1]);
if (existsSync("fail")) {
  console.log("assembling");
  console.error("singular matrix");
  process.exit(3);
}
if (existsSync("silent")) process.exit(0);
if (existsSync("slow")) setTimeout(() => undefined, 60_000);
else {
  const values = Array.from({ length: count }, (_, node) => {
    const [x, y] = words.slice(begin + 2 + 4 * node).map(Number);
    return Math.tanh(20 * (x + y / 2 - 0.6));
  });
  writeFileSync(solution, \`MeshVersionFormatted 2\\nDimension 3\\nSolAtVertices\\n\${count}\\n1 1\\n\${values.join("\\n")}\\nEnd\\n\`);
}
`;

const ADAPT = [
  "adapt",
  "box.mesh",
  "-o",
  "out.vtu",
  "--mesh-format",
  "mesh",
  "--elements",
  "1200",
  "--sweeps",
  "3",
];
const WITH_SOLVER = [...ADAPT, "--solver", `"${process.execPath}" solver.mjs`, "--cycles", "2"];

describe("tetrafront adapt --solver", () => {
  const begin = async () => {
    const [file] = await writeMesh(box, "box.mesh");
    save("box.mesh", file?.bytes ?? "");
    save("solver.mjs", SOLVER);
  };

  const reportIn = (stdout: string) =>
    JSON.parse(stdout) as {
      readonly folder: string;
      readonly cycles: readonly {
        readonly cycle: number;
        readonly estimatedErrors: { readonly solution: number };
      }[];
    };

  test("loops, reports each cycle, and leaves all files in a folder", async () => {
    await begin();
    const { code, stderr, stdout } = await run(...WITH_SOLVER, "--json");
    // On a slow machine, lines say how long the work has taken so far.
    expect(stderr).toMatch(/^(tetrafront: .* so far.*\n)*$/);
    expect(code).toBe(0);
    const { cycles, folder: name } = reportIn(stdout);
    expect(cycles.map(({ cycle }) => cycle)).toEqual([1, 2]);
    const [first = 0, second = 0] = cycles.map(({ estimatedErrors }) => estimatedErrors.solution);
    expect(second).toBeLessThan(first);
    for (const file of ["mesh-1.vtu", "mesh-1.mesh", "solution-2.sol", "background-2.vtu", "mesh-3.vtu"]) {
      expect(existsSync(inFolder(`${name}/${file}`)), file).toBe(true);
    }
    const read = await readMesh(readFileSync(inFolder("out.vtu")), { fileName: "out.vtu" });
    expect(read.success && read.value.nodeData.has("solution")).toBe(true);
    const again = await run(...WITH_SOLVER);
    expect(again.code).toBe(2);
    expect(again.stderr).toMatch(/has 2 cycles of an earlier run\. Use --resume/);
  });

  test("a failure of the solver names the command, its exit code and last lines; --resume then continues", async () => {
    await begin();
    expect((await run(...WITH_SOLVER.slice(0, -1), "1")).stderr).toMatch(/error of solution/);
    save("fail", "");
    const failed = await run(...WITH_SOLVER, "--resume");
    expect(failed.code).toBe(1);
    expect(failed.stderr).toMatch(/1 cycle of 2 in out-cycles; continuing with cycle 2/);
    expect(failed.stderr).toMatch(
      /the solver failed in cycle 2 with exit code 3: .*solver\.mjs; its last lines: .*singular matrix/i,
    );
    expect(failed.stderr).toMatch(/--resume/);
    rmSync(inFolder("fail"));
    save("silent", "");
    expect((await run(...WITH_SOLVER, "--resume")).stderr).toMatch(/wrote no solution in cycle 2/);
    rmSync(inFolder("silent"));
    const done = await run(...WITH_SOLVER, "--resume", "--json");
    expect(done.code).toBe(0);
    expect(reportIn(done.stdout).cycles).toHaveLength(2);
    save("box.mesh", `${readFileSync(inFolder("box.mesh"), "utf8")}\n`);
    expect((await run(...WITH_SOLVER, "--resume")).stderr).toMatch(/are of another model than box\.mesh/);
  });

  test("an interrupt ends the solver and leaves the checkpoint", async () => {
    await begin();
    save("slow", "");
    const { code, stderr } = await tetrafront(folder.path, WITH_SOLVER, {
      started: (child) => {
        const timer = setInterval(() => {
          if (!existsSync(inFolder("out-cycles/mesh-1.mesh"))) return;
          clearInterval(timer);
          setTimeout(() => child.kill("SIGINT"), 300);
        }, 50);
      },
    });
    expect(code).toBe(1);
    expect(stderr).toMatch(/out-cycles has 0 cycles; --resume continues/);
    expect(stderr).toMatch(/cancelled, not written/);
    rmSync(inFolder("slow"));
    expect((await run(...WITH_SOLVER, "--resume")).code).toBe(0);
  });

  test.each<[readonly string[], RegExp]>([
    [["adapt", "box.mesh", "-o", "out.vtu"], /none of --background, --layers and --solver/i],
    [[...WITH_SOLVER, "--background", "box.mesh"], /exclude each other/],
    [[...ADAPT, "--background", "box.mesh"], /--mesh-format is for cycles|--elements is for cycles/],
    [[...WITH_SOLVER, "--error", "1"], /both a number of elements and an error/i],
    [[...WITH_SOLVER, "--cycles", "none"], /whole number from 1 to 1000/],
    [[...WITH_SOLVER, "--mesh-format", "stl"], /cannot store a volume mesh/],
    [[...WITH_SOLVER, "--resume"], /there is nothing to resume/i],
    [[...WITH_SOLVER, "--field", "p", "--cycles", "1"], /no field "p"\. The file has "solution"/],
  ])("refuses %s", async (args, message) => {
    await begin();
    const { code, stderr } = await run(...args);
    expect(stderr).toMatch(message);
    expect(code).toBe(2);
  });
});

const python = process.env["TETRAFRONT_PYTHON"] ?? "python3";
const example = fileURLToPath(new URL("../../../examples/adaptive/solve.py", import.meta.url));

describe("the example of a solver of one's own", () => {
  if (spawnSync(python, ["-c", "import skfem, meshio"]).status === 0) {
    test("gets meshes on which its error falls", async () => {
      save("cube.off", offFile(boxSurface(1)));
      const solver = `${python} ${example} {mesh} {solution}`;
      const args = [
        "adapt",
        "cube.off",
        "--solver",
        solver,
        "--cycles",
        "2",
        "--elements",
        "2000",
        "-o",
        "a.vtu",
      ];
      const { code, stderr } = await run(...args);
      expect(code, stderr).toBe(0);
      const errors = [1, 2].map((cycle) =>
        Number(/error (\S+)/.exec(readFileSync(inFolder(`a-cycles/solver-${cycle}.log`), "utf8"))?.[1]),
      );
      expect(errors[1]).toBeLessThan((errors[0] ?? 0) / 2);
    });
  }
});
