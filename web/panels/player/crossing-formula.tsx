import type { SideAndFace } from "../../player/crossing";
import { strings } from "../../strings";
import { Formula } from "./formula";
import styles from "./player.module.css";

const texts = strings.player;

const general = String.raw`\mathbf{x}_\mathrm{f}+\alpha^1\mathbf{g}_1+\alpha^2\mathbf{g}_2=\mathbf{x}_\mathrm{s}+\alpha^3\mathbf{g}_3,\quad\alpha^4=1-\alpha^1-\alpha^2`;

/** The paper's test of a side and a face, with the numbers of this pair. */
export function CrossingFormula({ pair }: { readonly pair: SideAndFace }) {
  const numbers = pair.alphas
    .map((alpha, i) => String.raw`\alpha^{${i + 1}}&=${Number(alpha.toPrecision(3))}`)
    .join(String.raw`&\quad `);
  const excess = Number(pair.excess.toPrecision(3));
  const test = String.raw`\max_i\max(-\alpha^i,\alpha^i-1)=${excess}\le 0`;
  return (
    <section aria-label={texts.test} data-testid="lens-formula">
      <h2 className={styles["title"]}>{texts.test}</h2>
      <Formula text={general} />
      <Formula text={String.raw`\begin{aligned}${numbers}\end{aligned}`} />
      <Formula text={test} />
      <p className={styles["hint"]}>{texts.testHint}</p>
    </section>
  );
}
