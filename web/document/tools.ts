/** The tools of the view, in the order of their buttons. */
export const toolNames = ["select", "point", "line", "patch", "node", "source", "move", "measure"] as const;

/** What the left button and the keys do in the view. */
export type ToolName = (typeof toolNames)[number];

/** What the handles of the move tool do, in the order of their buttons. */
export const handleModes = ["translate", "rotate", "scale"] as const;
export type HandleMode = (typeof handleModes)[number];

/** What the app must know of a tool. */
interface ToolKind {
  /** Whether clicks pick places. */
  readonly isDrawing: boolean;
  /** Whether places that hit nothing lie in the work plane. */
  readonly usesWorkPlane: boolean;
  /** Whether it adds to the project, so that an open operation must be closed first. */
  readonly adds: boolean;
}

const chooses: ToolKind = { isDrawing: false, usesWorkPlane: true, adds: false };
const draws: ToolKind = { isDrawing: true, usesWorkPlane: true, adds: true };

export const toolKinds: Readonly<Record<ToolName, ToolKind>> = {
  select: chooses,
  point: draws,
  line: draws,
  patch: { ...draws, usesWorkPlane: false },
  node: draws,
  source: draws,
  move: chooses,
  measure: { ...draws, adds: false },
};

export const isDrawingTool = (tool: ToolName): boolean => toolKinds[tool].isDrawing;

/** What the pointer snaps to, beside points and lines. */
export interface Snapping {
  readonly grid: boolean;
  readonly model: boolean;
  readonly patches: boolean;
}

/** Ways to draw a circle. */
export const circleWays = ["centre", "points"] as const;
export type CircleBy = (typeof circleWays)[number];
