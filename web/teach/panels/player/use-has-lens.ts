import { useMediaQuery } from "@mantine/hooks";
import { useShell } from "../../../panels/shared/app-context";
import { useLayout } from "../../../panels/shared/use-layout";
import { usePlayer } from "./use-player";

/** From this width on, there is room for the enlarged lens of presenter mode beside the view. */
const roomForAudience = "(min-width: 1280px)";

/**
 * Returns whether the lens is at the left, where it is high enough for its formulas: as a tab, or alone in presenter mode. On small
 * screens it is beside the player.
 */
export function useHasLens(): boolean {
  const layout = useLayout();
  const hasRoom = useMediaQuery(roomForAudience, undefined, { getInitialValueInEffect: false });
  const isPresenting = useShell((state) => state.isPresenting);
  const hasTrace = usePlayer((state) => state.trace !== null);
  return hasTrace && layout === "wide" && (!isPresenting || hasRoom === true);
}
