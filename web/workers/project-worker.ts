/** Reads and writes large project files. The page starts one worker per file and ends it afterwards. */
import { readProject } from "tetrafront";
import { packedGrid, unpackGrid } from "../document/packed-grid";
import { projectBlob, type ProjectProtocol } from "./project-files";
import { serveCalls } from "./serve-calls";

serveCalls<ProjectProtocol>({
  read: async (file) => {
    const result = readProject(await file.text());
    if (!result.success) return { answer: { result, grid: null } };
    const { background } = result.value;
    const value = { ...result.value, background: { ...background, nodes: [], tetrahedra: [] } };
    const grid = packedGrid(background);
    const transfer = [grid.nodes.buffer as ArrayBuffer, grid.tetrahedra.buffer as ArrayBuffer];
    return { answer: { result: { success: true, value }, grid }, transfer };
  },
  write: async ({ project, grid }) => {
    const background = { ...project.background, ...(await unpackGrid(grid)) };
    return { answer: projectBlob({ ...project, background }) };
  },
});
