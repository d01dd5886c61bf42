import { useDebouncedValue, useThrottledValue } from "@mantine/hooks";
import { useStore } from "zustand";
import type { Trace } from "tetrafront";
import { phaseAt } from "../../player/phases";
import type { PlayerState } from "../../player/player";
import { useApp } from "../shared/app-context";

/** Texts that follow the step change no more often, in milliseconds: they cannot be read faster, and painting them takes long. */
const toldEveryMs = 250;
/** How long the front must have been in a patch or out of it until the plane opens or closes: this changes the size of the view. */
const planeAfterMs = 200;

export function usePlayer<T>(select: (state: PlayerState) => T): T {
  return useStore(useApp().player.state, select);
}

/** The trace that is shown; use it only in panels of a trace. */
export function useTrace(): Trace {
  const trace = usePlayer((state) => state.trace);
  if (!trace) throw new Error("A panel of a trace was used without one");
  return trace;
}

/** The step that is shown, for texts: while it changes fast, some are left out. */
export function useToldStep(): number {
  return useThrottledValue(
    usePlayer(({ step }) => step),
    toldEveryMs,
  );
}

/** Whether the plane is shown in which the front of a patch advances. While states are scrubbed, it neither opens nor closes. */
export function useShowsPlane(): boolean {
  const hasTrace = usePlayer(({ trace }) => trace !== null);
  const isInPatch = usePlayer(
    ({ trace, step }) => trace !== null && step < 0 && phaseAt(trace, step).phase === "patches",
  );
  const [showsPlane] = useDebouncedValue(isInPatch, planeAfterMs);
  return hasTrace && showsPlane;
}
