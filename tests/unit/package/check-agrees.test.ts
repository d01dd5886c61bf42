/** `tetrafront check` accepts an input if and only if `tetrafront mesh` does: one function prepares it for both. */
import type { SurfaceInput } from "tetrafront";
import { afterEach, beforeEach, expect, test, vi } from "vitest";

import { checkFile } from "../../../wasm/src/cli/check.js";
import { meshFile } from "../../../wasm/src/cli/mesh.js";
import { randomSource } from "../../support/random.js";
import { boxSolid, stepFile } from "../../support/step-files.js";
import { offFile, smeshFile, stlText } from "../../support/surface-files.js";
import { boxSurface, joined, sphereSurface, turned } from "../../support/surfaces.js";
import { temporaryFolder } from "../../support/temporary-folder.js";

const { save, inFolder } = temporaryFolder();

/** Writes nothing, and says that it is written. */
function discard(_text: unknown, ...others: unknown[]): boolean {
  const done = others.find((other) => typeof other === "function") as (() => void) | undefined;
  done?.();
  return true;
}

beforeEach(() => {
  for (const stream of [process.stderr, process.stdout])
    vi.spyOn(stream, "write").mockImplementation(discard);
});
afterEach(() => vi.restoreAllMocks());

const INVALID = 2;

/** Expects that both commands refuse the file, or neither does. Returns whether they do. */
async function refused(file: string, content: string | Uint8Array, repair = false): Promise<boolean> {
  save(file, content);
  const input = inFolder(file);
  const checked = await checkFile(input, { repair });
  const output = inFolder("out.msh");
  const meshed = await meshFile(input, { output, repair, filters: true, optimize: "none" });
  expect(checked === INVALID, `${file}: check ${checked}, mesh ${meshed}`).toBe(meshed === INVALID);
  return checked === INVALID;
}

const soup = ({ points, triangles }: SurfaceInput, noise: () => number): SurfaceInput => ({
  points: Float64Array.from(
    [...triangles].flatMap((node) => [...points.subarray(3 * node, 3 * node + 3)]),
  ).map((x) => x + noise()),
  triangles: triangles.map((_, corner) => corner),
});

const withoutTriangles = ({ points, triangles }: SurfaceInput, count: number): SurfaceInput => ({
  points,
  triangles: triangles.slice(3 * count),
});

const withFlipped = ({ points, triangles }: SurfaceInput, count: number): SurfaceInput => ({
  points,
  triangles: Uint32Array.of(...triangles.slice(0, 3 * count).reverse(), ...triangles.slice(3 * count)),
});

const twice = ({ points, triangles }: SurfaceInput, count: number): SurfaceInput => ({
  points,
  triangles: Uint32Array.of(...triangles, ...triangles.slice(0, 3 * count)),
});

/** A body, and what may be wrong with it. */
function randomInput(random: () => number): SurfaceInput {
  const low = [random(), random(), random()].map((x) => Math.round(4 * x) / 4) as [number, number, number];
  const box = boxSurface(1 + Math.floor(2 * random()), low, [low[0] + 1, low[1] + 1, low[2] + 1]);
  const body = random() < 0.5 ? box : sphereSurface(2, 0.6, low);
  const other = boxSurface(1, [1, 1, 1], [2, 2, 2]);
  const wrong: readonly ((surface: SurfaceInput) => SurfaceInput)[] = [
    (one) => one,
    (one) => joined(one, other),
    (one) => joined(one, turned(sphereSurface(2, 0.2, low))),
    (one) => joined(one, sphereSurface(2, 0.2, low)),
    (one) => withoutTriangles(one, 1 + Math.floor(2 * random())),
    (one) => withFlipped(one, 1 + Math.floor(3 * random())),
    (one) => twice(one, 1),
    (one) => turned(one),
    (one) => soup(one, () => 1e-7 * (random() - 0.5)),
    (one) => soup(one, () => 1e-16 * (random() - 0.5)),
    (one) => soup(one, () => 0),
  ];
  const pick = () => wrong[Math.floor(wrong.length * random())] ?? ((one: SurfaceInput) => one);
  return pick()(random() < 0.3 ? pick()(body) : body);
}

test("on random surfaces in several formats, also with a repair", async () => {
  const source = randomSource(43);
  const random = () => source() / 2 ** 32;
  let count = 0;
  for (let i = 0; i < 15; i++) {
    const surface = randomInput(random);
    const [name, content] = (
      [
        ["a.stl", stlText(surface)],
        ["a.off", offFile(surface)],
        ["a.smesh", smeshFile(surface, "0\n0\n")],
      ] as const
    )[i % 3] ?? ["a.off", offFile(surface)];
    if (await refused(name, content, random() < 0.3)) count++;
  }
  // Both answers occur.
  expect(count).toBeGreaterThan(1);
  expect(count).toBeLessThan(13);
});

test("on solids of shapes: apart, touching in parts of faces, overlapping", async () => {
  const base = boxSolid("base", [0, 0, 0], [4, 4, 1]);
  for (const [post, isRefused] of [
    [boxSolid("post", [1, 1, 1], [2, 2, 3]), false],
    [boxSolid("post", [0, 0, 1], [4, 4, 3]), false],
    [boxSolid("post", [1, 1, 0.5], [2, 2, 3]), false],
    [boxSolid("post", [5, 5, 5], [6, 6, 6]), false],
  ] as const) {
    expect(await refused("parts.step", stepFile([base, post]))).toBe(isRefused);
  }
});
