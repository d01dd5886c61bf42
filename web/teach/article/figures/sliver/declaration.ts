import type { FigureDeclaration } from "../../declaration.ts";

/** Four points with the dihedral angles of their tetrahedron. */
export const sliverDeclaration: FigureDeclaration = {
  label: "Four points in space and the angles between their faces",
  options: { lift: { type: "number", label: "lift" } },
  values: {
    least: "number",
    most: "number",
    large: "number",
    longest: "number",
    shortest: "number",
    uneven: "number",
    volume: "number",
    shape: "number",
    moved: "number",
    handled: "number",
    kind: "text",
  },
  states: {
    lift: { words: [], takesNumber: true },
    pose: { words: ["square", "cap", "needle", "wedge"], takesNumber: false },
  },
  marks: { circle: "plain", angles: "active", large: "refused", small: "refused", edges: "plain" },
};
