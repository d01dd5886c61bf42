import type { FigureDeclaration } from "../../declaration.ts";

/** A new triangle and a side of the front in the plane, compared in the three layers of the paper. */
export const crossingDeclaration: FigureDeclaration = {
  label: "A new triangle and a side of the front in the plane",
  options: { t: { type: "number", label: "tolerance" } },
  values: {
    layer: "number",
    crossing: "number",
    meets: "number",
    inside: "number",
    shared: "number",
    enters: "number",
    a1: "number",
    a3: "number",
    a4: "number",
    excess: "number",
    handled: "number",
    verdict: "text",
  },
  states: {
    pose: {
      words: ["apart", "beyond", "through", "near", "beside", "shared", "entering"],
      takesNumber: false,
    },
  },
  marks: { triangle: "new", side: "plain", boxes: "plain", base: "active" },
};
