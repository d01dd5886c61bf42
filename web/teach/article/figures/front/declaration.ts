import type { FigureDeclaration } from "../../declaration.ts";

/** A polygon that the engine's front in the plane fills again whenever the reader changes it. */
export const frontDeclaration: FigureDeclaration = {
  label: "A polygon, filled by the front in the plane",
  options: {
    size: { type: "number", label: "size" },
    shape: { type: "word", words: ["boot", "fish"] },
    /** At which step the figure opens; without this option, at the beginning. */
    at: { type: "word", words: ["middle"] },
  },
  values: {
    step: "number",
    steps: "number",
    beat: "number",
    front: "number",
    boundary: "number",
    triangles: "number",
    filled: "number",
    fresh: "number",
    refused: "number",
    refusedsofar: "number",
    refusedsteps: "number",
    angle: "number",
    corners: "number",
    touched: "number",
    finished: "number",
    atrefusal: "number",
    scrubbed: "number",
    handled: "number",
  },
  states: {
    step: { words: ["first-refused", "first-new", "middle", "end"], takesNumber: true },
    beat: { words: [], takesNumber: true },
    size: { words: [], takesNumber: true },
  },
  marks: {
    front: "plain",
    active: "active",
    ideal: "active",
    refused: "refused",
    new: "new",
    worst: "active",
  },
};
