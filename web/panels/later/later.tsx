import { lazy, type ComponentType } from "react";
import type { App } from "../../app/app";
import { loadFileDialogs } from "../../session/files";
import { untilState } from "../../session/until-state";
import type { Slots } from "../shared/slots";

const load = () => import("./later-panels");

/** Delay in milliseconds that leaves the connection to the first picture, and to a run that begins with the page. */
const aheadMs = 1500;

/**
 * Fetches the later panels in advance, so that they open immediately, also without a network: after the first mesh, which needs the
 * connection for the engine.
 */
export function fetchAhead(app: App, { load: loadSlots }: Slots): () => void {
  let isUnmounted = false;
  const fetchAll = async (): Promise<void> => {
    await untilState(app.run.state, ({ busy }) => !busy);
    if (isUnmounted) return;
    // A failed request is repeated, and its failure shown, when the user opens the panel.
    for (const later of [load, loadFileDialogs, loadSlots]) later().catch(() => undefined);
  };
  const timer = setTimeout(() => void fetchAll(), aheadMs);
  return () => {
    isUnmounted = true;
    clearTimeout(timer);
  };
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
export const AdaptDialog = later("AdaptDialog");
export const SolutionPanel = later("SolutionPanel");
