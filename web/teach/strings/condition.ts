/** Texts about conditions at which the player pauses. */

/** What is wrong in the text of a condition, as `ConditionError` of the player. */
interface Mismatch {
  readonly expected: "condition" | "number" | "index" | "relation" | "reason" | "end";
  readonly found: string;
  readonly at: number;
}

const expected: Readonly<Record<Mismatch["expected"], string>> = {
  condition:
    "a condition: size, layer, candidates, front, face, edge, node, element, patch, line, refused, behind, crosses, too close, same node, outside, accepted, postponed, new node or recovery",
  number: "a number",
  index: "a number such as 214",
  relation: "<, <=, >, >= or =",
  reason: "a reason: behind, crosses, too close, same node or outside",
  end: "and, or, or the end",
};

export const conditionStrings = {
  label: "Condition",
  placeholder: "size < 0.02",
  hint: "Such as face 214, size < 0.02, or refused: crosses and candidates > 3. Enter jumps to the next, Shift+Enter to the previous one.",
  error: ({ expected: what, found, at }: Mismatch) =>
    found === ""
      ? `At the end: expected ${expected[what]}.`
      : `At character ${at + 1}: expected ${expected[what]}, found “${found}”.`,
};
