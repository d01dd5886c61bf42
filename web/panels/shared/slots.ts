import { createContext, useContext, type ComponentType } from "react";
import type { Viewer } from "../../viewer/viewer";

/** A tab among those of a panel. */
export interface TabSlot {
  readonly label: string;
  readonly Panel: ComponentType;
}

/** What the page shows of what can be played in the view. The app knows no more of what teaches (web/teach). */
export interface Slots {
  /** At the left, while it is offered; alone there in presenter mode. */
  readonly left: TabSlot & { readonly useIsOffered: () => boolean };
  readonly bottom: TabSlot;
  /** In the view, while a replay is shown. */
  readonly Overlay: ComponentType<{ readonly viewer: Viewer }>;
  /** The meaning of the colours of a replay. */
  readonly Legend: ComponentType;
  /** Takes half of the view while it is wanted. */
  readonly Beside: ComponentType;
  /** Returns whether `Beside` is wanted, and fits the model to the view when this changes. */
  readonly useBeside: (viewer: Viewer | null) => boolean;
  /** Loads the panels in advance. */
  readonly load: () => Promise<unknown>;
}

export const SlotsContext = createContext<Slots | null>(null);

export function useSlots(): Slots {
  const slots = useContext(SlotsContext);
  if (!slots) throw new Error("A panel was used outside the page");
  return slots;
}
