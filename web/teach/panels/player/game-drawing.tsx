import { useMemo } from "react";
import type { PlanePosition } from "tetrafront/trace";
import type { GameQuestion, GameVerdict } from "../../player/mesher-game";
import { planePaths, windowAround } from "../../player/plane-drawing";
import { endsOf, planeOf } from "../../player/planar-judge";
import { pickText } from "../../strings/mesher-game";
import { playerStrings } from "../../strings/player";
import { PlaneCorners } from "./plane-corners";
import styles from "./plane-view.module.css";

/** Radius of dots, as a share of the drawing. */
const dot = 0.012;

interface GameDrawingProps {
  readonly question: GameQuestion;
  readonly showsIdeal: boolean;
  /** The choice: a node, null for a new one; undefined before the choice. */
  readonly chosen: number | null | undefined;
  readonly verdict: GameVerdict | null;
  readonly onChoose: (node: number | null) => void;
}

/** The front before the step, the nodes to choose from, and what the choice would break. The buttons below do the same. */
export function GameDrawing({ question, showsIdeal, chosen, verdict, onChoose }: GameDrawingProps) {
  const { front, step, nodes } = question;
  const paths = useMemo(() => planePaths(front, step.step - 1), [front, step]);
  const { left, top, size } = windowAround(front, step);
  const at = (node: number): string => planeOf(front, node).join(" ");
  const [a, b] = step.nodes;
  const apex =
    chosen === undefined ? null : (chosen === null ? step.ideal : planeOf(front, chosen)).join(" ");
  const isRight = verdict?.kind === "best" || verdict?.kind === "possible";
  return (
    <svg
      className={styles["drawing"]}
      viewBox={`${left} ${-top} ${size} ${size}`}
      role="img"
      aria-label={playerStrings.plane.picture(paths.triangleCount, paths.edgeCount)}
    >
      <g transform="scale(1 -1)">
        <path className={styles["triangles"]} d={paths.triangles} />
        <path className={styles["boundary"]} d={paths.boundary} />
        <path className={styles["front"]} d={paths.front} />
        <PlaneCorners front={front} size={size} />
        {apex !== null && (
          <path className={styles[isRight ? "accepted" : "refused"]} d={`M${at(a)}L${at(b)}L${apex}Z`} />
        )}
        {verdict?.edges.map((edge) => {
          const [from, to] = endsOf(front, edge);
          return <path key={edge} className={styles["culprit"]} d={`M${at(from)}L${at(to)}`} />;
        })}
        <path className={styles["base"]} d={`M${at(a)}L${at(b)}`} />
        {showsIdeal && (
          <circle
            className={styles["ring"]}
            cx={step.ideal[0]}
            cy={step.ideal[1]}
            r={1.6 * dot * size}
            onClick={() => onChoose(null)}
          />
        )}
        {nodes.map((node) => {
          const [cx, cy] = planeOf(front, node);
          return (
            <g key={node} className={styles["choice"]} onClick={() => onChoose(node)}>
              <circle className={styles["candidate"]} cx={cx} cy={cy} r={dot * size} />
              <text
                transform={`translate(${cx} ${cy}) scale(1 -1)`}
                fontSize={0.032 * size}
                dx={1.3 * dot * size}
              >
                {node}
              </text>
            </g>
          );
        })}
        {verdict && <Picks question={question} chosen={chosen ?? null} size={size} />}
      </g>
    </svg>
  );
}

interface PicksProps {
  readonly question: GameQuestion;
  readonly chosen: number | null;
  readonly size: number;
}

/** The reader's choice in a ring, the program's in a square, with words beside them. */
function Picks({ question, chosen, size }: PicksProps) {
  const { front, step, program } = question;
  const made = step.candidates.find(({ verdict }) => verdict === "accepted");
  const own = chosen === null ? step.ideal : planeOf(front, chosen);
  const theirs = program === null ? (made?.plane ?? step.ideal) : planeOf(front, program);
  const isSame = chosen === program;
  const half = 2.6 * dot * size;
  const word = ([x, y]: PlanePosition, text: string | null) => (
    <text
      className={styles["pickWord"]}
      transform={`translate(${x} ${y}) scale(1 -1)`}
      fontSize={0.034 * size}
      dy={-1.3 * half}
    >
      {text}
    </text>
  );
  return (
    <>
      <rect
        className={styles["programPick"]}
        x={theirs[0] - half}
        y={theirs[1] - half}
        width={2 * half}
        height={2 * half}
      />
      <circle className={styles["ownPick"]} cx={own[0]} cy={own[1]} r={isSame ? 0.7 * half : half} />
      {word(own, pickText(true, isSame))}
      {!isSame && word(theirs, pickText(false, true))}
    </>
  );
}
