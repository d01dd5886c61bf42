import { expect, it } from "vitest";
import { turned } from "../../../web/document/circles";

it("turned rotates a position around an axis through a centre", () => {
  const found = turned([2, 0, 5], [1, 0, 0], [0, 0, 1], 0.25);
  [1, 1, 5].forEach((x, k) => expect(found[k]).toBeCloseTo(x, 12));
});
