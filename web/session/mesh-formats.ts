/** Loaded on demand, when the name of an opened file is not that of a project. */
export { formatOf } from "tetrafront";
