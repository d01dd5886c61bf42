import { ShapeUtils, Vector2 } from "three";

type Flat = readonly [x: number, y: number, ...rest: readonly number[]];

/** Returns three corners per triangle of a polygon, which may be followed by polygons of its holes. */
export function triangulated(
  outlines: readonly (readonly Flat[])[],
): readonly (readonly [x: number, y: number])[] {
  const [outer = [], ...holes] = outlines.map((outline) => outline.map(([x, y]) => new Vector2(x, y)));
  const corners = [outer, ...holes].flat();
  return ShapeUtils.triangulateShape(outer, holes)
    .flat()
    .map((index): readonly [number, number] => {
      const { x, y } = corners[index] ?? new Vector2();
      return [x, y];
    });
}
