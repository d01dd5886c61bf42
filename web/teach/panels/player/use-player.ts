import { useThrottledValue } from "@mantine/hooks";
import { useEffect, useRef, useState } from "react";
import { useStore } from "zustand";
import type { Trace } from "tetrafront/trace";
import { playerOf } from "../../commands/player-of";
import { phaseAt } from "../../player/phases";
import type { Player, PlayerState } from "../../player/player";
import type { Viewer } from "../../../viewer/viewer";
import { useApp } from "../../../panels/shared/app-context";

/** Texts that follow the step change no more often, in milliseconds: they cannot be read faster, and painting them takes long. */
const toldEveryMs = 250;
/** How long the front must have been in a patch or out of it until the plane opens or closes: this changes the size of the view. */
const planeAfterMs = 200;

/** Returns the player of the app. */
export function useFrontPlayer(): Player {
  return playerOf(useApp());
}

export function usePlayer<T>(select: (state: PlayerState) => T): T {
  return useStore(useFrontPlayer().state, select);
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
function useShowsPlane(): boolean {
  const player = useFrontPlayer();
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

/** Returns whether the plane is shown, and fits the model to the view again when it takes half of the width, or gives it back. */
export function useBesidePlane(viewer: Viewer | null): boolean {
  const player = useFrontPlayer();
  const showsPlane = useShowsPlane();
  const before = useRef(showsPlane);
  useEffect(() => {
    if (before.current === showsPlane) return undefined;
    before.current = showsPlane;
    // The view is at the base edge.
    if (player.state.getState().follows) return undefined;
    // The canvas gets its new size in the next frame.
    let frame = requestAnimationFrame(() => {
      frame = requestAnimationFrame(() => viewer?.framing.fit(null));
    });
    return () => cancelAnimationFrame(frame);
  }, [viewer, player, showsPlane]);
  return showsPlane;
}
