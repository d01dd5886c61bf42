import type { Figure } from "../kit/figure";

/** Loads each kind of figure when it is near the window. */
export const figureLoaders: Readonly<Record<string, () => Promise<Figure>>> = {
  front: async () => new (await import("./front/front-figure")).FrontFigure(),
  sides: async () => new (await import("./sides/sides-figure")).SidesFigure(),
  ideal: async () => new (await import("./ideal/ideal-figure")).IdealFigure(),
  crossing: async () => new (await import("./crossing/crossing-figure")).CrossingFigure(),
  "crossing-space": async () =>
    new (await import("./crossing-space/crossing-space-figure")).CrossingSpaceFigure(),
  mesher: async () => new (await import("./mesher/mesher-figure")).MesherFigure(),
  pocket: async () => new (await import("./pocket/pocket-figure")).PocketFigure(),
  stall: async () => new (await import("./stall/stall-figure")).StallFigure(),
  sliver: async () => new (await import("./sliver/sliver-figure")).SliverFigure(),
  sweeps: async () => new (await import("./sweeps/sweeps-figure")).SweepsFigure(),
  race: async () => new (await import("./race/race-figure")).RaceFigure(),
};
