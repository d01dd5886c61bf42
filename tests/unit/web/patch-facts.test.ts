import { expect, it } from "vitest";
import { patchFacts } from "../../../web/document/patch-facts";
import { rotationOf } from "../../../web/document/placement";
import { boxSurface } from "../../support/surfaces";

const { points, triangles } = boxSurface(3, [5, 5, 5], [7, 8, 9]);
/** The triangles at the top are the second patch; all others, the first. */
const trianglePatch = Uint32Array.from({ length: triangles.length / 3 }, (_, t) =>
  triangles.subarray(3 * t, 3 * t + 3).every((node) => points[3 * node + 2] === 9) ? 1 : 0,
);
const surface = { points, triangles, trianglePatch };

it("a planar patch has an area and a normal, also where its body is placed", () => {
  const top = patchFacts(surface, 1);
  expect(top).toMatchObject({ triangles: 18, normal: [0, 0, 1] });
  expect(top.area).toBeCloseTo(6, 12);
  const placement = { position: [1, 2, 3], rotation: rotationOf([90, 0, 0]), scale: 2 } as const;
  const turned = patchFacts(surface, 1, placement);
  expect(turned.area).toBeCloseTo(24, 12);
  [0, -1, 0].forEach((x, k) => expect(turned.normal?.[k]).toBeCloseTo(x, 12));
});

it("other patches have no normal", () => {
  const rest = patchFacts(surface, 0);
  expect(rest).toMatchObject({ triangles: 90, normal: null });
  expect(rest.area).toBeCloseTo(2 * (6 + 8 + 12) - 6, 12);
});
