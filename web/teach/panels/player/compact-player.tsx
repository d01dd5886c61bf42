import {
  IconPlayerPauseFilled,
  IconPlayerPlayFilled,
  IconPlayerSkipForwardFilled,
  IconPlayerTrackNextFilled,
  IconPlayerTrackPrevFilled,
} from "@tabler/icons-react";
import { frontSizeAt, phaseAt } from "../../player/phases";
import { playerStrings } from "../../strings/player";
import { IconButton } from "../../../ui/icon-button";
import { StepBars } from "./beat-bar";
import { JumpControl } from "./jump-control";
import styles from "./player.module.css";
import { ScrubBar } from "./scrub-bar";
import { StillsHint } from "./transport";
import { useFrontPlayer, usePlayer, useToldStep, useTrace } from "./use-player";

const texts = playerStrings;
const icon = { size: 15, "aria-hidden": true } as const;

/** The player without choices of colours and without the lens, for little room. Use it only with a trace. */
export function CompactPlayer() {
  const player = useFrontPlayer();
  const trace = useTrace();
  const step = useToldStep();
  const isPlaying = usePlayer((state) => state.isPlaying);
  const { phase, from, to } = phaseAt(trace, step);
  return (
    <>
      <ScrubBar />
      <StepBars />
      <div className={styles["row"]}>
        <span className={styles["buttons"]}>
          <IconButton label={texts.back} data-testid="player-back" onClick={() => player.move(-1)}>
            <IconPlayerTrackPrevFilled {...icon} />
          </IconButton>
          <IconButton
            label={isPlaying ? texts.pause : texts.play}
            data-testid="player-play"
            onClick={() => player.toggle()}
          >
            {isPlaying ? <IconPlayerPauseFilled {...icon} /> : <IconPlayerPlayFilled {...icon} />}
          </IconButton>
          <IconButton label={texts.forward} data-testid="player-forward" onClick={() => player.move(1)}>
            <IconPlayerTrackNextFilled {...icon} />
          </IconButton>
          <IconButton label={texts.end} data-testid="player-end" onClick={() => player.move(Infinity)}>
            <IconPlayerSkipForwardFilled {...icon} />
          </IconButton>
        </span>
        <span>
          {trace.surface && `${texts.phases[phase]} `}
          {texts.counter(step - from, to - from)}, {texts.faces(phase, frontSizeAt(trace, step))}
        </span>
        <StillsHint />
        <JumpControl />
      </div>
    </>
  );
}
