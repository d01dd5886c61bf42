import { useId } from "react";
import { elementsShown, showsWhole } from "../../player/film-state";
import { filmStrings as texts } from "../../strings/film";
import styles from "./film.module.css";
import { useFrontPlayer, usePlayer } from "./use-player";

/** Opens the filled volume: cuts it, and pulls its elements apart. Empty unless the view shows all elements. */
export function FilledBar() {
  const player = useFrontPlayer();
  const isShown = usePlayer(showsWhole);
  const isCut = usePlayer((state) => elementsShown(state) === "cut");
  const apart = usePlayer((state) => state.apart);
  const cutAt = usePlayer((state) => state.cutAt);
  if (!isShown) return null;
  return (
    <div role="group" aria-label={texts.filled} className={styles["filled"]}>
      {isCut && (
        <Share
          label={texts.cut}
          testId="player-cut"
          value={1 - cutAt}
          onChange={(value) => player.state.setState({ cutAt: 1 - value })}
        />
      )}
      <Share
        label={texts.apart}
        testId="player-apart"
        value={apart}
        onChange={(value) => player.state.setState({ apart: value })}
      />
    </div>
  );
}

interface ShareProps {
  readonly label: string;
  readonly testId: string;
  /** 0 to 1. */
  readonly value: number;
  readonly onChange: (value: number) => void;
}

function Share({ label, testId, value, onChange }: ShareProps) {
  const id = useId();
  return (
    <span className={styles["share"]}>
      <label htmlFor={id}>{label}</label>
      <input
        id={id}
        type="range"
        min={0}
        max={100}
        step={1}
        value={Math.round(100 * value)}
        aria-valuetext={texts.apartText(value)}
        data-testid={testId}
        onChange={(event) => onChange(Number(event.currentTarget.value) / 100)}
      />
    </span>
  );
}
