import type { FigureDeclaration } from "../../declaration.ts";

const values = {
  triangles: "number",
  step: "number",
  steps: "number",
  beat: "number",
  aspect: "number",
  shape: "number",
  meanaspect: "number",
  meanshape: "number",
  local: "number",
  localsize: "number",
  x: "number",
  y: "number",
  handled: "number",
} as const;
const states = {
  step: { words: ["new", "middle", "end"], takesNumber: true },
  beat: { words: [], takesNumber: true },
} as const;
const marks = {
  ellipse: "active",
  triangle: "active",
  front: "plain",
  ideal: "active",
} as const;

/** A shape filled with stretched triangles, and the same front in the space of its tensor. */
export const stretchingDeclaration: FigureDeclaration = {
  label: "A shape filled with stretched triangles, and the same triangles in the tensor's space",
  options: {
    size: { type: "number", label: "size across" },
    stretching: { type: "number", label: "stretching" },
    angle: { type: "number", label: "direction in degrees" },
  },
  values: { ...values, even: "number", along: "number", xx: "number", xy: "number", yy: "number" },
  states: {
    ...states,
    size: { words: [], takesNumber: true },
    stretching: { words: [], takesNumber: true },
    angle: { words: [], takesNumber: true },
  },
  marks,
};

/** A rectangle under five ellipses, and the surroundings of a dot in the space of the tensor there. */
export const stretchingFieldDeclaration: FigureDeclaration = {
  label: "A field of ellipses that the front fills, and the surroundings of a dot in the space of its tensor",
  options: {},
  values: { ...values, least: "number", most: "number" },
  states: { ...states, field: { words: ["hill", "crossed"], takesNumber: false } },
  marks: { ...marks, field: "active", dot: "active" },
};
