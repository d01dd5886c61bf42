import type { FigureDeclaration } from "../../declaration.ts";

/** Two triangles in space: six pairs of a side and a face, and equation 1 of the paper as a path. */
export const crossingSpaceDeclaration: FigureDeclaration = {
  label: "Two triangles in space",
  options: { t: { type: "number", label: "tolerance" } },
  values: {
    layer: "number",
    crossing: "number",
    hits: "number",
    pair: "number",
    a1: "number",
    a2: "number",
    a3: "number",
    a4: "number",
    excess: "number",
    onlyfourth: "number",
    handled: "number",
    verdict: "text",
  },
  states: { pose: { words: ["through", "above", "beside"], takesNumber: false } },
  marks: { new: "new", front: "active", path: "plain", cut: "refused" },
};
