import { useState } from "react";

/** Returns whether the last change of the state led forward or back. */
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
