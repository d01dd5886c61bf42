/** Labels in the view that are moved apart. */
import { describe, expect, it } from "vitest";
import { placedApart, placedAround, type Label } from "../../../web/viewer/apart";
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

it("lets labels leave the view rather than lie on each other if none fits", () => {
  const labels = Array.from({ length: 4 }, () => ({ x: 20, y: 20, ...size }));
  const placed = placedApart(labels, () => false);
  expect(placed[0]).toMatchObject({ x: 20, y: 20 });
  placed.forEach((a, i) => {
    for (const b of placed.slice(i + 1))
      expect(Math.abs(a.x - b.x) >= size.width || Math.abs(a.y - b.y) >= size.height).toBe(true);
  });
});

describe("labels around a drawing", () => {
  const view = { width: 400, height: 300 };
  const flat = { width: 40, height: 16 };

  it("are outside of a small drawing, in the direction of what they name, and apart", () => {
    const anchors = [
      { x: 190, y: 150 },
      { x: 210, y: 150 },
      { x: 200, y: 140 },
    ].map((at) => ({ ...at, ...flat }));
    const places = placedAround(anchors, view);
    expect(places[0]?.x).toBeLessThan(190 - flat.width / 2);
    expect(places[1]?.x).toBeGreaterThan(210 + flat.width / 2);
    expect(places[2]?.y).toBeLessThan(140 - flat.height / 2);
  });

  it("stay in the view, and near what they name", () => {
    const anchors = [
      { x: 2, y: 2, ...flat },
      { x: 398, y: 298, ...flat },
    ];
    for (const [i, place] of placedAround(anchors, view).entries()) {
      const { x, y } = place ?? { x: NaN, y: NaN };
      expect(x).toBeGreaterThanOrEqual(flat.width / 2);
      expect(x).toBeLessThanOrEqual(view.width - flat.width / 2);
      expect(y).toBeGreaterThanOrEqual(flat.height / 2);
      expect(y).toBeLessThanOrEqual(view.height - flat.height / 2);
      const { x: ax = 0, y: ay = 0 } = anchors[i] ?? {};
      expect(Math.hypot(x - ax, y - ay)).toBeLessThan(100);
    }
  });

  it("have no place if what they name is out of view, and then move no others", () => {
    const [left, right] = [
      { x: 190, y: 150, ...flat },
      { x: 210, y: 150, ...flat },
    ];
    const outside = [
      { x: -1, y: 150, ...flat },
      { x: 200, y: 301, ...flat },
    ];
    expect(placedAround([...outside, left, right], view)).toEqual([
      null,
      null,
      ...placedAround([left, right], view),
    ]);
    expect(placedAround(outside, view)).toEqual([null, null]);
  });

  it("stay in the view beside what covers it, also where they are moved apart", () => {
    const random = randomSource(5);
    const anchors = Array.from({ length: 12 }, () => ({
      x: random() % 40,
      y: 270 + (random() % 30),
      ...flat,
    }));
    const coveredLeft = 48;
    const places = placedAround(anchors, { ...view, coveredLeft });
    places.forEach((a, i) => {
      if (!a) throw new Error("a label in the view has no place");
      expect(a.x).toBeGreaterThanOrEqual(coveredLeft + flat.width / 2);
      expect(a.y).toBeLessThanOrEqual(view.height - flat.height / 2);
      for (const b of places.slice(i + 1))
        expect(Math.abs(a.x - (b?.x ?? 0)) >= flat.width || Math.abs(a.y - (b?.y ?? 0)) >= flat.height).toBe(
          true,
        );
    });
  });

  it("avoid what lies over the view", () => {
    const cover = { x: 350, y: 250, width: 100, height: 100 };
    const named = { x: 310, y: 220, ...flat };
    const isUnder = ({ x, y }: { readonly x: number; readonly y: number }): boolean =>
      Math.abs(x - cover.x) < (flat.width + cover.width) / 2 &&
      Math.abs(y - cover.y) < (flat.height + cover.height) / 2;
    const [free] = placedAround([named], view);
    const [moved] = placedAround([named], view, [cover]);
    if (!free || !moved) throw new Error("a label in the view has no place");
    expect(isUnder(free)).toBe(true);
    expect(isUnder(moved)).toBe(false);
    expect(Math.hypot(moved.x - free.x, moved.y - free.y)).toBeLessThan(80);
  });
});
