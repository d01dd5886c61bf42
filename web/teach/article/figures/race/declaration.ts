import type { FigureDeclaration } from "../../declaration.ts";

/** A wing in a channel, filled four times by the engine's front in the plane; only the order of the base edges differs. */
export const raceDeclaration: FigureDeclaration = {
  label: "A wing in a channel, filled in four orders",
  options: {
    growth: { type: "number", label: "growth" },
    angle: { type: "number", label: "angle of the wing" },
  },
  values: {
    smallest: "number",
    oldest: "number",
    random: "number",
    layered: "number",
    smallestangle: "number",
    oldestangle: "number",
    randomangle: "number",
    layeredangle: "number",
    triangles: "number",
    share: "number",
    x: "number",
    y: "number",
    handled: "number",
    fewest: "text",
  },
  states: {
    share: { words: ["start", "third", "end"], takesNumber: true },
    growth: { words: [], takesNumber: true },
    angle: { words: [], takesNumber: true },
    wing: { words: ["centre"], takesNumber: false },
  },
  marks: {
    front: "plain",
    wing: "plain",
    refused: "refused",
    worst: "active",
  },
};
