import { Button } from "@mantine/core";
import { useEffect, useRef } from "react";
import { playerStrings } from "../../strings/player";
import { isFocusLost } from "../../../ui/use-focus-return";
import { useFrontPlayer, usePlayer } from "../player/use-player";

interface StopRunProps {
  readonly testId: string;
  readonly onStop?: () => void;
}

/**
 * Stops the run of a lesson that is being recorded. The runs before it stay. When the run has ended, the focus of a button
 * that was pressed returns to the one that began the run, which stands before it.
 */
export function StopRun({ testId, onStop }: StopRunProps) {
  const button = useRef<HTMLButtonElement>(null);
  const isPressed = useRef(false);
  useEffect(() => {
    const begin = button.current?.previousElementSibling;
    return () => {
      if (isPressed.current && begin instanceof HTMLElement && isFocusLost()) setTimeout(() => begin.focus());
    };
  }, []);
  const player = useFrontPlayer();
  const recording = usePlayer((state) => state.recording);
  return (
    <Button
      ref={button}
      size="compact-xs"
      variant="default"
      ml={6}
      disabled={recording?.isStopping ?? true}
      data-testid={testId}
      onClick={() => {
        isPressed.current = true;
        onStop?.();
        player.stopRecording();
      }}
    >
      {playerStrings.stop}
    </Button>
  );
}
