/** Lesson 10 shows the pockets of a real front: those that the engine records today. */
import { readFileSync } from "node:fs";
import { format, type FormatOptions } from "oxfmt";
import { beforeAll, describe, expect, test } from "vitest";
import { bodyVolume, kernelOf } from "../../../web/teach/article/figures/pocket/kernel";
import {
  fillingsOf,
  seenFrom,
  trialsIn,
  volumeOf,
  type Element,
} from "../../../web/teach/article/figures/pocket/pocket-rules";
import { rodPockets, type RodPocket } from "../../../web/teach/article/figures/stall/rod-pockets";
import { orientation } from "../../../web/teach/article/kit/orientation";
import { closedPockets, recordRod } from "../../support/rod-pockets.js";
import type { Trace } from "tetrafront/trace";

const file = new URL("../../../web/teach/article/figures/stall/rod-pockets.json", import.meta.url).pathname;

const pocketAt = (index: number): RodPocket =>
  rodPockets[index] ?? { pocket: { corners: [], faces: [] }, node: null, positions: [], elements: [] };

describe("the pockets of the rod of needles", () => {
  let trace: Trace;
  beforeAll(async () => {
    trace = await recordRod();
  });

  // After a change of the front: npx vitest run rod-pockets --update, and the numbers of lesson 10.
  test("are those of the engine", async () => {
    const options = JSON.parse(readFileSync(".oxfmtrc.json", "utf8")) as FormatOptions;
    const { code } = await format("rod-pockets.json", JSON.stringify(closedPockets(trace)), options);
    await expect(code).toMatchFileSnapshot(file);
  });

  test("what lesson 10 says about the whole run", () => {
    const { changes } = trace.summary();
    expect(changes).toMatchObject({ star: 2, reopened: 4, undone: 4, "exact-fill": 1 });
    expect(trace.header.status).toBe("done");
  });
});

describe.each([0, 1])("pocket %d", (index) => {
  const { pocket, node } = pocketAt(index);

  test("is a prism that is not twisted: three flat tetrahedra, twelve that cross an edge, and no filling", () => {
    expect(pocket.corners).toHaveLength(6);
    expect(pocket.faces).toHaveLength(8);
    const verdicts = trialsIn(pocket).map(({ verdict }) => verdict);
    expect(verdicts.filter((verdict) => verdict === "flat")).toHaveLength(3);
    expect(verdicts.filter((verdict) => verdict === "crosses")).toHaveLength(12);
    expect(fillingsOf(pocket)).toEqual([]);
  });

  test("is closed by a node that sees all faces", () => {
    expect(seenFrom(pocket, node ?? [0, 0, 0])).not.toContain(false);
  });
});

describe("the last pocket", () => {
  const { pocket, positions, elements } = pocketAt(2);

  test("is seen whole from nowhere", () => {
    expect(pocket.faces).toHaveLength(42);
    expect(bodyVolume(kernelOf(pocket))).toBe(0);
  });

  test("is filled by 61 elements, each of them positive, whose volumes add up", () => {
    expect(elements).toHaveLength(61);
    expect(positions).toHaveLength(pocket.corners.length + 6);
    const at = (corner: number) => positions[corner] ?? [0, 0, 0];
    const volumes = elements.map(([a, b, c, d]: Element) => {
      expect(orientation(at(a), at(b), at(c), at(d))).not.toBe(0);
      return volumeOf({
        corners: [at(a), at(b), at(c), at(d)],
        faces: [
          [0, 1, 2],
          [0, 3, 1],
          [1, 3, 2],
          [2, 3, 0],
        ],
      });
    });
    const whole = volumes.reduce((sum, volume) => sum + Math.abs(volume), 0);
    expect(whole).toBeCloseTo(volumeOf(pocket), 10);
  });
});
