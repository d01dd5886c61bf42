import type { FigureDeclaration } from "../../declaration.ts";

/** The nodes of one front in a list, a quadtree and a hash grid, which answer one question. */
export const searchDeclaration: FigureDeclaration = {
  label: "One question to a list, a quadtree and a hash grid",
  options: {
    nodes: { type: "number", label: "number of nodes" },
    radius: { type: "number", label: "radius of the circle" },
  },
  values: {
    list: "number",
    quadtree: "number",
    grid: "number",
    share: "number",
    found: "number",
    cells: "number",
    depth: "number",
    x: "number",
    y: "number",
    handled: "number",
  },
  states: {
    at: { words: ["bay", "bow", "middle"], takesNumber: false },
    nodes: { words: [], takesNumber: true },
    radius: { words: [], takesNumber: true },
  },
  marks: { visited: "active", cells: "active", found: "new", front: "plain", chart: "plain" },
};

/** The nodes of a front in space, in a list, an octree and a hash grid. */
export const searchSpaceDeclaration: FigureDeclaration = {
  label: "One question in space, to a list, an octree and a hash grid",
  options: {
    parts: { type: "number", label: "parts of a side" },
    radius: { type: "number", label: "radius of the ball" },
  },
  values: {
    list: "number",
    octree: "number",
    grid: "number",
    share: "number",
    found: "number",
    opened: "number",
    nodes: "number",
    x: "number",
    y: "number",
    z: "number",
    handled: "number",
  },
  states: {
    at: { words: ["wall", "bay", "hollow"], takesNumber: false },
    show: { words: ["list", "octree", "grid"], takesNumber: false },
    parts: { words: [], takesNumber: true },
    radius: { words: [], takesNumber: true },
  },
  marks: { visited: "active", cells: "active", found: "new", front: "plain" },
};

/** A front that takes its shortest side, and the heap that tells which. */
export const heapDeclaration: FigureDeclaration = {
  label: "A front and the heap of its sides",
  options: {},
  values: {
    step: "number",
    steps: "number",
    beat: "number",
    sides: "number",
    rows: "number",
    compared: "number",
    list: "number",
    allcompared: "number",
    alllist: "number",
    cheaper: "number",
    finished: "number",
    handled: "number",
  },
  states: {
    step: { words: ["middle", "end"], takesNumber: true },
    beat: { words: [], takesNumber: true },
  },
  marks: { top: "active", front: "plain", new: "new" },
};
