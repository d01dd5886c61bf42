import { useEffect, useMemo } from "react";
import type { SweepMeasures, TracedOptimization, TracedSweep } from "tetrafront/trace";
import { poorElements } from "../../player/sweep-buffers";
import { sweepStrings as texts } from "../../strings/sweeps";
import { formatCount } from "../../../strings/format";
import tables from "../../../ui/table.module.css";
import styles from "./player.module.css";
import { useFrontPlayer, usePlayer } from "./use-player";

/** The sweeps of the optimizer after the last step of the front: a chart, and a table from which the view shows a mesh. */
export function Sweeps({ optimization }: { readonly optimization: TracedOptimization }) {
  const player = useFrontPlayer();
  const shown = usePlayer((state) => state.sweep);
  const poor = useMemo(() => {
    const mesh = shown === null ? undefined : optimization.meshAfter(shown);
    return mesh ? poorElements(mesh).length : null;
  }, [optimization, shown]);
  useEffect(() => () => player.state.setState({ sweep: null }), [player]);
  const { hasMeshes, summary } = optimization;
  const { before, sweeps, result } = summary;
  return (
    <section
      aria-label={texts.title}
      data-testid="sweeps"
      data-sweeps={sweeps.length}
      data-sweep={shown ?? ""}
    >
      <p>{texts.intro}</p>
      <SweepChart before={before} sweeps={sweeps} shown={shown} />
      {result < sweeps.length && <p>{texts.restored(result)}</p>}
      <p className={styles["hint"]} role="status" data-testid="sweeps-hint">
        {hasMeshes ? texts.hint(poor) : texts.tooLarge}
      </p>
      <table className={`${tables["table"]} ${tables["compact"]}`} aria-label={texts.title}>
        <thead>
          <tr>
            <th scope="col">{texts.sweep}</th>
            <th scope="col">{texts.changes}</th>
            <th scope="col">{texts.elements}</th>
            <th scope="col" title={texts.angleHint}>
              {texts.angle}
            </th>
            <th scope="col" title={texts.ratioHint}>
              {texts.ratio}
            </th>
          </tr>
        </thead>
        <tbody>
          {[before, ...sweeps].map((measures, index) => (
            // Sweeps have no identity beside their number.
            <Row
              key={index}
              index={index}
              measures={measures}
              sweep={sweeps[index - 1]}
              hasMesh={hasMeshes}
            />
          ))}
        </tbody>
      </table>
    </section>
  );
}

interface RowProps {
  readonly index: number;
  readonly measures: SweepMeasures;
  /** Undefined for the mesh of the front. */
  readonly sweep: TracedSweep | undefined;
  readonly hasMesh: boolean;
}

function Row({ index, measures, sweep, hasMesh }: RowProps) {
  const player = useFrontPlayer();
  const isShown = usePlayer((state) => state.sweep === index);
  const kind = sweep ? texts.kinds[sweep.kind] : texts.front;
  const name = sweep ? texts.name(index, kind) : kind;
  return (
    <tr data-highlighted={isShown || undefined}>
      <th scope="row">
        {hasMesh ? (
          <button
            type="button"
            className={styles["candidate"]}
            data-testid={`sweep-${index}`}
            aria-label={texts.show(index, kind)}
            aria-pressed={isShown}
            onClick={() => player.state.setState({ sweep: isShown ? null : index })}
          >
            {name}
          </button>
        ) : (
          name
        )}
      </th>
      <td>{sweep ? changesOf(sweep) : ""}</td>
      <td>{formatCount(measures.tetrahedra)}</td>
      <td>{texts.degrees(measures.dihedral.min)}</td>
      <td>{measures.meanRadiusRatio.toFixed(3)}</td>
    </tr>
  );
}

/** What a sweep is about: nodes that it has moved, or elements that it has made. */
function changesOf({ movedNodes, changedElements }: TracedSweep): string {
  if (changedElements > 0) return texts.made(changedElements);
  return movedNodes > 0 ? texts.moved(movedNodes) : texts.unchanged;
}

/** Units of the drawing, which is scaled to the width of the panel. */
const width = 320;
const height = 80;
/** Angle at the top of the chart: no mesh can have a larger smallest angle. */
const maxAngle = 70.53;

interface ChartProps {
  readonly before: SweepMeasures;
  readonly sweeps: readonly TracedSweep[];
  readonly shown: number | null;
}

/** The smallest angle and the mean radius ratio by sweep, both from 0 to that of a regular tetrahedron. */
function SweepChart({ before, sweeps, shown }: ChartProps) {
  const all: readonly SweepMeasures[] = [before, ...sweeps];
  const last = all.at(-1) ?? before;
  const along = (index: number): number => (width * index) / Math.max(1, sweeps.length);
  const curve = (share: (measures: SweepMeasures) => number): string =>
    all
      .map(
        (measures, i) =>
          `${i === 0 ? "M" : "L"}${along(i).toFixed(1)} ${(height * (1 - share(measures))).toFixed(1)}`,
      )
      .join("");
  const label = texts.chart(
    sweeps.length,
    before.dihedral.min,
    last.dihedral.min,
    before.meanRadiusRatio,
    last.meanRadiusRatio,
  );
  return (
    <figure className={styles["sweepChart"]}>
      <svg viewBox={`0 0 ${width} ${height}`} role="img" aria-label={label}>
        <path className={styles["axis"]} d={`M0.5 0V${height - 0.5}H${width}`} />
        <path className={styles["ratio"]} d={curve(({ meanRadiusRatio }) => meanRadiusRatio)} />
        <path className={styles["angle"]} d={curve(({ dihedral }) => dihedral.min / maxAngle)} />
        {shown !== null && <path className={styles["axis"]} d={`M${along(shown)} 0V${height}`} />}
      </svg>
      <ul>
        <li data-curve="angle">{texts.chartAngle}</li>
        <li data-curve="ratio">{texts.chartRatio}</li>
      </ul>
    </figure>
  );
}
