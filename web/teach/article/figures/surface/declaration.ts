import type { FigureDeclaration } from "../../declaration.ts";

/** A patch in space, its unit square and the stretched square: one dot in all three, or one front. */
export const surfaceDeclaration: FigureDeclaration = {
  label: "A unit square, the stretched square, and the surface",
  options: {
    bulge: { type: "number", label: "bulge of the surface" },
    show: { type: "word", words: ["dot", "front"] },
    /** The patch with which the figure opens; without this option, the sail. */
    patch: { type: "word", words: ["sail", "kite"] },
  },
  values: {
    lostsquare: "number",
    lostplane: "number",
    xi: "number",
    eta: "number",
    x: "number",
    y: "number",
    xb: "number",
    xc: "number",
    xd: "number",
    yd: "number",
    triangles: "number",
    angle: "number",
    square: "number",
    plane: "number",
    space: "number",
    ruler: "text",
    bysquare: "number",
    handled: "number",
    step: "number",
    steps: "number",
  },
  states: {
    at: { words: ["a", "edge", "middle"], takesNumber: false },
    patch: { words: ["sail", "flat", "kite"], takesNumber: false },
    bulge: { words: [], takesNumber: true },
    ruler: { words: ["square", "plane", "space"], takesNumber: false },
    step: { words: ["middle", "end"], takesNumber: true },
  },
  marks: {
    triangle: "active",
    dot: "active",
    net: "plain",
    corners: "plain",
    front: "plain",
    worst: "refused",
  },
};
