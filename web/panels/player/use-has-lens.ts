import { useShell } from "../shared/app-context";
import { useLayout } from "../shared/use-layout";
import { usePlayer } from "./use-player";

/**
 * Returns whether the lens has a tab at the left, where it is high enough for its formulas. On small screens and in presenter
 * mode it is beside the player.
 */
export function useHasLens(): boolean {
  const layout = useLayout();
  const isPresenting = useShell((state) => state.isPresenting);
  const hasTrace = usePlayer((state) => state.trace !== null);
  return hasTrace && layout === "wide" && !isPresenting;
}
