/** Names of the patches of new solid pieces. */
const patches = {
  bottom: "bottom",
  top: "top",
  front: "front",
  back: "back",
  left: "left",
  right: "right",
  side: "side",
  tip: "tip",
  root: "root",
  upper: "upper",
  lower: "lower",
  start: "start",
  end: "end",
  numbered: (name: string, number: number) => `${name} ${number}`,
} as const;

/** Texts about solid pieces. */
export const pieceStrings = { patches } as const;
