import { expect, it } from "vitest";
import { drawnSurface } from "../../../web/document/drawn-surface";
import { isInside } from "../../../web/document/planar-loops";
import type { Position } from "../../../web/document/position";
import { OutlineArea } from "../../../web/tools/outline-area";
import { entitiesWithin, outlinedBodies } from "../../../web/tools/outline-selection";
import type { ScreenPoint } from "../../../web/viewer/screen";
import type { ShownBody } from "../../../web/viewer/shown-bodies";
import { randomSource } from "../../support/random";
import { boxSurface } from "../../support/surfaces";

const view = { layers: { bodies: true }, hidden: new Set<string>(), bodySurface: "given" } as never;

/** A closed lasso around the origin with waves: it is not convex. */
function lasso(count: number, radius: number): ScreenPoint[] {
  return Array.from({ length: count }, (_, k) => {
    const angle = (2 * Math.PI * k) / count;
    const r = radius * (1 + 0.5 * Math.sin(7 * angle));
    return { x: r * Math.cos(angle), y: r * Math.sin(angle) };
  });
}

/** A box of 12 n² triangles. */
function box(n: number, low: Position, high: Position): ShownBody {
  const { points, triangles } = boxSurface(n, low, high);
  const drawn = drawnSurface({ points, triangles }, 1);
  const given = { drawn } as unknown as ShownBody["given"];
  return { id: 1, placement: undefined, given, preview: null, split: null, patches: [] };
}

it("knows the same points inside, and the same segments across, as a test of every edge", () => {
  const random = randomSource(5);
  const share = (): number => random() / 2 ** 32;
  const points = lasso(300, 100);
  const area = new OutlineArea(points);
  const polygon = points.map(({ x, y }) => [x, y] as const);
  const distance = ({ x, y }: ScreenPoint): number =>
    Math.min(...points.map((one) => Math.hypot(one.x - x, one.y - y)));
  const anywhere = (): ScreenPoint => ({ x: 400 * share() - 200, y: 400 * share() - 200 });
  let [inside, across] = [0, 0];
  for (let k = 0; k < 4000; ++k) {
    const [a, b] = [anywhere(), anywhere()];
    // Points of the lasso within its tolerance are left out.
    if (distance(a) < 3 || distance(b) < 3) continue;
    const [isA, isB] = [a, b].map(({ x, y }) => isInside([x, y], polygon));
    expect(area.contains(a)).toBe(isA);
    if (isA !== isB) expect(area.crosses(a, b)).toBe(true);
    const place = area.placeOf({
      left: Math.min(a.x, b.x),
      right: Math.max(a.x, b.x),
      top: Math.min(a.y, b.y),
      bottom: Math.max(a.y, b.y),
    });
    if (place !== "mixed") {
      expect([isA, isB]).toEqual([place === "inside", place === "inside"]);
      expect(area.crosses(a, b)).toBe(false);
    }
    inside += Number(isA);
    across += Number(isA !== isB);
  }
  expect(Math.min(inside, across)).toBeGreaterThan(500);
});

it("compares few edges for a body of many triangles that a long lasso surrounds but does not touch", () => {
  // The body lies beside the lasso, within its box: in the notch between two waves.
  const points = lasso(4000, 100);
  const notch = (3 * Math.PI) / 14;
  const [x, y] = [100 * Math.cos(notch), 100 * Math.sin(notch)];
  const body = box(120, [x - 8, y - 8, 0], [x + 8, y + 8, 1]);
  let projections = 0;
  const toScreen = ([px, py]: Position): ScreenPoint => {
    ++projections;
    return { x: px, y: py };
  };
  for (const [touching, found] of [
    [true, 0],
    [false, 0],
  ] as const) {
    const area = new OutlineArea(points);
    const before = area.comparisons;
    projections = 0;
    const shown = outlinedBodies([body], view);
    expect(entitiesWithin({ points, touching }, shown, toScreen, area)).toHaveLength(found);
    const triangles = 12 * 120 ** 2;
    expect(area.comparisons - before).toBeLessThan(triangles / 2);
    expect(projections).toBeLessThan(triangles);
  }
});

it("finds a body by one corner that the lasso contains", () => {
  const points = lasso(4000, 100);
  const body = box(40, [60, 0, 0], [400, 300, 1]);
  const find = (touching: boolean) =>
    entitiesWithin({ points, touching }, outlinedBodies([body], view), ([x, y]) => ({ x, y }));
  expect(find(true)).toEqual([{ kind: "body", id: 1 }]);
  expect(find(false)).toEqual([]);
});
