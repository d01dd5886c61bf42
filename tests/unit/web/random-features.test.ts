/** Random work with the features of a solid: undo and redo give the same documents, and the file stays valid. */
import { expect, test } from "vitest";
import { createBody, type Project, type ProjectBody, type SolidFeature } from "tetrafront/project";
import { emptyProject } from "../../../web/document/create";
import { findingsOf } from "../../support/feature-work";
import { testKernel } from "../../support/kernel-shapes";
import { kernelSolids } from "../../support/kernel-solids";

const { points, triangles } = createBody(
  { points: Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 1), triangles: Uint32Array.of(0, 1, 2) },
  { id: 1, firstPatchId: 1 },
);

/** Makes bodies whose points encode their features; some features fail. */
const solids = {
  bodyOf: (
    _: Project,
    before: ProjectBody | { readonly name: string },
    features: readonly SolidFeature[],
  ): Promise<ProjectBody> => {
    const { isOutdated: _outdated, failures: _failures, ...kept }: Partial<ProjectBody> = before;
    const failures = features
      .filter((one) => one.type === "fillet" && one.radius > 1)
      .map(({ id }) => ({ feature: id, message: "It is too large.", remedy: "Choose a smaller radius." }));
    const repairDeviation = [...JSON.stringify(features)].reduce(
      (sum, c) => (31 * sum + c.charCodeAt(0)) % 9973,
      7,
    );
    const patches = [{ id: 1, origin: "1/top" }];
    const made = { points, triangles, patches, features, repairDeviation };
    return Promise.resolve({ ...kept, id: 1, ...made, ...(failures.length > 0 && { failures }) });
  },
  edgesOf: () => Promise.resolve([{ name: "1/top|1/left", faces: ["1/top", "1/left"] as const }]),
  samplesOf: () => Promise.reject(new Error("not sampled")),
  drawn: () => drawn(),
};

/** A tetrahedron, whatever the features are. */
const drawn = () =>
  Promise.resolve({
    drawing: {
      points: [
        [0, 0, 0],
        [1, 0, 0],
        [0, 1, 0],
        [0, 0, 1],
      ] as const,
      lines: [
        [0, 1],
        [1, 2],
        [2, 0],
        [0, 3],
        [1, 3],
        [2, 3],
      ].map((points) => ({ type: "straight", points }) as const),
      patches: [
        [3, 2, 1],
        [1, 5, -4],
        [2, 6, -5],
        [3, 4, -6],
      ].map((loop, face) => ({ type: "planar", loops: [loop], face, isExact: true }) as const),
      left: [],
    },
    faces: ["1/top", "1/left", "1/front", "1/bottom"],
    failures: [],
    isKernelSpent: false,
  });

test.each(Array.from({ length: 10 }, (_, k) => k + 1))("20 steps of seed %i", async (seed) => {
  expect(await findingsOf(seed, 20, solids)).toEqual([]);
});

// `tests/bench/random-features.mjs` does more.
test("4 steps of two seeds with the kernel", async () => {
  const ofKernel = kernelSolids(testKernel);
  for (const seed of [1, 2]) expect(await findingsOf(seed, 4, ofKernel)).toEqual([]);
});

test("a solid that gets a single face has no patch per triangle any more", async () => {
  const ofKernel = kernelSolids(testKernel);
  const place = { operation: "new", position: [0, 0, 0], axis: [0, 0, 1] } as const;
  const box = await ofKernel.bodyOf(emptyProject(), { name: "solid" }, [
    { id: 1, type: "box", ...place, size: [1, 1, 1] },
  ]);
  expect(box.trianglePatch).toBeDefined();
  const ball = await ofKernel.bodyOf(emptyProject(), box, [{ id: 1, type: "sphere", ...place, radius: 1 }]);
  expect(ball.patches).toHaveLength(1);
  expect(ball.trianglePatch).toBeUndefined();
});
