import { afterEach, describe, expect, it, vi } from "vitest";
import { forEachInSlices, sliceMs } from "../../../web/document/slices";

afterEach(() => vi.restoreAllMocks());

describe("work in slices", () => {
  it("yields to the page soon after a slice's time is over", async () => {
    let now = 0;
    vi.spyOn(performance, "now").mockImplementation(() => now);
    const turnsAt: number[] = [];
    const ticking = setInterval(() => turnsAt.push(now), 0);
    const seen: number[] = [];
    await forEachInSlices(10_000, (i) => {
      seen.push(i);
      now += 0.02;
    });
    clearInterval(ticking);
    expect(seen).toEqual(Array.from({ length: 10_000 }, (_, i) => i));
    expect(turnsAt.length).toBeGreaterThan(5);
    const waits = turnsAt.map((at, i) => at - (turnsAt[i - 1] ?? 0));
    expect(Math.max(...waits)).toBeLessThan(3 * sliceMs);
  });
});
