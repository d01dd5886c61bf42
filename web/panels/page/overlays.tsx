import { CommandPalette } from "../dialogs/command-palette";
import { CoverDialog } from "../background/cover-dialog";
import { CreatePositionedDialog } from "../dialogs/create-dialogs";
import { ExportDialog } from "../dialogs/export-dialog";
import { HelpDialog } from "../help/help-dialog";
import { MessageDialog } from "../dialogs/message-dialog";
import { Presenter } from "../dialogs/presenter";
import { ProposeDialog } from "../background/propose-dialog";
import { RecentDialog } from "../files/recent-dialog";
import { UnitDialog } from "../inspector/unit-dialog";
import { Notices } from "../dialogs/notices";
import { AdaptDialog } from "../later/later";
import { PanelBoundary } from "../shared/panel-boundary";
import { useShell } from "../shared/app-context";
import { useLayout } from "../shared/use-layout";
import { PictureDialog } from "../files/picture-dialog";
import { ShareDialog } from "../files/share-dialog";
import { TemplateDialog } from "../files/template-dialog";

/** Everything that opens above the page. Loaded after it. */
export default function Overlays() {
  return (
    <>
      <CommandPalette />
      <HelpDialog />
      <ExportDialog />
      <CreatePositionedDialog kind="point" />
      <CreatePositionedDialog kind="background-node" />
      <CoverDialog />
      <ProposeDialog />
      <RecentDialog />
      <TemplateDialog />
      <ShareDialog />
      <PictureDialog />
      <UnitDialog />
      {useShell(({ dialog }) => dialog === "adapt") && (
        <PanelBoundary floats>
          <AdaptDialog />
        </PanelBoundary>
      )}
      <MessageDialog />
      {/* On wide screens, they are in the view. Here they lie above drawers. */}
      {useLayout() !== "wide" && <Notices />}
      <Presenter />
    </>
  );
}
