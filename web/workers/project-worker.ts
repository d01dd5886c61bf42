/** Reads and writes large project files. The page starts one worker per file and ends it afterwards. */
import { readProject } from "tetrafront/project";
import { packedGrid, unpackGrid } from "../document/packed-grid";
import { bodiesOf } from "../document/entities";
import { buffersOfPacked, packedBody } from "./packed-bodies";
import { projectBlob, type ProjectProtocol } from "./project-files";
import { serveCalls } from "./serve-calls";

serveCalls<ProjectProtocol>({
  read: async (file) => {
    const result = readProject(await file.text());
    if (!result.success) return { answer: { result, grid: null, bodies: [] } };
    const { background } = result.value;
    const bodies = bodiesOf(result.value).map(packedBody);
    const drawn = { ...result.value, background: { ...background, nodes: [], tetrahedra: [] } };
    const value = bodies.length > 0 ? { ...drawn, bodies: [] } : drawn;
    const grid = packedGrid(background);
    const ofGrid = [grid.nodes, grid.tetrahedra, ...(grid.seconds ? [grid.seconds] : [])].map(
      ({ buffer }) => buffer as ArrayBuffer,
    );
    const transfer = [...ofGrid, ...buffersOfPacked(bodies)];
    return { answer: { result: { success: true, value }, grid, bodies }, transfer };
  },
  write: async ({ project, grid }) => {
    const background = { ...project.background, ...(await unpackGrid(grid)) };
    return { answer: projectBlob({ ...project, background }) };
  },
});
