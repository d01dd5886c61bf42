import type { FigureDeclaration } from "../../declaration.ts";

/** A twisted prism: a pocket with the tetrahedra on its own corners, or with a node that must see all of its faces. */
export const pocketDeclaration: FigureDeclaration = {
  label: "A pocket with six corners and eight faces",
  options: {
    twist: { type: "number", label: "twist" },
    about: { type: "word", words: ["corners", "node"] },
  },
  values: {
    faces: "number",
    trials: "number",
    fits: "number",
    ways: "number",
    seen: "number",
    room: "number",
    shown: "number",
    handled: "number",
    closes: "text",
    fitting: "text",
    sight: "text",
  },
  states: {
    twist: { words: [], takesNumber: true },
    node: { words: ["middle", "low", "wall"], takesNumber: false },
    show: { words: ["pocket", "own", "star"], takesNumber: false },
    trial: { words: ["none"], takesNumber: true },
  },
  marks: {
    ends: "active",
    bent: "active",
    missing: "refused",
    room: "new",
    node: "new",
    walls: "active",
  },
};
