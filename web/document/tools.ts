/** The tools of the view, in the order of their buttons. */
export const toolNames = ["select", "point", "line", "patch", "node", "source", "move", "measure"] as const;

/** What the left button and the keys do in the view. */
export type ToolName = (typeof toolNames)[number];

/** What the handles of the move tool do, in the order of their buttons. */
export const handleModes = ["translate", "rotate", "scale"] as const;
export type HandleMode = (typeof handleModes)[number];

/** The tools that place something in the work plane. */
export const isDrawingTool = (tool: ToolName): boolean => tool !== "select" && tool !== "move";

/** What the pointer snaps to, beside points and lines. */
export interface Snapping {
  readonly grid: boolean;
  readonly model: boolean;
  readonly patches: boolean;
}

/** Ways to draw a circle. */
export const circleWays = ["centre", "points"] as const;
export type CircleBy = (typeof circleWays)[number];
