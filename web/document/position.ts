/** x y z in model coordinates. */
export type Position = readonly [number, number, number];
