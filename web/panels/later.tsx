import { lazy, type ComponentType } from "react";
import { loadFileDialogs } from "../session/files";

const load = () => import("./later-panels");

/** Long enough for the first picture and the first mesh to have the line for themselves. */
const aheadMs = 1500;

/** Fetches what comes later while there is nothing to do: it opens at once, and without a network too. */
export function fetchAhead(): () => void {
  const timer = setTimeout(() => {
    // What fails now is asked for again when it is wanted, and told then.
    for (const later of [load, loadFileDialogs]) later().catch(() => undefined);
  }, aheadMs);
  return () => clearTimeout(timer);
}

type Panels = Awaited<ReturnType<typeof load>>;

/** A panel of those that come after the first picture. */
function later<Name extends keyof Panels>(name: Name) {
  return lazy(async () => ({ default: (await load())[name] as ComponentType<PropsOf<Panels[Name]>> }));
}

type PropsOf<Panel> = Panel extends (props: infer Props) => unknown ? Props : never;

export const DisplayPanel = later("DisplayPanel");
export const EntityCard = later("EntityCard");
export const GalleryPanel = later("GalleryPanel");
export const QualityReport = later("QualityReport");
