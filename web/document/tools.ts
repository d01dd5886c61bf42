/** The tools of the view, in the order of their buttons. */
export const toolNames = ["select", "point", "line", "patch", "move", "measure"] as const;

/** What the left button and the keys do in the view. */
export type ToolName = (typeof toolNames)[number];
