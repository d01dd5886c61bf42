import { NativeSelect } from "@mantine/core";
import { IconChevronLeft, IconChevronRight } from "@tabler/icons-react";
import { useMemo, useState } from "react";
import { hasStop, stopKinds, type StopKind } from "../../player/stops";
import { strings } from "../../strings";
import { IconButton } from "../../ui/icon-button";
import { useApp } from "../shared/app-context";
import styles from "./player.module.css";
import { usePlayer, useTrace } from "./use-player";

const texts = strings.player;
const icon = { size: 15, "aria-hidden": true } as const;

/** Chooses a kind of step, jumps to the next or previous one, and pauses there while playing. */
export function JumpControl() {
  const { player } = useApp();
  const trace = useTrace();
  const kinds = useMemo(() => stopKinds.filter((kind) => hasStop(trace, kind)), [trace]);
  const [chosen, setChosen] = useState<StopKind | null>(null);
  const kind = chosen ?? kinds[0];
  const stopAt = usePlayer((state) => state.stopAt);
  if (kind === undefined) return null;
  const choose = (value: string): void => {
    const found = kinds.find((other) => other === value);
    if (!found) return;
    setChosen(found);
    if (stopAt) player.state.setState({ stopAt: found });
  };
  return (
    <span className={styles["jump"]} role="group" aria-label={texts.jumpTo}>
      <IconButton
        label={texts.before(kind)}
        data-testid="player-before"
        onClick={() => player.jump(kind, -1)}
      >
        <IconChevronLeft {...icon} />
      </IconButton>
      <NativeSelect
        size="xs"
        aria-label={texts.jumpTo}
        data-testid="player-kind"
        value={kind}
        data={kinds.map((value) => ({ value, label: texts.stops[value] }))}
        onChange={(event) => choose(event.currentTarget.value)}
      />
      <IconButton label={texts.next(kind)} data-testid="player-next" onClick={() => player.jump(kind, 1)}>
        <IconChevronRight {...icon} />
      </IconButton>
      <label className={styles["check"]}>
        <input
          type="checkbox"
          data-testid="player-stop-at"
          checked={stopAt !== null}
          onChange={(event) => player.state.setState({ stopAt: event.currentTarget.checked ? kind : null })}
        />
        {texts.pauseThere}
      </label>
    </span>
  );
}
