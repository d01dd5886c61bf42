import type { Label } from "./apart";

/** Size of the view cube and its distance from the top right corner of the view, in CSS pixels. */
export const cubePlace = { size: 92, offset: 10 } as const;

/** Returns the square that the cube covers in a view of a width. */
export const cubeArea = (width: number): Label => ({
  x: width - cubePlace.offset - cubePlace.size / 2,
  y: cubePlace.offset + cubePlace.size / 2,
  width: cubePlace.size,
  height: cubePlace.size,
});
