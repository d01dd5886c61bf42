import { describe, expect, it } from "vitest";
import { isPictureSize, tilesOf } from "../../../web/viewer/picture-tiles";

describe("the tiles of a picture", () => {
  it.each([
    [1, 1, 4],
    [4, 4, 4],
    [5, 4, 4],
    [9, 7, 4],
    [3840, 2160, 1024],
  ])("of %i × %i cover each pixel once, none larger than %i", (width, height, side) => {
    const tiles = tilesOf({ width, height }, side);
    expect(tiles.reduce((sum, tile) => sum + tile.width * tile.height, 0)).toBe(width * height);
    for (const { x, y, width: across, height: down } of tiles) {
      expect(Math.min(across, down)).toBeGreaterThan(0);
      expect(Math.max(across, down)).toBeLessThanOrEqual(side);
      expect([x % side, y % side]).toEqual([0, 0]);
      expect(x + across).toBeLessThanOrEqual(width);
      expect(y + down).toBeLessThanOrEqual(height);
    }
    expect(new Set(tiles.map(({ x, y }) => `${x} ${y}`)).size).toBe(tiles.length);
  });

  it("exist for whole sizes that canvases have", () => {
    expect(isPictureSize({ width: 3840, height: 2160 })).toBe(true);
    expect(isPictureSize({ width: 16_384, height: 7000 })).toBe(true);
    for (const [width, height] of [
      [0, 5],
      [1.5, 5],
      [16_385, 1],
      [16_384, 16_384],
      [NaN, 1],
    ] as const)
      expect(isPictureSize({ width, height })).toBe(false);
  });
});
