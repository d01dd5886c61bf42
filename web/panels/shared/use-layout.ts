import { useViewportSize } from "@mantine/hooks";
import { breakpoints } from "../../ui/theme/theme";

/** Wide: panels beside the view. Narrow: side panels in drawers. Phone: all panels in drawers. */
export type Layout = "wide" | "narrow" | "phone";

export function useLayout(): Layout {
  const { width } = useViewportSize();
  // Before the first measurement the width is 0.
  const known = width === 0 ? window.innerWidth : width;
  if (known < breakpoints.phone) return "phone";
  return known < breakpoints.sidePanels ? "narrow" : "wide";
}
