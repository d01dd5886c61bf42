/** Boolean operations on two solids. A difference subtracts the second solid from the first. */
export const booleanKinds = ["union", "difference", "intersection"] as const;
export type BooleanKind = (typeof booleanKinds)[number];
