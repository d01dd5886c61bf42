import type { FigureDeclaration } from "../../declaration.ts";

/** The pockets of a front that has stalled: a node that the reader moves, and how the engine closed them. */
export const stallDeclaration: FigureDeclaration = {
  label: "A pocket of a front that has stalled",
  options: {},
  values: {
    pocket: "number",
    faces: "number",
    seen: "number",
    room: "number",
    elements: "number",
    shown: "number",
    handled: "number",
    sight: "text",
  },
  states: {
    pocket: { words: [], takesNumber: true },
    node: { words: ["engine", "start"], takesNumber: false },
    show: { words: ["pocket", "closed"], takesNumber: false },
  },
  marks: { room: "new", node: "new", walls: "active", rod: "plain" },
};
