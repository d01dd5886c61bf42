import { Button, SegmentedControl } from "@mantine/core";
import { useEffect, useMemo } from "react";
import { levels, type GameLevel } from "../../player/mesher-game";
import { judgeVolumeChoice, nextVolumeQuestion, type VolumeVerdict } from "../../player/volume-game";
import { pickText } from "../../strings/mesher-game";
import { playerStrings } from "../../strings/player";
import styles from "./plane-view.module.css";
import { useAnswers } from "./use-answers";
import { useDirection } from "./use-direction";
import { useKeptState } from "./use-kept-state";
import { useGameFocus } from "./use-game-focus";
import { useFrontPlayer, usePlayer, useTrace } from "./use-player";

const texts = playerStrings.volumeGame;
const { game } = playerStrings;

interface Answer {
  readonly node: number | null;
  readonly verdict: VolumeVerdict;
}

/** Asks for the fourth node of the next element, judges the choice, and keeps a score. The view shows the nodes to choose from. */
export function VolumeGame({ onEnd }: { readonly onEnd: () => void }) {
  const player = useFrontPlayer();
  const trace = useTrace();
  const state = usePlayer(({ step }) => step);
  const isPlaying = usePlayer((shown) => shown.isPlaying);
  const [level, setLevel] = useKeptState<GameLevel>(trace, "level", "easy");
  /** By step: each step counts once, whatever the level. */
  const [answers, addAnswer] = useAnswers<Answer>(trace, "volume");
  const direction = useDirection(state);
  const question = useMemo(() => {
    if (isPlaying) return null;
    const last = direction < 0 ? nextVolumeQuestion(trace, state, level, -1) : null;
    return last ?? nextVolumeQuestion(trace, state, level);
  }, [trace, state, level, direction, isPlaying]);
  const given = (question && answers.get(question.step.step)) ?? null;
  const box = useGameFocus(question?.step.step ?? null, given !== null);
  const points = [...answers.values()].reduce((sum, { verdict }) => sum + verdict.points, 0);
  useEffect(() => {
    if (!question || isPlaying) return undefined;
    const { step } = question.step;
    // The view shows the front before the step. Going back leads to the question before, not to the same one again.
    player.seek(step - 1);
    const choose = (node: number | null): void => {
      if (given) return;
      const verdict = judgeVolumeChoice(trace, question, node);
      addAnswer(step, { node, verdict });
    };
    const showsIdeal = level !== "hard" || given !== null;
    player.state.setState({ task: { question, answer: given, showsIdeal, choose } });
    return () => player.state.setState({ task: null });
  }, [player, trace, question, given, level, isPlaying, addAnswer]);
  const choose = (node: number | null): void => player.state.getState().task?.choose(node);
  return (
    <div ref={box} className={`${styles["game"]} ${styles["inLens"]}`} data-testid="volume-game">
      <div className={styles["header"]}>
        <SegmentedControl
          size="xs"
          aria-label={game.levelLabel}
          data-testid="volume-game-level"
          value={level}
          data={levels.map((value) => ({ value, label: game.levels[value] }))}
          onChange={setLevel}
        />
        <span data-testid="volume-game-score">{game.score(points, answers.size)}</span>
        <Button size="compact-xs" variant="default" data-testid="volume-game-end" onClick={onEnd}>
          {game.end}
        </Button>
      </div>
      <p className={styles["task"]}>
        {isPlaying ? playerStrings.playing : question ? `${texts.task} ${texts.help[level]}` : texts.none}
      </p>
      <p role="status" className={styles["verdict"]} data-testid="volume-game-verdict">
        {given &&
          question &&
          texts.verdict[given.verdict.kind](given.verdict.faces, question.program, question.refused)}
        {given?.verdict.isDisputed && ` ${game.disputed}`}
      </p>
      {given && question && (
        <Button
          size="compact-sm"
          className={styles["next"]}
          data-next
          data-testid="volume-game-next"
          onClick={() => player.seek(question.step.step)}
        >
          {texts.next}
        </Button>
      )}
      <div className={styles["choices"]} role="group" aria-label={game.choices}>
        {(question ? [...question.nodes, null] : []).map((node) => (
          <Button
            key={node ?? "new"}
            size="compact-xs"
            variant={given && node === question?.program ? "filled" : "default"}
            rightSection={given && pickText(node === given.node, node === question?.program)}
            data-testid={`volume-choice-${node ?? "new"}`}
            aria-pressed={given?.node === node}
            data-choice
            aria-disabled={given !== null}
            onClick={() => choose(node)}
          >
            {game.node(node)}
          </Button>
        ))}
      </div>
    </div>
  );
}
