/** The panels behind tabs and selections, in one file that is loaded after the first picture. */
export { DisplayPanel } from "../viewport/display-panel";
export { EntityCard } from "../entities/entity-card";
export { GalleryPanel } from "../files/gallery";
export { QualityReport } from "../quality/quality-report";
export { GroupList } from "../entities/group-list";
export { HistoryList } from "../model/history-list";
export { SelectionCard } from "../entities/selection-card";
export { AdaptDialog } from "../solution/adapt-dialog";
export { SolutionPanel } from "../solution/solution-panel";
