import { useEffect, useMemo, useState } from "react";
import type { FrontOrder } from "tetrafront";
import type { Trace } from "tetrafront/trace";
import { FrontQueue, type QueueRank, type QueueWork } from "../../lessons/front-queue";
import { lessonStrings } from "../../strings/lessons";
import { usePlayer } from "../player/use-player";
import styles from "./lessons.module.css";

const texts = lessonStrings.queue;
/** Levels of the heap that are drawn. */
const levels = 4;
/** Units of the drawing, which is scaled to the width of the panel. */
const width = 320;
const levelHeight = 42;
const height = levels * levelHeight;
const radius = { x: 19.5, y: 15 } as const;

const shownFaces = 2 ** levels - 1;

interface Place {
  readonly x: number;
  readonly y: number;
}

/** Milliseconds of work on the queue between two chances for the page to respond. */
const sliceMs = 10;

/** What is drawn of the queue of a trace after a step. */
interface ShownQueue {
  readonly queue: FrontQueue;
  readonly step: number;
  readonly top: readonly number[];
  /** What the faces of `top` are ordered by. */
  readonly ranks: readonly QueueRank[];
  readonly count: number;
  readonly work: QueueWork | null;
}

/** Returns the queue after a step, found in slices; until then, that of the state before. */
function useQueue(trace: Trace | null, step: number): ShownQueue | null {
  const queue = useMemo(() => trace && new FrontQueue(trace), [trace]);
  const [shown, setShown] = useState<ShownQueue | null>(null);
  useEffect(() => {
    if (!queue || step < 0) return undefined;
    let timer: ReturnType<typeof setTimeout> | undefined;
    const work = (): void => {
      if (!queue.showWithin(step, sliceMs)) timer = setTimeout(work);
      else
        setShown({
          queue,
          step,
          top: queue.faces.slice(0, shownFaces),
          ranks: queue.faces.slice(0, shownFaces).map((face) => queue.rankOf(face)),
          count: queue.faces.length,
          work: queue.work,
        });
    };
    work();
    return () => clearTimeout(timer);
  }, [queue, step]);
  return step >= 0 && shown?.queue === queue ? shown : null;
}

/** The first levels of the queue of the front in the state that is shown, drawn as a tree. */
export function QueueFigure() {
  const trace = usePlayer((state) => state.trace);
  const step = usePlayer((state) => state.step);
  const shown = useQueue(trace, step);
  if (!shown || !trace) return null;
  const { top, ranks, count, work } = shown;
  const { order } = trace.header;
  const [first] = top;
  const joined = new Set(work?.joined);
  return (
    <figure
      className={styles["figure"]}
      data-testid="queue-figure"
      data-first={first}
      data-count={count}
      aria-busy={shown.step !== step}
    >
      <svg viewBox={`0 0 ${width} ${height}`} role="img" aria-label={texts.picture(count, first ?? null)}>
        {top.map((face, slot) => slot > 0 && <path key={face} className={styles["axis"]} d={edgeTo(slot)} />)}
        {top.map((face, slot) => {
          const { x, y } = placeOf(slot);
          const rank = rankText(order, ranks[slot]);
          const kind = slot === 0 ? "first" : joined.has(face) ? "joined" : undefined;
          return (
            <g key={face} className={styles["queued"]} data-kind={kind}>
              <ellipse cx={x} cy={y} rx={radius.x} ry={radius.y} />
              <text x={x} y={rank === "" ? y : y - 4.5}>
                {face}
              </text>
              <text x={x} y={y + 6} data-rank>
                {rank}
              </text>
            </g>
          );
        })}
      </svg>
      <ul className={styles["key"]}>
        <li data-kind="first">{texts.first}</li>
        <li data-kind="joined">{texts.joined}</li>
        {count > top.length && <li>{texts.below(count - top.length)}</li>}
      </ul>
      <figcaption>
        {texts.rankHint[order]} {ranks.some(({ ruleClass }) => ruleClass > 0) && `${texts.failedHint} `}
        {work
          ? texts.work(work.taken, work.left, work.joined.length, work.comparisons, count)
          : texts.noWork(count)}
      </figcaption>
    </figure>
  );
}

/** What a face is ordered by, in the order of the front; its rule class if it has failed. */
function rankText(order: FrontOrder, rank: QueueRank | undefined): string {
  if (!rank) return "";
  if (rank.ruleClass > 0) return texts.ruleClass(rank.ruleClass);
  if (order === "layered") return `${rank.size} · ${rank.layers}`;
  return order === "smallest-first" ? String(Number(rank.size.toPrecision(2))) : "";
}

function placeOf(slot: number): Place {
  const level = Math.floor(Math.log2(slot + 1));
  const across = 2 ** level;
  const x = (width * (slot + 1 - across + 0.5)) / across;
  return { x, y: (level + 0.5) * levelHeight };
}

/** The edge from the parent of an entry to it. */
function edgeTo(slot: number): string {
  const [from, to] = [placeOf((slot - 1) >> 1), placeOf(slot)];
  return `M${from.x} ${from.y + radius.y}L${to.x} ${to.y - radius.y}`;
}
