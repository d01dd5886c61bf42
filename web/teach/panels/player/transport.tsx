import { playerOf } from "../../commands/player-of";
import {
  IconDeviceFloppy,
  IconPlayerPauseFilled,
  IconPlayerPlayFilled,
  IconPlayerRecordFilled,
  IconPlayerSkipBackFilled,
  IconPlayerSkipForwardFilled,
  IconPlayerTrackNextFilled,
  IconPlayerTrackPrevFilled,
  IconRepeat,
  IconX,
} from "@tabler/icons-react";
import { NativeSelect, Toolbar } from "@mantine/core";
import type { ReactNode } from "react";
import type { Trace } from "tetrafront/trace";
import { loopAround, loopLimits, shownLoop, withLoopEnd, type Loop } from "../../player/loop";
import { frontSizeAt, phaseAt } from "../../player/phases";
import { speeds } from "../../player/player";
import { download, fileStem } from "../../../session/files";
import { playerStrings } from "../../strings/player";
import { NumberField } from "../../../ui/fields/number-field";
import { IconButton } from "../../../ui/icon-button";
import { useApp, useRun } from "../../../panels/shared/app-context";
import { ShareMenu } from "./share-menu";
import { OpenTrace } from "./trace-files";
import styles from "./player.module.css";
import { useFrontPlayer, usePlayer, useToldStep, useTrace } from "./use-player";
import { ViewChecks } from "./view-choices";

const texts = playerStrings;
const icon = { size: 15, "aria-hidden": true } as const;

interface TransportProps {
  readonly isShort?: boolean;
  readonly children: ReactNode;
}

/** Buttons that move through the steps, the step shown, and what follows in the same row. */
export function Transport({ isShort = false, children }: TransportProps) {
  const player = useFrontPlayer();
  const isPlaying = usePlayer((state) => state.isPlaying);
  return (
    <div className={styles["row"]}>
      <Toolbar aria-label={texts.transport} className={styles["buttons"]}>
        <IconButton label={texts.start} data-testid="player-start" onClick={() => player.move(-Infinity)}>
          <IconPlayerSkipBackFilled {...icon} />
        </IconButton>
        <IconButton label={texts.back} data-testid="player-back" onClick={() => player.move(-1)}>
          <IconPlayerTrackPrevFilled {...icon} />
        </IconButton>
        <IconButton
          label={isPlaying ? texts.pause : texts.play}
          data-testid="player-play"
          variant="filled"
          color="blue"
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
        {!isShort && <LoopButton />}
      </Toolbar>
      <LoopFields />
      <Counter />
      <StillsHint />
      {children}
    </div>
  );
}

/** The speed, what the view follows and fades, and the buttons of the trace. */
export function TransportChoices() {
  return (
    <>
      <SpeedSelect />
      <ViewChecks />
      <TraceButtons />
    </>
  );
}

/** The phase with the number of its steps, and the size of its front. */
function Counter() {
  const trace = useTrace();
  const step = useToldStep();
  const { phase, from, to } = phaseAt(trace, step);
  return (
    <span className={styles["counter"]} data-testid="player-counter">
      {trace.surface && <span data-testid="player-phase">{texts.phases[phase]}</span>}
      <b>{texts.counter(step - from, to - from)}</b>
      <span>{texts.faces(phase, frontSizeAt(trace, step))}</span>
    </span>
  );
}

function SpeedSelect() {
  const player = useFrontPlayer();
  const speed = usePlayer((state) => state.speed);
  return (
    <NativeSelect
      size="xs"
      aria-label={texts.speed}
      data-testid="player-speed"
      value={speed}
      data={speeds.map((value) => ({ value: String(value), label: texts.speedOf(value) }))}
      onChange={(event) => player.setSpeed(Number(event.currentTarget.value))}
    />
  );
}

/** Says that the front is played without motion. */
export function StillsHint() {
  const isShown = usePlayer(({ isPlaying, playsStills }) => isPlaying && playsStills);
  return (
    <span role="status" className={styles["hint"]} data-testid="player-stills">
      {isShown && texts.stills}
    </span>
  );
}

/** Repeats the steps around the present one. */
export function LoopButton() {
  const player = useFrontPlayer();
  const trace = useTrace();
  const loop = usePlayer((state) => state.loop);
  const told = useToldStep();
  const { from, to } = shownLoop(trace, loop ?? loopAround(trace, told));
  return (
    <IconButton
      label={texts.loopHint(from, to)}
      data-testid="player-loop"
      aria-pressed={loop !== null}
      variant={loop ? "light" : "subtle"}
      color={loop ? "blue" : "gray"}
      onClick={() => player.state.setState(({ step }) => ({ loop: loop ? null : loopAround(trace, step) }))}
    >
      <IconRepeat {...icon} />
    </IconButton>
  );
}

/** The first and the last step that are repeated. */
function LoopFields() {
  const trace = useTrace();
  const loop = usePlayer((state) => state.loop);
  if (!loop) return null;
  return (
    <span className={styles["loop-fields"]} role="group" aria-label={texts.loopSteps}>
      {(["from", "to"] as const).map((end) => (
        <LoopField key={end} trace={trace} loop={loop} end={end} />
      ))}
    </span>
  );
}

function LoopField({
  trace,
  loop,
  end,
}: {
  readonly trace: Trace;
  readonly loop: Loop;
  readonly end: keyof Loop;
}) {
  const player = useFrontPlayer();
  const [least, most] = loopLimits(trace, loop, end);
  return (
    <NumberField
      label={texts.loopEnds[end]}
      value={shownLoop(trace, loop)[end]}
      step={1}
      refuse={(value) =>
        Number.isInteger(value) && value >= least && value <= most ? null : texts.loopRange(least, most)
      }
      testId={`player-loop-${end}`}
      leftSection={texts.loopShort[end]}
      leftSectionWidth={36}
      onCommit={(value) => player.state.setState({ loop: withLoopEnd(trace, loop, end, value) })}
    />
  );
}

/** Records again, opens or saves a trace, or leaves it. */
function TraceButtons() {
  const app = useApp();
  const file = usePlayer((state) => state.file);
  const busy = useRun((state) => state.busy);
  const save = (): void => {
    if (file) download([file], `${fileStem(app.documents.project.name)}.tft`, "application/octet-stream");
  };
  return (
    <span className={styles["end"]}>
      <IconButton
        label={texts.recordAgain}
        data-testid="player-record"
        disabled={busy}
        onClick={() => void playerOf(app).record({ optimizes: true })}
      >
        <IconPlayerRecordFilled {...icon} />
      </IconButton>
      <OpenTrace isSmall />
      <IconButton label={texts.save} data-testid="player-save" onClick={save}>
        <IconDeviceFloppy {...icon} />
      </IconButton>
      <ShareMenu />
      <IconButton label={texts.close} data-testid="player-close" onClick={() => playerOf(app).close()}>
        <IconX {...icon} />
      </IconButton>
    </span>
  );
}
