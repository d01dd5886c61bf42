import { bodyStrings } from "./bodies";
import { drawingStrings } from "./drawing";
import { exportStrings } from "./export";
import { problemTitle } from "./mesh";
import { pageStrings } from "./page";
import { pieceStrings } from "./pieces";
import { panelStrings } from "./panels";
import { unitStrings } from "./units";

/** All texts that a user reads. The package words diagnostics and errors of files. */
export const strings = {
  ...pageStrings,
  ...panelStrings,
  drawing: drawingStrings,
  export: exportStrings,
  bodies: bodyStrings,
  pieces: pieceStrings,
  units: unitStrings,
  problemTitle,
} as const;

export { bodyStepNames, planText, preparedText } from "./bodies";
export * from "./commands";
export * from "./edits";
export * from "./entities";
export { exportStrings } from "./export";
export * from "./mesh";
export { fixStrings } from "./fixes";
export * from "./palette";
export { templateStrings } from "./templates";
export { operationStrings } from "./operations";
export { remedyInApp } from "./remedies";
