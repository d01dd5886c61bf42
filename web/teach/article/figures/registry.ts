import type { Figure } from "../kit/figure";

/** Loads each kind of figure when it is near the window. */
export const figureLoaders: Readonly<Record<string, () => Promise<Figure>>> = {
  front: async () => new (await import("./front/front-figure")).FrontFigure(),
  ball: async () => new (await import("./ball/ball-figure")).BallFigure(),
  sides: async () => new (await import("./sides/sides-figure")).SidesFigure(),
  ideal: async () => new (await import("./ideal/ideal-figure")).IdealFigure(),
  candidates: async () => new (await import("./candidates/candidates-figure")).CandidatesFigure(),
  "candidates-space": async () => new (await import("./candidates/space-figure")).CandidatesSpaceFigure(),
  crossing: async () => new (await import("./crossing/crossing-figure")).CrossingFigure(),
  "crossing-space": async () =>
    new (await import("./crossing-space/crossing-space-figure")).CrossingSpaceFigure(),
  plate: async () => new (await import("./plate/plate-figure")).PlateFigure("truth"),
  "plate-spot": async () => new (await import("./plate/plate-figure")).PlateFigure("spot"),
  "plate-needles": async () => new (await import("./plate/plate-figure")).PlateFigure("needles"),
  mesher: async () => new (await import("./mesher/mesher-figure")).MesherFigure(),
  pocket: async () => new (await import("./pocket/pocket-figure")).PocketFigure(),
  stall: async () => new (await import("./stall/stall-figure")).StallFigure(),
  sliver: async () => new (await import("./sliver/sliver-figure")).SliverFigure(),
  sweeps: async () => new (await import("./sweeps/sweeps-figure")).SweepsFigure(),
  race: async () => new (await import("./race/race-figure")).RaceFigure(),
  surface: async () => new (await import("./surface/surface-figure")).SurfaceFigure(),
  search: async () => new (await import("./search/search-figure")).SearchFigure(),
  "search-space": async () => new (await import("./search/space-search-figure")).SpaceSearchFigure(),
  heap: async () => new (await import("./search/heap-figure")).HeapFigure(),
  stretching: async () => new (await import("./stretching/stretching-figure")).StretchingFigure(false),
  "stretching-field": async () => new (await import("./stretching/stretching-figure")).StretchingFigure(true),
};
