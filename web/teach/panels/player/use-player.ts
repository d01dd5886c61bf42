import { useThrottledValue } from "@mantine/hooks";
import { useEffect, useState } from "react";
import { useStore } from "zustand";
import type { Trace } from "tetrafront/trace";
import { phaseAt } from "../../player/phases";
import type { PlayerState } from "../../player/player";
import { useApp } from "../../../panels/shared/app-context";

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

const isInPatch = ({ trace, step }: PlayerState): boolean =>
  trace !== null && step < 0 && phaseAt(trace, step).phase === "patches";

/** Whether the plane is shown in which the front of a patch advances. While states are scrubbed, it neither opens nor closes. */
export function useShowsPlane(): boolean {
  const { player } = useApp();
  const hasTrace = usePlayer(({ trace }) => trace !== null);
  const [wasInPatch, setWasInPatch] = useState(() => isInPatch(player.state.getState()));
  useEffect(() => {
    // Outside React: the view has nothing to render until the plane opens or closes.
    let [timer, last]: [ReturnType<typeof setTimeout> | undefined, boolean | null] = [undefined, null];
    const follow = (state: PlayerState): void => {
      const now = isInPatch(state);
      if (now === last) return;
      last = now;
      clearTimeout(timer);
      timer = setTimeout(() => setWasInPatch(now), planeAfterMs);
    };
    follow(player.state.getState());
    const stop = player.state.subscribe(follow);
    return () => {
      clearTimeout(timer);
      stop();
    };
  }, [player]);
  return hasTrace && wasInPatch;
}
