import { useCallback } from "react";
import type { Trace } from "tetrafront/trace";
import { useKeptState } from "./use-kept-state";

/** Returns the answers by step of a trace, and a function that adds one. Another trace begins without answers. */
export function useAnswers<Answer>(
  trace: Trace,
  game: "patch" | "volume",
): readonly [ReadonlyMap<number, Answer>, (step: number, answer: Answer) => void] {
  const [answers, setAnswers] = useKeptState<ReadonlyMap<number, Answer>>(
    trace,
    `${game}-answers`,
    noAnswers,
  );
  const add = useCallback(
    (step: number, answer: Answer): void => setAnswers(new Map(answers).set(step, answer)),
    [answers, setAnswers],
  );
  return [answers, add];
}

const noAnswers: ReadonlyMap<number, never> = new Map<number, never>();
