import { playerOf } from "../../commands/player-of";
import { Button, FileButton } from "@mantine/core";
import { IconFolderOpen } from "@tabler/icons-react";
import { playerStrings } from "../../strings/player";
import { IconButton } from "../../../ui/icon-button";
import { useApp } from "../../../panels/shared/app-context";

const label = playerStrings.open;

/** Chooses a trace file and shows it. `isSmall`: an icon instead of a text. */
export function OpenTrace({ isSmall = false }: { readonly isSmall?: boolean }) {
  const app = useApp();
  const open = (file: File | null): void => {
    if (file) void file.arrayBuffer().then((content) => playerOf(app).open(new Uint8Array(content)));
  };
  return (
    <FileButton accept=".tft" onChange={open} inputProps={{ "aria-label": label }}>
      {(props) =>
        isSmall ? (
          <IconButton {...props} label={label} data-testid="player-open">
            <IconFolderOpen size={15} aria-hidden />
          </IconButton>
        ) : (
          <Button {...props} size="compact-sm" variant="default" data-testid="player-open">
            {label}
          </Button>
        )
      }
    </FileButton>
  );
}
