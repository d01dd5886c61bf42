import type { CSSProperties } from "react";
import { beatsOf } from "../../player/beats";
import { beatAt } from "../../player/film-state";
import { filmStrings as texts } from "../../strings/film";
import { FilledBar } from "./filled-bar";
import styles from "./film.module.css";
import { useFrontPlayer, usePlayer, useTrace } from "./use-player";

/** What is inside a step: its beats; and at the end the sliders that open the filled volume. */
export function StepBars() {
  return (
    <div className={styles["bars"]}>
      <BeatBar />
      <FilledBar />
    </div>
  );
}

/** The beats of the step that is shown, on a scale that is scrubbed. Empty without films. */
function BeatBar() {
  const player = useFrontPlayer();
  const trace = useTrace();
  const film = usePlayer((state) => state.film);
  const beat = usePlayer((state) => state.beat);
  const step = usePlayer((state) => state.lensStep);
  const shown = usePlayer(beatAt);
  if (!film) return null;
  const beats = beatsOf(trace, step);
  const count = Math.max(1, beats.length);
  const present = Math.min(beat ?? count, count);
  const hasBeats = beats.length > 0;
  return (
    <div
      className={styles["beats"]}
      style={{ "--beats": count, "--present": present } as CSSProperties}
      data-testid="player-beats"
      data-off={!hasBeats || undefined}
    >
      <input
        type="range"
        min={1}
        max={count}
        step={1}
        value={present}
        disabled={!hasBeats}
        aria-label={texts.beat}
        aria-valuetext={hasBeats && shown ? texts.beatOf(present, count, texts.beats[shown]) : texts.noBeats}
        data-testid="player-beat"
        onChange={(event) => player.showBeat(Number(event.currentTarget.value))}
      />
      <span className={styles["names"]} aria-hidden>
        {hasBeats ? (
          beats.map((name, i) => (
            <span
              key={name}
              data-reached={i < present || undefined}
              data-current={i + 1 === present || undefined}
            >
              {texts.beats[name]}
            </span>
          ))
        ) : (
          <span>{texts.noBeats}</span>
        )}
      </span>
    </div>
  );
}
