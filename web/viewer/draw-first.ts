import type { BufferGeometry } from "three";

/** Draws the first entries of the index of a geometry, which have changed. */
export function drawFirst(geometry: BufferGeometry, count: number): void {
  const index = geometry.getIndex();
  geometry.setDrawRange(0, count);
  index?.clearUpdateRanges();
  index?.addUpdateRange(0, count);
  if (index) index.needsUpdate = true;
}
