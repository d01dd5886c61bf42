/** Loaded when a file is to be opened that is no project by its name. */
export { formatOf } from "tetrafront";
