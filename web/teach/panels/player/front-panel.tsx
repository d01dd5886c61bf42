import { playerOf } from "../../commands/player-of";
import { Button, Progress, Text } from "@mantine/core";
import { IconDots, IconPlayerRecordFilled } from "@tabler/icons-react";
import { useDeferredValue, useState } from "react";
import { playerStrings } from "../../strings/player";
import { ScrollPanel } from "../../../ui/frames/scroll-panel";
import { useApp, useRun, useShell } from "../../../panels/shared/app-context";
import { IconButton } from "../../../ui/icon-button";
import { useLayout } from "../../../panels/shared/use-layout";
import { StepBars } from "./beat-bar";
import { JumpControl } from "./jump-control";
import { Lens } from "./lens";
import { OpenTrace } from "./trace-files";
import styles from "./player.module.css";
import { ScrubBar } from "./scrub-bar";
import { LoopButton, Transport, TransportChoices } from "./transport";
import { useHasLens } from "./use-has-lens";
import { useFrontPlayer, usePlayer } from "./use-player";
import { ViewChoices } from "./view-choices";

const texts = playerStrings;

/** Records the front of the present model, and plays it. */
export function FrontPanel() {
  const recording = usePlayer((state) => state.recording !== null);
  const isReading = usePlayer((state) => state.reading !== null);
  const hasTrace = usePlayer((state) => state.trace !== null);
  // A trace that is shown has much to do at once: its panel is made in slices, and is empty until then.
  const isMade = useDeferredValue(hasTrace && !isReading, false);
  if (recording) return <Recording />;
  if (isReading) return <Reading />;
  if (!hasTrace) return <NoTrace />;
  return isMade ? <Player /> : <ScrollPanel label={texts.tab}>{null}</ScrollPanel>;
}

function NoTrace() {
  const app = useApp();
  const busy = useRun((state) => state.busy);
  return (
    <ScrollPanel label={texts.tab}>
      <Text size="sm" maw={640} mb={10}>
        {texts.intro}
      </Text>
      <Button
        size="compact-sm"
        leftSection={<IconPlayerRecordFilled size={13} aria-hidden />}
        data-testid="player-record"
        disabled={busy}
        onClick={() => void playerOf(app).record({ optimizes: true })}
      >
        {texts.record}
      </Button>{" "}
      <OpenTrace />
      <Failure />
    </ScrollPanel>
  );
}

/** Why nothing was recorded or read. */
function Failure() {
  const failure = usePlayer((state) => state.failure);
  return (
    failure && (
      <div role="alert" className={styles["failure"]} data-testid="player-failure">
        {failure.map((reason) => (
          <p key={reason}>{reason}</p>
        ))}
      </div>
    )
  );
}

function Recording() {
  const app = useApp();
  const recording = usePlayer((state) => state.recording);
  const progress = recording?.progress;
  const isStopping = recording?.isStopping ?? false;
  return (
    <ScrollPanel label={texts.tab}>
      <Text size="sm" role="status">
        {isStopping ? texts.stopping : texts.recording}
      </Text>
      <Progress
        value={100 * (progress?.fraction ?? 0)}
        my={8}
        maw={420}
        size="sm"
        aria-label={texts.recording}
        transitionDuration={0}
      />
      <Text size="sm" c="dimmed" mb={8}>
        {texts.recorded(progress?.tetrahedra ?? 0)}
      </Text>
      <Button
        size="compact-sm"
        variant="default"
        data-testid="player-stop"
        disabled={isStopping}
        onClick={() => playerOf(app).stopRecording()}
      >
        {texts.stop}
      </Button>
    </ScrollPanel>
  );
}

/** The progress of reading a recorded or an opened trace. */
function Reading() {
  const player = useFrontPlayer();
  const fraction = usePlayer((state) => state.reading ?? 1);
  return (
    <ScrollPanel label={texts.tab}>
      <Text size="sm" role="status">
        {texts.reading}
      </Text>
      <Progress
        value={100 * fraction}
        my={8}
        maw={420}
        size="sm"
        aria-label={texts.reading}
        data-testid="player-reading"
        transitionDuration={0}
      />
      <Button
        size="compact-sm"
        variant="default"
        data-testid="player-stop-reading"
        onClick={() => player.stopReading()}
      >
        {texts.stopReading}
      </Button>
    </ScrollPanel>
  );
}

function Choices() {
  return (
    <div className={styles["row"]}>
      <JumpControl />
      <ViewChoices />
    </div>
  );
}

function Player() {
  const isPresenting = useShell((state) => state.isPresenting);
  const isShort = useLayout() === "phone" || isPresenting;
  return (
    <div className={styles["player"]} data-testid="player">
      {isShort ? <ShortControls /> : <Controls />}
      {!useHasLens() && (
        <div className={styles["beside"]}>
          <Lens />
        </div>
      )}
    </div>
  );
}

/** Few rows for an audience and on a phone; what is used less is behind a button. */
function ShortControls() {
  const [isMore, setMore] = useState(false);
  return (
    <section className={styles["controls"]} data-short aria-label={texts.transport}>
      <Transport isShort>
        <IconButton
          label={texts.moreControls}
          aria-expanded={isMore}
          data-testid="player-more"
          onClick={() => setMore(!isMore)}
        >
          <IconDots size={15} aria-hidden />
        </IconButton>
      </Transport>
      <ScrubBar />
      <StepBars />
      {isMore && (
        <>
          <div className={styles["row"]}>
            <LoopButton />
            <TransportChoices />
          </div>
          <Choices />
        </>
      )}
      <Failure />
    </section>
  );
}

function Controls() {
  return (
    <section className={styles["controls"]} aria-label={texts.transport}>
      <Transport>
        <TransportChoices />
      </Transport>
      <ScrubBar />
      <StepBars />
      <Choices />
      <Failure />
    </section>
  );
}
