import { useState } from "react";

/** Returns the direction of the last change of the state: 1 forward, -1 back; 1 at first. */
export function useDirection(state: number): 1 | -1 {
  const [last, setLast] = useState<{ readonly state: number; readonly direction: 1 | -1 }>({
    state,
    direction: 1,
  });
  if (state === last.state) return last.direction;
  const direction = state < last.state ? -1 : 1;
  setLast({ state, direction });
  return direction;
}
