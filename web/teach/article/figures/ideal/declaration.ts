import type { FigureDeclaration } from "../../declaration.ts";

/** One face of the front with its ideal point; the right triangle of h and R stands in the scene. */
export const idealDeclaration: FigureDeclaration = {
  label: "A triangle in space and the ideal point above it",
  options: {
    size: { type: "number", label: "target size" },
    foot: { type: "word", words: ["mean", "centre"] },
  },
  values: {
    h: "number",
    wanted: "number",
    held: "number",
    radius: "number",
    used: "number",
    height: "number",
    square: "number",
    base: "number",
    ratio: "number",
    edge1: "number",
    edge2: "number",
    edge3: "number",
    uneven: "number",
    inside: "number",
    centred: "number",
    low: "number",
    blunt: "number",
    handled: "number",
    limit: "text",
  },
  states: {
    pose: { words: ["even", "long", "blunt"], takesNumber: false },
    foot: { words: ["mean", "centre"], takesNumber: false },
    size: { words: [], takesNumber: true },
  },
  marks: {
    face: "active",
    radius: "active",
    height: "new",
    slope: "plain",
    ideal: "new",
    circle: "plain",
    foot: "plain",
    edges: "plain",
  },
};
