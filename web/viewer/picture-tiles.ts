/** A picture that may be larger than a canvas of the graphics processor is drawn in parts. */

/** A rectangle of the picture, in its pixels. */
export interface Tile {
  readonly x: number;
  readonly y: number;
  readonly width: number;
  readonly height: number;
}

export interface PictureSize {
  readonly width: number;
  readonly height: number;
}

/** Largest width and height of a picture, and its largest number of pixels: those that canvases of all browsers have. */
export const maxPictureSide = 16_384;
export const maxPicturePixels = 128e6;

/** Returns whether a picture of this size can be made. */
export const isPictureSize = ({ width, height }: PictureSize): boolean =>
  [width, height].every((side) => Number.isInteger(side) && side >= 1 && side <= maxPictureSide) &&
  width * height <= maxPicturePixels;

/** Returns the tiles that cover a picture, row by row, none wider or higher than `side`. */
export function tilesOf({ width, height }: PictureSize, side: number): readonly Tile[] {
  const tiles: Tile[] = [];
  for (let y = 0; y < height; y += side)
    for (let x = 0; x < width; x += side)
      tiles.push({ x, y, width: Math.min(side, width - x), height: Math.min(side, height - y) });
  return tiles;
}
