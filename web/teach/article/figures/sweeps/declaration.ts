import type { FigureDeclaration } from "../../declaration.ts";

/** The recorded sweeps of the optimizer over a cube: its poor elements, and how many elements have which smallest angle. */
export const sweepsDeclaration: FigureDeclaration = {
  label: "Sweeps of the optimizer over a cube",
  options: {},
  values: {
    sweep: "number",
    sweeps: "number",
    elements: "number",
    nodes: "number",
    poor: "number",
    least: "number",
    most: "number",
    moved: "number",
    added: "number",
    removed: "number",
    changed: "number",
    worse: "number",
    clean: "number",
    handled: "number",
    kind: "text",
  },
  states: { sweep: { words: ["end"], takesNumber: true } },
  marks: { poor: "refused", changed: "new", histogram: "plain" },
};
