/** What is behind a tab or a selection, in one piece: loaded after the first picture. */
export { DisplayPanel } from "./display-panel";
export { EntityCard } from "./entity-card";
export { GalleryPanel } from "./gallery";
export { QualityReport } from "./quality-report";
