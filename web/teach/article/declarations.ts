import type { FigureDeclaration } from "./declaration";
import { crossingDeclaration } from "./figures/crossing/declaration";
import { crossingSpaceDeclaration } from "./figures/crossing-space/declaration";
import { frontDeclaration } from "./figures/front/declaration";
import { idealDeclaration } from "./figures/ideal/declaration";
import { pocketDeclaration } from "./figures/pocket/declaration";
import { stallDeclaration } from "./figures/stall/declaration";

/** Every kind of figure, by the name that lessons use. */
export const declarations: Readonly<Record<string, FigureDeclaration>> = {
  front: frontDeclaration,
  ideal: idealDeclaration,
  crossing: crossingDeclaration,
  "crossing-space": crossingSpaceDeclaration,
  pocket: pocketDeclaration,
  stall: stallDeclaration,
};
