import type { FigureDeclaration } from "../../declaration.ts";

/** A front that the reader advances, beside what the program makes of it. */
export const mesherDeclaration: FigureDeclaration = {
  label: "A front that you advance",
  options: {
    level: { type: "word", words: ["five", "boot", "fine", "stretched", "cube", "prism"] },
  },
  values: {
    level: "text",
    stage: "number",
    front: "number",
    elements: "number",
    newnodes: "number",
    angle: "number",
    refused: "number",
    closed: "number",
    stalled: "number",
    space: "number",
    program: "number",
    programnewnodes: "number",
    programangle: "number",
    programrefused: "number",
    handled: "number",
  },
  states: {
    level: { words: ["five", "boot", "fine", "stretched", "cube", "prism"], takesNumber: false },
  },
  marks: { front: "plain", active: "active", ideal: "new", worst: "active", refused: "refused" },
};
