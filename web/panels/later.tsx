import { lazy, type ComponentType } from "react";

const load = () => import("./later-panels");

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
