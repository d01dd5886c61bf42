import { useCallback, useState } from "react";
import type { Trace } from "tetrafront";

/** Returns the answers by step of a trace, and a function that adds one. Another trace begins without answers. */
export function useAnswers<Answer>(
  trace: Trace,
): readonly [ReadonlyMap<number, Answer>, (step: number, answer: Answer) => void] {
  const [kept, setKept] = useState<{ readonly trace: Trace; readonly answers: ReadonlyMap<number, Answer> }>({
    trace,
    answers: new Map(),
  });
  const add = useCallback(
    (step: number, answer: Answer): void =>
      setKept((before) => ({
        trace,
        answers: new Map(before.trace === trace ? before.answers : []).set(step, answer),
      })),
    [trace],
  );
  return [kept.trace === trace ? kept.answers : noAnswers, add];
}

const noAnswers: ReadonlyMap<number, never> = new Map<number, never>();
