import { lazy, type ComponentType } from "react";
import { loadFileDialogs } from "../../session/files";

const load = () => import("./later-panels");

/** The lessons, with the libraries that render their text: loaded when the tab is opened. */
export const LessonsPanel = lazy(async () => ({
  default: (await import("../../teach/panels/lessons/lessons-panel")).LessonsPanel,
}));

/** Delay in milliseconds that leaves the connection to the first picture and the first mesh. */
const aheadMs = 1500;

/** Fetches the later panels in advance, so that they open immediately, also without a network. */
export function fetchAhead(): () => void {
  const timer = setTimeout(() => {
    // A failed request is repeated, and its failure shown, when the user opens the panel.
    for (const later of [load, loadFileDialogs]) later().catch(() => undefined);
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
export const FrontPanel = later("FrontPanel");
export const GalleryPanel = later("GalleryPanel");
export const Lens = later("Lens");
export const QualityReport = later("QualityReport");
export const GroupList = later("GroupList");
export const HistoryList = later("HistoryList");
export const SelectionCard = later("SelectionCard");
