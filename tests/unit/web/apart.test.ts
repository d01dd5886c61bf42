/** Labels in the view that are moved apart. */
import { expect, it } from "vitest";
import { placedApart, type Label } from "../../../web/panels/viewport/apart";
import { randomSource } from "../../support/random";

const size = { width: 40, height: 24 } as const;

it("leaves labels where they are if none lies on another one", () => {
  const labels: Label[] = [0, 50, 100].map((x) => ({ x, y: 7, ...size }));
  expect(placedApart(labels)).toMatchObject([{ x: 0 }, { x: 50 }, { x: 100 }]);
});

it("lets none of sixteen crowded labels lie on another one, and moves none far", () => {
  const random = randomSource(3);
  const labels = Array.from({ length: 16 }, () => ({ x: random() % 60, y: random() % 40, ...size }));
  const placed = placedApart(labels);
  expect(placed[0]).toMatchObject({ x: labels[0]?.x, y: labels[0]?.y });
  placed.forEach((a, i) => {
    for (const b of placed.slice(i + 1))
      expect(Math.abs(a.x - b.x) >= size.width || Math.abs(a.y - b.y) >= size.height).toBe(true);
    expect(Math.hypot(a.x - (labels[i]?.x ?? 0), a.y - (labels[i]?.y ?? 0))).toBeLessThan(8 * size.height);
  });
});
