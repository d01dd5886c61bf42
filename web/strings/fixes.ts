const linesText = (lines: readonly number[]): string =>
  `${lines.length === 1 ? "line" : "the lines"} ${lines.join(", ")}`;

/** Texts of quick fixes: the label of the button, and what it will do. */
export const fixStrings = {
  cover: {
    label: "Create covering grid",
    effect: "Creates a background grid of one size around the model.",
  },
  enlarge: {
    label: "Enlarge covering grid",
    effect: "Replaces the background grid by a larger one of the same size around the model; sources stay.",
  },
  extend: {
    label: "Extend background grid",
    effect:
      "Makes the background grid cover the model by a margin: outside its tetrahedra, the sizes of the nearest one apply; inside, no size changes.",
  },
  joinPoints: (keep: number, drop: number) => ({
    label: "Join points",
    effect: `Uses point ${keep} in place of point ${drop}, and joins lines and patches that then coincide.`,
  }),
  joinLines: (keep: number, drop: number) => ({
    label: "Join lines",
    effect: `Uses line ${keep} in all patches in place of line ${drop}.`,
  }),
  splitLine: (line: number, points: readonly number[]) => ({
    label: "Split the line",
    effect: `Splits line ${line} at ${points.length === 1 ? "point" : "the points"} ${points.join(", ")}, where other lines end on it.`,
  }),
  orderLoop: (patch: number) => ({
    label: "Order the loop",
    effect: `Puts the lines of patch ${patch} in order and reverses those that run the wrong way.`,
  }),
  closeCircle: (line: number) => ({
    label: "Close the circle",
    effect: `Makes the first point of line ${line} its last one too.`,
  }),
  deleteLine: (line: number) => ({
    label: "Delete the line",
    effect: `Deletes line ${line}, which no patch uses.`,
  }),
  removeTetrahedron: {
    label: "Remove the tetrahedron",
    effect: "Removes the tetrahedron from the background grid; its nodes stay.",
  },
  closePatch: (lines: readonly number[], holes: readonly number[]) => ({
    label: "Close with a patch",
    effect: `Adds a planar patch within ${linesText(lines)}${holes.length > 0 ? `, around ${linesText(holes)}` : ""}.`,
  }),
  fixAll: (count: number) => `Fix all ${count}`,
  fixAllEffect: (effect: string) => `Does the same for all problems of this kind. ${effect}`,
  stepAll: (label: string, count: number) => `${label} (${count} problems)`,
} as const;
