import type { FigureDeclaration } from "../../declaration.ts";

/** A ball that the front has filled, as the engine recorded it; it is cut and pulled apart by whole elements. */
export const ballDeclaration: FigureDeclaration = {
  label: "A ball, cut open, that the front fills with tetrahedra",
  options: {
    cut: { type: "number", label: "position of the cut" },
    open: { type: "number", label: "how far the elements are apart" },
  },
  values: {
    step: "number",
    steps: "number",
    beat: "number",
    front: "number",
    boundary: "number",
    filled: "number",
    elements: "number",
    fresh: "number",
    refused: "number",
    atrefusal: "number",
    finished: "number",
    handled: "number",
  },
  states: {
    step: { words: ["middle", "first-refused", "end"], takesNumber: true },
    beat: { words: [], takesNumber: true },
    cut: { words: [], takesNumber: true },
    open: { words: [], takesNumber: true },
  },
  marks: { front: "active", new: "new", hollow: "active" },
};
