import type { FigureDeclaration } from "./declaration.ts";
import { crossingDeclaration } from "./figures/crossing/declaration.ts";
import { crossingSpaceDeclaration } from "./figures/crossing-space/declaration.ts";
import { frontDeclaration } from "./figures/front/declaration.ts";
import { idealDeclaration } from "./figures/ideal/declaration.ts";
import { mesherDeclaration } from "./figures/mesher/declaration.ts";
import { pocketDeclaration } from "./figures/pocket/declaration.ts";
import { raceDeclaration } from "./figures/race/declaration.ts";
import { sidesDeclaration } from "./figures/sides/declaration.ts";
import { sliverDeclaration } from "./figures/sliver/declaration.ts";
import { stallDeclaration } from "./figures/stall/declaration.ts";
import { sweepsDeclaration } from "./figures/sweeps/declaration.ts";

/** Every kind of figure, by the name that lessons use. */
export const declarations: Readonly<Record<string, FigureDeclaration>> = {
  front: frontDeclaration,
  sides: sidesDeclaration,
  ideal: idealDeclaration,
  crossing: crossingDeclaration,
  "crossing-space": crossingSpaceDeclaration,
  mesher: mesherDeclaration,
  pocket: pocketDeclaration,
  stall: stallDeclaration,
  sliver: sliverDeclaration,
  sweeps: sweepsDeclaration,
  race: raceDeclaration,
};
