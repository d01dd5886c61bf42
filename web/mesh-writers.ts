/** Loaded when a mesh is first saved. */
export { fileMeshOf, writeMesh } from "tetrafront";
