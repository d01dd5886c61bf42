/** The file formats, loaded when a file is opened. */
export { extensionsFor, formatOf } from "tetrafront";
