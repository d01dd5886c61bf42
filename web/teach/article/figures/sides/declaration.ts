import type { FigureDeclaration } from "../../declaration.ts";

/** A straight line under its size curve, divided side by side (Löhner & Parikh 1988, section 5.1, steps S1 to S4). */
export const sidesDeclaration: FigureDeclaration = {
  label: "A line under its size curve, divided into sides",
  options: {
    tolerance: { type: "number", label: "tolerance in percent" },
    curve: { type: "word", words: ["valley", "bowl", "ramp"] },
    /** Where the line begins: without this option, at the beginning of the curve. */
    begin: { type: "word", words: ["slope"] },
    /** With this option, the reader can choose which size counts. */
    rule: { type: "word", words: ["middle", "start"] },
    /** What is shown first: the present side with its averagings, all sides of the walk, or the finished division. */
    show: { type: "word", words: ["side", "walk", "division"] },
    /** At which step the figure opens; without this option, at the one that it shows. */
    at: { type: "word", words: ["end"] },
  },
  values: {
    step: "number",
    steps: "number",
    beat: "number",
    x0: "number",
    dx0: "number",
    dx1: "number",
    apart: "number",
    mean: "number",
    length: "number",
    rounds: "number",
    slope: "number",
    shrink: "number",
    sides: "number",
    lambda: "number",
    count: "number",
    factor: "number",
    excess: "number",
    handled: "number",
    finished: "number",
    chosen: "text",
  },
  states: {
    step: { words: ["last", "end"], takesNumber: true },
    beat: { words: [], takesNumber: true },
    curve: { words: ["valley", "bowl", "ramp"], takesNumber: false },
    rule: { words: ["middle", "start"], takesNumber: false },
    x: { words: [], takesNumber: true },
  },
  marks: {
    curve: "plain",
    start: "active",
    guess: "active",
    middle: "new",
    apart: "refused",
    triangle: "new",
    sides: "plain",
  },
};
