import { Button } from "@mantine/core";
import { strings } from "../../strings";
import { usePlayer } from "../player/use-player";
import { useApp } from "../shared/app-context";

/** Stops the run of a lesson that is being recorded. The runs before it stay. */
export function StopRun({ testId }: { readonly testId: string }) {
  const { player } = useApp();
  const recording = usePlayer((state) => state.recording);
  return (
    <Button
      size="compact-xs"
      variant="default"
      ml={6}
      disabled={recording?.isStopping ?? true}
      data-testid={testId}
      onClick={() => player.stopRecording()}
    >
      {strings.player.stop}
    </Button>
  );
}
