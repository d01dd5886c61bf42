/** The panels of the front, in one file that is loaded after the first picture. */
export { FrontPanel } from "./front-panel";
export { Lens } from "./lens";
