/** Lesson 11 plays a recorded trace: the one that the engine records today, and what the lesson says about it. */
import { readFileSync, writeFileSync } from "node:fs";
import { createMesher } from "tetrafront";
import { recordTrace } from "tetrafront/trace";
import { beforeAll, describe, expect, test } from "vitest";
import { SweepFilm } from "../../../web/teach/article/figures/sweeps/sweep-film";
import { galleryProject, tracedIn } from "../../support/recorded-models.js";

const file = new URL("../../../web/teach/article/figures/sweeps/cube.tft", import.meta.url);

describe("the sweeps over the cube", () => {
  let recorded = new Uint8Array();
  beforeAll(async () => {
    const mesher = await createMesher();
    const { trace } = await recordTrace(mesher, galleryProject("unit-cube"));
    mesher.dispose();
    recorded = trace ?? recorded;
    // After a change of the engine: STORE_TRACE=1 npx vitest run cube-sweeps, and the numbers of lesson 11.
    if (process.env["STORE_TRACE"]) writeFileSync(file, recorded);
  });

  test("are those of the engine, byte by byte", () => {
    expect(Buffer.compare(readFileSync(file), recorded)).toBe(0);
  });

  test("have the poor elements and angles that the engine counts, after each sweep", () => {
    const trace = tracedIn(recorded);
    const film = new SweepFilm(trace);
    for (let state = 0; state <= film.stepCount; state++) {
      const { poor, bars } = film.stateAt(state);
      const measures = film.measuresAt(state);
      // Positions of moved nodes are rounded in a trace: an element may be on the other side of a limit.
      expect(Math.abs(poor.length - measures.outOfRange), `sweep ${state}`).toBeLessThanOrEqual(1);
      expect(bars.reduce((sum, count) => sum + count, 0)).toBe(measures.tetrahedra);
    }
  });

  test("what lesson 11 says about them", () => {
    const film = new SweepFilm(tracedIn(recorded));
    const [before, after] = [film.measuresAt(0), film.measuresAt(film.stepCount)];
    expect(film.stepCount).toBe(47);
    expect([before.tetrahedra, before.outOfRange, after.outOfRange]).toEqual([1736, 137, 0]);
    expect(before.dihedral.min).toBeLessThan(0.6);
    expect(film.measuresAt(1).outOfRange).toBe(41);
    expect(film.measuresAt(3).outOfRange).toBe(15);
    expect(film.sizes.indexOf(0)).toBe(12);
    expect(film.isWorse(8)).toBe(true);
    expect(film.sizes.slice(12).some((poor) => poor > 0)).toBe(true);
    const isIdle = (state: number): boolean => {
      const {
        movedNodes = 0,
        addedNodes = 0,
        removedNodes = 0,
        changedElements = 0,
      } = film.sweepOf(state) ?? {};
      return movedNodes + addedNodes + removedNodes + changedElements === 0;
    };
    expect([39, 40, 41, 42, 43, 44, 45, 46, 47].map(isIdle)).toEqual([
      false,
      ...Array<boolean>(8).fill(true),
    ]);
    const removed: Record<string, number> = {};
    let back = 0;
    film.sizes.slice(1).forEach((_, i) => {
      const fewer = film.measuresAt(i).outOfRange - film.measuresAt(i + 1).outOfRange;
      const kind = film.sweepOf(i + 1)?.kind ?? "";
      if (fewer > 0) removed[kind] = (removed[kind] ?? 0) + fewer;
      else back -= fewer;
    });
    expect([removed, back]).toEqual([{ swap: 102, move: 32, split: 6, collapse: 1 }, 4]);
    expect(readFileSync("web/lessons/11.md", "utf8")).toContain(
      "swaps have removed 102 here, moves 32, splits 6 and collapses 1. (Four came back on the way.)",
    );
    expect(film.sweepOf(4)).toMatchObject({ kind: "split", addedNodes: 75 });
    expect(film.sweepOf(8)).toMatchObject({ kind: "collapse", removedNodes: 64 });
    expect(after.dihedral.min).toBeCloseTo(33.5, 1);
    expect(after.dihedral.max).toBeCloseTo(125.6, 1);
    expect(after.tetrahedra).toBe(1753);
  });
});
