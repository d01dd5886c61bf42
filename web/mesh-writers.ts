/** Loaded when a mesh is first saved. */
export { MESH_WRITERS } from "tetrafront";
