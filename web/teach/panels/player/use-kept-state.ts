import { useCallback, useState } from "react";
import type { Trace } from "tetrafront/trace";

const kept = new WeakMap<Trace, Map<string, unknown>>();

/**
 * State of a panel about a trace, kept when the panel is made again in another place: the lens moves when the layout changes.
 * Another trace begins with `initial`. `name` must be unique among the panels of a trace.
 */
export function useKeptState<Value>(
  trace: Trace,
  name: string,
  initial: Value,
): readonly [Value, (value: Value) => void] {
  const [, draw] = useState(0);
  const set = useCallback(
    (value: Value): void => {
      const ofTrace = kept.get(trace) ?? new Map<string, unknown>();
      kept.set(trace, ofTrace.set(name, value));
      draw((count) => count + 1);
    },
    [trace, name],
  );
  const ofTrace = kept.get(trace);
  // Only values of `set` are kept under the name.
  return [ofTrace?.has(name) ? (ofTrace.get(name) as Value) : initial, set];
}
