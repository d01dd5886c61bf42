import type { FigureDeclaration } from "../../declaration.ts";

const even = { type: "number", label: "number of triangles of the even mesh" } as const;
const own = { type: "number", label: "number of triangles of your mesh" } as const;

const values = {
  truth: "number",
  evencount: "number",
  evenanswer: "number",
  evenerror: "number",
  unknowns: "number",
  x: "number",
  y: "number",
  wide: "number",
  high: "number",
  handled: "number",
} as const;
const ownValues = { owncount: "number", ownanswer: "number", ownerror: "number", better: "text" } as const;

const hole = { words: ["round", "slit", "flat"], takesNumber: false };
const number = { words: [], takesNumber: true };
const marks = { pull: "plain", hole: "plain", mesh: "plain", peak: "refused" } as const;

/** A plate with a hole that is pulled, solved on an even mesh of the engine's front in the plane, beside the exact solution. */
export const plateDeclaration: FigureDeclaration = {
  label: "A plate with a hole that is pulled: on one side a mesh, on the other the truth",
  options: { even },
  values: { ...values, curtain: "number" },
  states: { hole, even: number, curtain: { words: ["middle", "mesh", "truth"], takesNumber: false } },
  marks: { ...marks, lines: "plain" },
};

/** The same plate twice: with an even mesh, and with one that is finer in a circle. */
export const plateSpotDeclaration: FigureDeclaration = {
  label: "The plate with an even mesh, and with a mesh that is finer in a circle",
  options: {
    even,
    own,
    factor: { type: "number", label: "how many times smaller triangles are in the circle" },
  },
  values: { ...values, ...ownValues },
  states: {
    hole,
    even: number,
    own: number,
    factor: number,
    spot: { words: ["corner", "top", "flank"], takesNumber: false },
  },
  marks: { ...marks, spot: "active" },
};

/** The same plate twice: with an even mesh, and with a mesh of needles. */
export const plateNeedlesDeclaration: FigureDeclaration = {
  label: "The plate with an even mesh, and with a mesh of needles",
  options: {
    even,
    own,
    stretch: { type: "number", label: "length of the needles, as a multiple of their width" },
    angle: { type: "number", label: "direction of the needles in degrees" },
  },
  values: { ...values, ...ownValues },
  states: { hole, even: number, own: number, stretch: number, angle: number },
  marks,
};
