import { viridis } from "../../ui/theme/viridis";
import { strings } from "../../strings";
import styles from "./legend.module.css";

const gradient = `linear-gradient(to top, ${viridis.join(", ")})`;

export interface ScaleLegendProps {
  /** What the colours mean. */
  readonly name: string;
  /** The same in lines; by default the name. */
  readonly lines?: readonly string[];
  readonly testId: string;
  /** Texts from the upper end to the lower end, at equal distances. */
  readonly ticks: readonly string[];
  /** The colours from the lower end to the upper end, in CSS. */
  readonly background?: string;
}

/** A colour scale with its meaning. */
export function ScaleLegend({ name, lines, testId, ticks, background = gradient }: ScaleLegendProps) {
  return (
    <figure
      className={styles["legend"]}
      aria-label={`${strings.viewport.legend}: ${name}`}
      data-testid={testId}
      data-legend="scale"
      data-covers-labels
    >
      <div className={styles["bar"]} style={{ background }} />
      <div className={styles["ticks"]}>
        {ticks.map((tick) => (
          <span key={tick}>{tick}</span>
        ))}
      </div>
      <figcaption>{lines ? lines.map((line) => <div key={line}>{line}</div>) : name}</figcaption>
    </figure>
  );
}
