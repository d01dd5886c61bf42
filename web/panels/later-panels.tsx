/** The panels behind tabs and selections, in one file that is loaded after the first picture. */
export { DisplayPanel } from "./display-panel";
export { EntityCard } from "./entity-card";
export { GalleryPanel } from "./gallery";
export { QualityReport } from "./quality-report";
