import type { FigureDeclaration } from "./declaration.ts";
import { ballDeclaration } from "./figures/ball/declaration.ts";
import { candidatesDeclaration, candidatesSpaceDeclaration } from "./figures/candidates/declaration.ts";
import { crossingDeclaration } from "./figures/crossing/declaration.ts";
import { crossingSpaceDeclaration } from "./figures/crossing-space/declaration.ts";
import { frontDeclaration } from "./figures/front/declaration.ts";
import { idealDeclaration } from "./figures/ideal/declaration.ts";
import {
  plateDeclaration,
  plateNeedlesDeclaration,
  plateSpotDeclaration,
} from "./figures/plate/declaration.ts";
import { mesherDeclaration } from "./figures/mesher/declaration.ts";
import { pocketDeclaration } from "./figures/pocket/declaration.ts";
import { raceDeclaration } from "./figures/race/declaration.ts";
import { heapDeclaration, searchDeclaration, searchSpaceDeclaration } from "./figures/search/declaration.ts";
import { sidesDeclaration } from "./figures/sides/declaration.ts";
import { sliverDeclaration } from "./figures/sliver/declaration.ts";
import { stallDeclaration } from "./figures/stall/declaration.ts";
import { stretchingDeclaration, stretchingFieldDeclaration } from "./figures/stretching/declaration.ts";
import { surfaceDeclaration } from "./figures/surface/declaration.ts";
import { sweepsDeclaration } from "./figures/sweeps/declaration.ts";

/** Every kind of figure, by the name that lessons use. */
export const declarations: Readonly<Record<string, FigureDeclaration>> = {
  front: frontDeclaration,
  ball: ballDeclaration,
  sides: sidesDeclaration,
  ideal: idealDeclaration,
  candidates: candidatesDeclaration,
  "candidates-space": candidatesSpaceDeclaration,
  crossing: crossingDeclaration,
  "crossing-space": crossingSpaceDeclaration,
  plate: plateDeclaration,
  "plate-spot": plateSpotDeclaration,
  "plate-needles": plateNeedlesDeclaration,
  mesher: mesherDeclaration,
  pocket: pocketDeclaration,
  stall: stallDeclaration,
  sliver: sliverDeclaration,
  sweeps: sweepsDeclaration,
  race: raceDeclaration,
  surface: surfaceDeclaration,
  search: searchDeclaration,
  "search-space": searchSpaceDeclaration,
  heap: heapDeclaration,
  stretching: stretchingDeclaration,
  "stretching-field": stretchingFieldDeclaration,
};
