import type { Figure } from "../kit/figure";

/** Loads each kind of figure when it is near the window. */
export const figureLoaders: Readonly<Record<string, () => Promise<Figure>>> = {
  front: async () => new (await import("./front/front-figure")).FrontFigure(),
  sides: async () => new (await import("./sides/sides-figure")).SidesFigure(),
  ideal: async () => new (await import("./ideal/ideal-figure")).IdealFigure(),
  crossing: async () => new (await import("./crossing/crossing-figure")).CrossingFigure(),
  "crossing-space": async () =>
    new (await import("./crossing-space/crossing-space-figure")).CrossingSpaceFigure(),
  race: async () => new (await import("./race/race-figure")).RaceFigure(),
};
