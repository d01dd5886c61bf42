import { CoverDialog, ProposeDialog } from "./background-dialogs";
import { CommandPalette } from "./command-palette";
import { CreatePlaceDialog } from "./create-dialogs";
import { HelpDialog, MessageDialog } from "./dialogs";
import { Notices } from "./notices";
import { RecentDialog } from "./recent-dialog";

/** Everything that opens above the page; loaded after it. */
export default function Overlays() {
  return (
    <>
      <CommandPalette />
      <HelpDialog />
      <CreatePlaceDialog kind="point" />
      <CreatePlaceDialog kind="background-node" />
      <CoverDialog />
      <ProposeDialog />
      <RecentDialog />
      <MessageDialog />
      <Notices />
    </>
  );
}
