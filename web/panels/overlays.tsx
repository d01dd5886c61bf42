import { CommandPalette } from "./command-palette";
import { CoverDialog } from "./cover-dialog";
import { CreatePositionedDialog } from "./create-dialogs";
import { HelpDialog } from "./help-dialog";
import { MessageDialog } from "./message-dialog";
import { Notices } from "./notices";
import { ProposeDialog } from "./propose-dialog";
import { RecentDialog } from "./recent-dialog";

/** Everything that opens above the page. Loaded after it. */
export default function Overlays() {
  return (
    <>
      <CommandPalette />
      <HelpDialog />
      <CreatePositionedDialog kind="point" />
      <CreatePositionedDialog kind="background-node" />
      <CoverDialog />
      <ProposeDialog />
      <RecentDialog />
      <MessageDialog />
      <Notices />
    </>
  );
}
