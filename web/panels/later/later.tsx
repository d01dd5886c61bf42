import { lazy, type ComponentType } from "react";
import { loadFileDialogs } from "../../session/files";
import type { Slots } from "../shared/slots";

const load = () => import("./later-panels");

/** Delay in milliseconds that leaves the connection to the first picture and the first mesh. */
const aheadMs = 1500;

/** Fetches the later panels in advance, so that they open immediately, also without a network. */
export function fetchAhead({ load: loadSlots }: Slots): () => void {
  const timer = setTimeout(() => {
    // A failed request is repeated, and its failure shown, when the user opens the panel.
    for (const later of [load, loadFileDialogs, loadSlots]) later().catch(() => undefined);
  }, aheadMs);
  return () => clearTimeout(timer);
}

type Panels = Awaited<ReturnType<typeof load>>;

/** Returns a panel that is loaded after the first picture. */
function later<Name extends keyof Panels>(name: Name) {
  return lazy(async () => ({ default: (await load())[name] as ComponentType<PropsOf<Panels[Name]>> }));
}

type PropsOf<Panel> = Panel extends (props: infer Props) => unknown ? Props : never;

export const DisplayPanel = later("DisplayPanel");
export const EntityCard = later("EntityCard");
export const GalleryPanel = later("GalleryPanel");
export const QualityReport = later("QualityReport");
export const GroupList = later("GroupList");
export const HistoryList = later("HistoryList");
export const SelectionCard = later("SelectionCard");
