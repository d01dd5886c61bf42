/** What the questions of "Be the mesher" have in common, in the plane and in the volume. */
import { expect } from "vitest";
import type { GameLevel } from "../../web/teach/player/mesher-game";

interface Question {
  readonly nodes: readonly number[];
  readonly program: number | null;
  readonly step: { readonly candidates: readonly { readonly verdict: string }[] };
}

/** The nodes of the base and of the front in the state of a question. */
interface Around {
  readonly base: readonly number[];
  readonly front: ReadonlySet<number>;
}

/** Checks that the answer is among the choices, and that the question is as hard as its level says. */
export function expectFair(
  { nodes, program, step }: Question,
  level: GameLevel,
  { base, front }: Around,
): void {
  expect(nodes.every((node) => front.has(node) && !base.includes(node))).toBe(true);
  expect(new Set(nodes).size).toBe(nodes.length);
  if (program !== null) expect(nodes).toContain(program);
  const refused = step.candidates.filter(({ verdict }) => verdict !== "accepted").length;
  if (level === "easy") expect(refused).toBe(0);
  if (level === "hard") expect(refused).toBeGreaterThan(0);
}
