import { describe, expect, it } from "vitest";
import { usedPatches } from "../../../web/document/body-edits";
import { mergePatches, splitByAngle } from "../../../web/document/patch-splitting";
import { plateSurface } from "../../support/plate";
import { sphereSurface } from "../../support/surfaces";

const surface = plateSurface({ half: 5, thickness: 1, radius: 2, corners: 24 });
const onePatch = { ...surface, trianglePatch: new Uint32Array(surface.triangles.length / 3) };
const options = { angle: 40, only: null, nextId: 8, bodyName: "plate" };

describe("splitByAngle", () => {
  it("makes a patch of each side of a plate and of its hole, in the order of their lowest corners", () => {
    const { trianglePatch, patches } = splitByAngle(onePatch, [{ id: 5, name: "plate" }], options);
    expect(patches).toEqual([5, 8, 9, 10, 11, 12, 13].map((id) => ({ id })));
    const heights = patches.map((_, patch) =>
      trianglePatch.reduce((highest, of, t) => {
        const nodes = [...surface.triangles.subarray(3 * t, 3 * t + 3)];
        return of === patch
          ? Math.max(highest, ...nodes.map((node) => surface.points[3 * node + 2] ?? 0))
          : highest;
      }, -1),
    );
    // The top is the only patch whose lowest corner is at the top.
    expect(heights.filter((height) => height === 0)).toHaveLength(1);
    const lowest = patches.map((_, patch) => {
      const nodes = [...surface.triangles].filter(
        (_node, corner) => trianglePatch[Math.floor(corner / 3)] === patch,
      );
      return Math.min(...nodes.map((node) => surface.points[3 * node + 2] ?? 0));
    });
    expect(lowest).toEqual([0, 0, 0, 0, 0, 0, 1]);
  });

  it("keeps smooth surfaces, other patches and names", () => {
    const sphere = sphereSurface(12);
    const whole = { ...sphere, trianglePatch: new Uint32Array(sphere.triangles.length / 3) };
    expect(splitByAngle(whole, [{ id: 1, name: "ball" }], options).patches).toEqual([
      { id: 1, name: "ball" },
    ]);
    const split = splitByAngle(onePatch, [{ id: 5, name: "plate" }], options);
    const again = splitByAngle({ ...surface, trianglePatch: split.trianglePatch }, split.patches, {
      ...options,
      angle: 1,
      only: 0,
    });
    expect(again.patches.length).toBe(split.patches.length);
    const named = split.patches.map(({ id }) => ({ id, name: `side ${id}` }));
    const bore = named.findIndex(
      (_, patch) => split.trianglePatch.filter((of) => of === patch).length === 48,
    );
    const divided = splitByAngle({ ...surface, trianglePatch: split.trianglePatch }, named, {
      ...options,
      angle: 5,
      only: bore,
      nextId: 20,
    });
    expect(divided.patches).toHaveLength(6 + 24);
    expect(divided.patches.filter(({ id }) => id < 20)).toHaveLength(7);
    expect(divided.patches.find(({ id }) => id === named[bore]?.id)?.name).toBe(`${named[bore]?.name} 1`);
  });

  it("is undone by merging", () => {
    const split = splitByAngle(onePatch, [{ id: 5 }], options);
    const merged = mergePatches(split.trianglePatch, split.patches, new Set([8, 9]));
    const used = usedPatches(merged.patches, merged.trianglePatch);
    expect(used.patches.map(({ id }) => id)).toEqual([5, 8, 10, 11, 12, 13]);
    expect(Math.max(...used.trianglePatch)).toBe(5);
    const all = new Set(split.patches.map(({ id }) => id));
    const whole = usedPatches(
      split.patches,
      mergePatches(split.trianglePatch, split.patches, all).trianglePatch,
    );
    expect(whole.patches).toEqual([{ id: 5 }]);
    expect(whole.trianglePatch).toEqual(onePatch.trianglePatch);
  });
});
