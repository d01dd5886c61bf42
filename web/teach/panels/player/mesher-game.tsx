import { Button, SegmentedControl } from "@mantine/core";
import { useEffect, useMemo, useState } from "react";
import type { SurfaceTrace } from "tetrafront/trace";
import { firstState } from "../../player/phases";
import {
  judgeChoice,
  levels,
  nextQuestion,
  type GameLevel,
  type GameVerdict,
} from "../../player/mesher-game";
import { pickText } from "../../strings/mesher-game";
import { playerStrings } from "../../strings/player";
import { GameDrawing } from "./game-drawing";
import styles from "./plane-view.module.css";
import { useAnswers } from "./use-answers";
import { useDirection } from "./use-direction";
import { useGameFocus } from "./use-game-focus";
import { useFrontPlayer, usePlayer, useTrace } from "./use-player";

const texts = playerStrings.game;

interface Answer {
  readonly node: number | null;
  readonly verdict: GameVerdict;
}

/** Asks for the third node of the next triangle, judges the choice, and keeps a score. `state`: of the surface. */
export function MesherGame({ surface, state }: { readonly surface: SurfaceTrace; readonly state: number }) {
  const player = useFrontPlayer();
  const trace = useTrace();
  const [level, setLevel] = useState<GameLevel>("easy");
  /** By step: each step counts once, whatever the level. */
  const [answers, addAnswer] = useAnswers<Answer>(trace, "patch");
  const isPlaying = usePlayer((shown) => shown.isPlaying);
  const direction = useDirection(state);
  const question = useMemo(() => {
    if (isPlaying) return null;
    const last = direction < 0 ? nextQuestion(surface, state, level, -1) : null;
    return last ?? nextQuestion(surface, state, level);
  }, [surface, state, level, direction, isPlaying]);
  const given = (question && answers.get(question.step.step)) ?? null;
  const box = useGameFocus(question?.step.step ?? null, given !== null);
  useEffect(() => {
    if (!question) return undefined;
    // The view shows the front before the step, and its base edge. Going back leads to the question before.
    player.seek(firstState(trace) + question.step.step - 1);
    player.state.setState({ edgeTask: { question, answer: given } });
    return () => player.state.setState({ edgeTask: null });
  }, [player, trace, question, given]);
  const points = [...answers.values()].reduce((sum, { verdict }) => sum + verdict.points, 0);
  const choose = (node: number | null): void => {
    if (!question || given) return;
    const verdict = judgeChoice(question, node);
    addAnswer(question.step.step, { node, verdict });
  };
  const next = (): void => {
    if (question) player.seek(firstState(trace) + question.step.step);
  };
  const nodes = question ? [...question.nodes, null] : [];
  return (
    <div ref={box} className={styles["game"]} data-testid="mesher-game">
      <div className={styles["header"]}>
        <SegmentedControl
          size="xs"
          aria-label={texts.levelLabel}
          data-testid="game-level"
          value={level}
          data={levels.map((value) => ({ value, label: texts.levels[value] }))}
          onChange={setLevel}
        />
        <span data-testid="game-score">{texts.score(points, answers.size)}</span>
      </div>
      <p className={styles["task"]}>
        {isPlaying ? playerStrings.playing : question ? `${texts.task} ${texts.help[level]}` : texts.none}
      </p>
      {question && (
        <GameDrawing
          question={question}
          showsIdeal={level !== "hard" || given !== null}
          chosen={given ? given.node : undefined}
          verdict={given?.verdict ?? null}
          onChoose={choose}
        />
      )}
      <div className={styles["choices"]} role="group" aria-label={texts.choices}>
        {nodes.map((node) => (
          <Button
            key={node ?? "new"}
            size="compact-xs"
            variant={given && node === question?.program ? "filled" : "default"}
            rightSection={given && pickText(node === given.node, node === question?.program)}
            data-testid={`game-choice-${node ?? "new"}`}
            aria-pressed={given?.node === node}
            data-choice
            aria-disabled={given !== null}
            onClick={() => choose(node)}
          >
            {texts.node(node)}
          </Button>
        ))}
      </div>
      <p role="status" className={styles["verdict"]} data-testid="game-verdict">
        {given &&
          question &&
          texts.verdict[given.verdict.kind](given.verdict.edges, question.program, question.refused)}
        {given?.verdict.isDisputed && ` ${texts.disputed}`}
      </p>
      {given && (
        <Button size="compact-sm" className={styles["next"]} data-next data-testid="game-next" onClick={next}>
          {texts.next}
        </Button>
      )}
    </div>
  );
}
