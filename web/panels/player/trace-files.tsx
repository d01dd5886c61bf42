import { Button, FileButton } from "@mantine/core";
import { strings } from "../../strings";
import { useApp } from "../shared/app-context";

/** Chooses a trace file and shows it. */
export function OpenTrace() {
  const app = useApp();
  const open = (file: File | null): void => {
    if (file) void file.arrayBuffer().then((content) => app.player.open(new Uint8Array(content)));
  };
  return (
    <FileButton accept=".tft" onChange={open} inputProps={{ "aria-label": strings.player.open }}>
      {(props) => (
        <Button {...props} size="compact-sm" variant="default" data-testid="player-open">
          {strings.player.open}
        </Button>
      )}
    </FileButton>
  );
}
