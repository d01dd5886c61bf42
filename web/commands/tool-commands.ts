import type { App } from "../app/app";
import { handleModes, type ToolName } from "../document/tools";
import { planeOfSelection, principalPlane, principalPlanes } from "../document/work-plane";
import { commandLabels, strings } from "../strings";
import { define, type Command, type MenuName } from "./command";
import { anyPatchMaker, createFrom, straightMaker, type Maker } from "./create-menu";
import { showRefusal } from "./messages";

const tool = (menu: MenuName, section: number, name: ToolName, key: string, run: (app: App) => void) =>
  define(menu, section)(`tool-${name}`, commandLabels.tools[name], run, {
    keys: [key],
    checked: (app) => app.view.state.getState().tool === name,
  });

const take =
  (name: ToolName) =>
  (app: App): void =>
    app.view.setTool(name);

/** Takes the move tool; if it is active, changes its handles. */
function takeMove(app: App): void {
  const { tool: active, handleMode } = app.view.state.getState();
  const next = handleModes[(handleModes.indexOf(handleMode) + 1) % handleModes.length];
  if (active === "move" && next) app.view.state.setState({ handleMode: next });
  else app.view.setTool("move");
}

/**
 * Creates from the selection, or shows what else to select, if at least two of the entities that the maker needs are
 * selected, or a single one that suffices; otherwise takes the tool that draws the same.
 */
const createOrTake =
  (name: ToolName, maker: Maker) =>
  (app: App): void => {
    const { tool, selection } = app.view.state.getState();
    const fits = selection.length > 0 && selection.every(({ kind }) => kind === maker.from);
    const isMeant = fits && (selection.length > 1 || maker.offer(app.documents.project, selection).possible);
    if (tool === "select" && isMeant) createFrom(app, maker);
    else app.view.setTool(name);
  };

/** Moves the work plane to the selection, or shows what to select. */
function takePlane(app: App): void {
  const { selection, workPlane } = app.view.state.getState();
  const plane = planeOfSelection(app.documents.project, selection, workPlane);
  if (plane) app.view.state.setState({ workPlane: plane });
  else showRefusal(app, commandLabels.planes.selection, strings.drawing.noPlane);
}

/** The tools that draw sizes: the background grid and sources. */
export const sizeTools: readonly Command[] = [
  tool("mesh", 2, "node", "N", take("node")),
  tool("mesh", 2, "source", "D", take("source")),
];

/** The tools of the view. Their buttons take them whatever is selected. */
export const toolCommands: readonly Command[] = [
  tool("edit", 3, "select", "V", take("select")),
  tool("edit", 3, "move", "G", takeMove),
  tool("edit", 3, "measure", "M", take("measure")),
  tool("create", 0, "point", "P", take("point")),
  tool("create", 0, "line", "L", createOrTake("line", straightMaker)),
  tool("create", 0, "patch", "A", createOrTake("patch", anyPatchMaker)),
  ...principalPlanes.map((plane) =>
    define("edit", 4)(
      `plane-${plane}`,
      commandLabels.planes[plane],
      (app) => app.view.state.setState({ workPlane: principalPlane(plane) }),
      { checked: (app) => app.view.state.getState().workPlane.kind === plane },
    ),
  ),
  define("edit", 4)("plane-selection", commandLabels.planes.selection, takePlane, { keys: ["W"] }),
  ...(["grid", "model", "patches"] as const).map((target) =>
    define("edit", 5)(
      `magnet-${target}`,
      commandLabels.snaps[target],
      ({ view }) =>
        view.state.setState(({ snapping }) => ({ snapping: { ...snapping, [target]: !snapping[target] } })),
      { checked: (app) => app.view.state.getState().snapping[target] },
    ),
  ),
];
