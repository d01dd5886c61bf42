import { NativeSelect } from "@mantine/core";
import { IconChevronLeft, IconChevronRight } from "@tabler/icons-react";
import { useMemo, useState } from "react";
import { parseCondition } from "../../player/condition";
import { phaseAt } from "../../player/phases";
import { stopKindsOf, type Stop, type StopKind } from "../../player/stops";
import { playerStrings } from "../../strings/player";
import { IconButton } from "../../../ui/icon-button";
import { ConditionField } from "./condition-field";
import styles from "./player.module.css";
import { useFrontPlayer, usePlayer, useTrace } from "./use-player";

const texts = playerStrings;
const icon = { size: 15, "aria-hidden": true } as const;

/** Chooses a kind of step or a condition, jumps to the next or previous one, and pauses there while playing. */
export function JumpControl() {
  const player = useFrontPlayer();
  const trace = useTrace();
  const kinds = useMemo(() => stopKindsOf(trace), [trace]);
  const [chosen, setChosen] = useState<StopKind | "condition" | null>(null);
  const [isMissing, setIsMissing] = useState(false);
  const text = usePlayer((state) => state.condition);
  const pauses = usePlayer((state) => state.pausesThere);
  const kind = chosen ?? kinds[0] ?? "condition";
  const stop = stopOf(kind, text);
  // Fronts of patches have edges instead of faces.
  const phase = usePlayer((state) => phaseAt(trace, state.step).phase);
  const use = (next: StopKind | "condition", nextText: string): void => {
    setChosen(next);
    setIsMissing(false);
    const stopAt = pauses ? stopOf(next, nextText) : null;
    player.state.setState({ condition: nextText, stopAt });
  };
  const jump = (direction: 1 | -1): void => setIsMissing(stop !== null && !player.jump(stop, direction));
  return (
    <span className={styles["jump"]} role="group" aria-label={texts.jumpTo}>
      <IconButton
        label={texts.before(phase, kind)}
        data-testid="player-before"
        disabled={stop === null}
        onClick={() => jump(-1)}
      >
        <IconChevronLeft {...icon} />
      </IconButton>
      <NativeSelect
        size="xs"
        aria-label={texts.jumpTo}
        data-testid="player-kind"
        value={kind}
        data={[...kinds, "condition" as const].map((value) => ({ value, label: texts.stops[phase][value] }))}
        onChange={({ currentTarget: { value } }) =>
          use(kinds.find((other) => other === value) ?? "condition", text)
        }
      />
      <IconButton
        label={texts.next(phase, kind)}
        data-testid="player-next"
        disabled={stop === null}
        onClick={() => jump(1)}
      >
        <IconChevronRight {...icon} />
      </IconButton>
      {kind === "condition" && (
        <ConditionField text={text} onChange={(value) => use("condition", value)} onJump={jump} />
      )}
      <label className={styles["check"]}>
        <input
          type="checkbox"
          data-testid="player-stop-at"
          checked={pauses}
          disabled={stop === null && !pauses}
          onChange={({ currentTarget: { checked } }) =>
            player.state.setState({ pausesThere: checked, stopAt: checked ? stop : null })
          }
        />
        {texts.pauseThere}
      </label>
      <span role="status" className={styles["hint"]} data-testid="player-no-step">
        {isMissing && texts.noFurther}
      </span>
    </span>
  );
}

function stopOf(kind: StopKind | "condition", text: string): Stop | null {
  if (kind !== "condition") return kind;
  const parsed = parseCondition(text);
  return parsed.success ? parsed.condition : null;
}
