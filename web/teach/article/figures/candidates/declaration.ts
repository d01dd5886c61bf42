import type { FigureDeclaration } from "../../declaration.ts";

const values = {
  ranked: "number",
  refused: "number",
  first: "text",
  accepted: "text",
  bestshape: "number",
  acceptedshape: "number",
  bestlost: "number",
  handled: "number",
} as const;

/** One side of a front in the plane: its candidates as fans, and as bars of the parts of their scores. */
export const candidatesDeclaration: FigureDeclaration = {
  label: "Candidates over one side of a front",
  options: { size: { type: "number", label: "length of the new sides" } },
  values: {
    ...values,
    newwins: "number",
    newshape: "number",
    away: "number",
    score: "number",
    newscore: "number",
    takesring: "number",
    takesnew: "number",
    takesnone: "number",
    acceptedscore: "number",
    acceptedaway: "number",
    crossed: "number",
    tooclose: "number",
  },
  states: {
    size: { words: [], takesNumber: true },
    pose: { words: ["near", "far", "blocked", "narrow"], takesNumber: false },
  },
  marks: { base: "active", ideal: "active", reach: "active", accepted: "new", refused: "refused" },
};

/** Steps of the front in a ball, as the engine has recorded them. The reader changes weights of the score, and the page ranks again. */
export const candidatesSpaceDeclaration: FigureDeclaration = {
  label: "Candidates over one face of a front in space",
  options: {
    newnode: { type: "number", label: "weight of a new node" },
    wedge: { type: "number", label: "what a candidate at an acute angle gets" },
    closing: { type: "number", label: "per cent for each closed side" },
  },
  values: {
    ...values,
    step: "number",
    steps: "number",
    newfactor: "number",
    ownweights: "number",
    changed: "number",
    newfirst: "number",
    wedges: "number",
    engine: "text",
    bestscore: "number",
    second: "text",
    secondscore: "number",
  },
  states: {
    step: { words: ["start", "wedge", "crossed", "new"], takesNumber: true },
    weights: { words: ["own"], takesNumber: false },
  },
  marks: { base: "active", ideal: "active", accepted: "new", refused: "refused" },
};
