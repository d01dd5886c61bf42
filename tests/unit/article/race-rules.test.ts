/** The race of lesson 7: its tasks can be done, and its table is true of the engine. */
import { readFileSync } from "node:fs";
import { loadPlaneFront } from "tetrafront/trace";
import { describe, expect, test } from "vitest";
import { filmOf, smallestAngle } from "../../../web/teach/article/figures/front/front-film";
import {
  centre,
  channel,
  fillChannel,
  onWing,
  orders,
  outlineOf,
  withinChannel,
  type Order,
  type Wing,
} from "../../../web/teach/article/figures/race/race-rules";
import { storedPlanes, successOf } from "../../support/planes";

const front = await loadPlaneFront();

test.each(orders)("%s has the triangles of the native engine", (order) => {
  const { fingerprint } = successOf(fillChannel(front, { at: centre, angle: 12 }, 0.6, order));
  expect(fingerprint).toBe(storedPlanes().find(({ name }) => name === `lesson-wing-${order}`)?.fingerprint);
});

function refusals(wing: Wing, growth: number): Record<Order, number> {
  const counted = orders.map((order) => [order, fillBy(order, wing, growth, false).refusedCount]);
  return Object.fromEntries(counted) as Record<Order, number>;
}

/** Returns the refused candidates, and the smallest angle of the mesh, in degrees. */
function fillBy(
  order: Order,
  wing: Wing,
  growth: number,
  improve: boolean,
): { readonly refusedCount: number; readonly angle: number } {
  const filled = fillChannel(front, wing, growth, order, improve);
  if (!filled.success) throw new Error(filled.message);
  expect(filled.status).toBe("done");
  const { triangles, points } = filled.mesh;
  const angles = Array.from({ length: triangles.length / 3 }, (_none, i) =>
    smallestAngle(
      [...triangles.subarray(3 * i, 3 * i + 3)].map((node) => [
        points[2 * node] ?? 0,
        points[2 * node + 1] ?? 0,
      ]),
    ),
  );
  return { refusedCount: filmOf(filled).refusedCount, angle: Math.min(...angles) };
}

/** Wings at random positions and angles, the same ones every time. */
function wings(count: number): readonly Wing[] {
  let state = 7;
  const random = (): number => (state = (state * 16807) % 2147483647) / 2147483647;
  return Array.from({ length: count }, () => ({
    at: withinChannel([random() * channel[0], random() * channel[1]]),
    angle: -30 + 60 * random(),
  }));
}

describe("the race", () => {
  test("keeps the wing within the channel at every angle", () => {
    for (const corner of [[0, 0], channel, [9, -9]] as const)
      for (let angle = -40; angle <= 40; angle += 5)
        for (const [x, y] of outlineOf({ at: withinChannel(corner), angle })) {
          expect(Math.min(x, y, channel[0] - x, channel[1] - y)).toBeGreaterThan(0.05);
        }
  });

  test("turns the tail down by the angle", () => {
    const [x, y] = onWing({ at: [0, 0], angle: 30 }, [1, 0]);
    expect((Math.atan2(y, x) * 180) / Math.PI).toBeCloseTo(-30, 9);
  });

  const text = readFileSync("web/lessons/7.md", "utf8");
  const table = [...text.matchAll(/^\| ([\d.]+)[^|]*\|(.+)\|$/gm)].map(([, growth, cells = ""]) => ({
    growth: Number(growth),
    cells: cells.replaceAll(/[*°\s]/g, "").split("|"),
  }));
  const rows = table.slice(0, 4).map(({ growth, cells }) => ({ growth, means: cells.map(Number) }));
  const angleRows = table.slice(4);

  test("has two tables of the lesson with four growths", () => {
    const growths = [0.2, 0.3, 0.6, 1.6];
    expect(table.map(({ growth }) => growth)).toEqual([...growths, ...growths]);
  });

  test.each(angleRows)(
    "has these mean smallest angles of sixty wings with growth $growth, before and after improvement",
    ({ growth, cells }) => {
      const mean = (order: Order, improve: boolean): number =>
        Math.round(wings(60).reduce((sum, wing) => sum + fillBy(order, wing, growth, improve).angle, 0) / 60);
      expect(orders.map((order) => `${mean(order, false)}→${mean(order, true)}`)).toEqual(cells);
    },
    120_000,
  );

  const claim = /for (\d+) of the sixty wings.+at 0\.6 for (\d+) of them, and at 1\.6 for (none|\d+)/.exec(
    text,
  );

  test.each([
    [0.25, claim?.[1]],
    [0.6, claim?.[2]],
    [1.6, claim?.[3] === "none" ? "0" : claim?.[3]],
  ])(
    "has the fewest refusals layer by layer with growth %d for %s wings",
    (growth, written) => {
      const best = wings(60).filter((wing) => {
        const { layered, ...others } = refusals(wing, growth);
        return layered <= Math.min(...Object.values(others));
      });
      expect(String(best.length)).toBe(written);
    },
    120_000,
  );

  test.each(rows)(
    "has these mean refusals of sixty wings with growth $growth",
    ({ growth, means }) => {
      const counted = wings(60).map((wing) => refusals(wing, growth));
      const found = orders.map((order) => Math.round(counted.reduce((sum, of) => sum + of[order], 0) / 60));
      expect(found).toEqual(means);
    },
    120_000,
  );
});
