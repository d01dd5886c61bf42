import { useApp } from "./app-context";
import { CommandPalette } from "./command-palette";
import { CoverDialog } from "./cover-dialog";
import { CreatePositionedDialog } from "./create-dialogs";
import { HelpDialog } from "./help-dialog";
import { MessageDialog } from "./message-dialog";
import { Notices } from "./notices";
import { useIsLastUsed } from "./page-apps";
import { ProposeDialog } from "./propose-dialog";
import { RecentDialog } from "./recent-dialog";

/** Everything that opens above the page. Loaded after it. */
export default function Overlays() {
  // All apps of the page share the palette; its commands are for the one used last.
  const hasPalette = useIsLastUsed(useApp());
  return (
    <>
      {hasPalette && <CommandPalette />}
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
