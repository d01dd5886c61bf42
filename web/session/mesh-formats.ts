/** The file formats, loaded when a file is opened. */
export { extensionsFor, FILE_FORMATS, formatOf } from "tetrafront";
