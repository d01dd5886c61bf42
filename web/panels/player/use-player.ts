import { useStore } from "zustand";
import type { Trace } from "tetrafront";
import type { PlayerState } from "../../player/player";
import { useApp } from "../shared/app-context";

export function usePlayer<T>(select: (state: PlayerState) => T): T {
  return useStore(useApp().player.state, select);
}

/** The trace that is shown; use it only in panels of a trace. */
export function useTrace(): Trace {
  const trace = usePlayer((state) => state.trace);
  if (!trace) throw new Error("A panel of a trace was used without one");
  return trace;
}
