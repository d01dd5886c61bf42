import {
  IconPlayerSkipForwardFilled,
  IconPlayerTrackNextFilled,
  IconPlayerTrackPrevFilled,
} from "@tabler/icons-react";
import { frontSizeAt, phaseAt } from "../../player/phases";
import { strings } from "../../strings";
import { IconButton } from "../../ui/icon-button";
import { JumpControl } from "../player/jump-control";
import { ScrubBar } from "../player/scrub-bar";
import { usePlayer, useTrace } from "../player/use-player";
import { useApp } from "../shared/app-context";
import { useLayout } from "../shared/use-layout";
import styles from "./lessons.module.css";

const texts = strings.player;
const icon = { size: 15, "aria-hidden": true } as const;

/** The player in a lesson, where the panels are drawers of which only one is open. */
export function LessonPlayer() {
  const layout = useLayout();
  const hasTrace = usePlayer((state) => state.trace !== null);
  return layout !== "wide" && hasTrace ? <Player /> : null;
}

function Player() {
  const { player } = useApp();
  const trace = useTrace();
  const step = usePlayer((state) => state.step);
  const { phase, from, to } = phaseAt(trace, step);
  return (
    <section className={styles["player"]} aria-label={texts.transport} data-testid="lesson-player">
      <ScrubBar />
      <div>
        <IconButton label={texts.back} data-testid="lesson-back" onClick={() => player.move(-1)}>
          <IconPlayerTrackPrevFilled {...icon} />
        </IconButton>
        <IconButton label={texts.forward} data-testid="lesson-forward" onClick={() => player.move(1)}>
          <IconPlayerTrackNextFilled {...icon} />
        </IconButton>
        <IconButton label={texts.end} data-testid="lesson-end" onClick={() => player.move(Infinity)}>
          <IconPlayerSkipForwardFilled {...icon} />
        </IconButton>
        <span>
          {texts.counter(step - from, to - from)}, {texts.faces(phase, frontSizeAt(trace, step))}
        </span>
        <JumpControl />
      </div>
    </section>
  );
}
