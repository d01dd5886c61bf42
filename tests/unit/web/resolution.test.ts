import { describe, expect, it } from "vitest";
import { Resolution, scales } from "../../../web/viewer/resolution";

/** Adds frames whose times depend on the share of the full resolution. Returns the shares before each. */
function move(resolution: Resolution, frames: number, timeAt: (scale: number) => number): number[] {
  return Array.from({ length: frames }, () => {
    const { scale } = resolution;
    resolution.add(timeAt(scale));
    return scale;
  });
}

/** A frame whose time is that of its pixels, and a rest. */
const ofPixels =
  (full: number, rest = 0) =>
  (scale: number): number =>
    Math.max(1000 / 60, rest + full * scale ** 2);

describe("Resolution", () => {
  it.each([1000 / 144, 1000 / 60, 1000 / 30])("stays full at %f ms per frame", (ms) => {
    expect(new Set(move(new Resolution(), 200, () => ms))).toEqual(new Set([1]));
  });

  it.each([60, 100, 200, 600])("is lowered at once where %d ms of pixels per frame become fast", (full) => {
    const resolution = new Resolution();
    const shown = move(resolution, 60, ofPixels(full));
    const settled = shown.slice(8);
    expect(new Set(settled).size).toBe(1);
    const [scale = 1] = settled;
    expect(scale).toBeLessThan(1);
    // The time aimed at is met, or the resolution is the lowest.
    expect(scale === scales.at(-1) || full * scale ** 2 <= 40).toBe(true);
  });

  it("is full again if fewer pixels do not help, also when tried a second time", () => {
    const resolution = new Resolution();
    const shown = move(resolution, 100, ofPixels(10, 300));
    expect(shown.filter((scale) => scale < 1).length).toBeLessThanOrEqual(8);
    expect(resolution.scale).toBe(1);
    expect(new Set(move(resolution, 400, ofPixels(10, 300)))).toEqual(new Set([1]));
  });

  it("is lowered although other work disturbed the first try", () => {
    const resolution = new Resolution();
    move(resolution, 4, ofPixels(100));
    expect(resolution.scale).toBeLessThan(1);
    move(resolution, 4, () => 150);
    expect(resolution.scale).toBe(1);
    move(resolution, 40, ofPixels(100));
    expect(resolution.scale).toBeLessThan(1);
  });

  it("does not change to and fro", () => {
    for (let full = 20; full < 1000; full += 7) {
      for (const rest of [0, 5, 20, 60]) {
        const shown = move(new Resolution(), 200, ofPixels(full, rest));
        const changes = shown.filter((scale, i) => i > 0 && scale !== shown[i - 1]);
        expect(changes.length).toBeLessThanOrEqual(5);
      }
    }
  });

  it("rises again after a delay that was not that of drawing", () => {
    const resolution = new Resolution();
    move(resolution, 4, () => 120);
    expect(resolution.scale).toBeLessThan(1);
    resolution.rest();
    move(resolution, 4 * scales.length, () => 16);
    expect(resolution.scale).toBe(1);
  });

  it("begins the next motion as the last one ended", () => {
    const resolution = new Resolution();
    move(resolution, 40, ofPixels(150));
    const { scale } = resolution;
    resolution.rest();
    expect(move(resolution, 40, ofPixels(150))).toEqual(Array<number>(40).fill(scale));
  });

  it("ignores pauses of the page", () => {
    const resolution = new Resolution();
    move(resolution, 20, () => 5000);
    expect(resolution.scale).toBe(1);
  });
});
