import type { LensCandidate } from "../../player/lens";
import { tolerance, type LayeredTest } from "../../player/layered-test";
import type { SideAndFace } from "../../player/crossing";
import { playerStrings } from "../../strings/player";
import { Formula, FormulaMeaning } from "./formula";
import { digits } from "./latex";
import styles from "./player.module.css";

const texts = playerStrings.test;

const meeting = [
  String.raw`\mathbf{x}_\mathrm{f}+\alpha^1\mathbf{g}_1+\alpha^2\mathbf{g}_2=\mathbf{x}_\mathrm{s}+\alpha^3\mathbf{g}_3,`,
  String.raw`\alpha^4=1-\alpha^1-\alpha^2`,
];

/** The three layers of the paper's test, with the numbers of a candidate and a face, and which of them decides. */
export function CrossingFormula({ face, layers }: NonNullable<LensCandidate["test"]>) {
  const { boxGap, minGap, shapeExcess, pair } = layers;
  return (
    <section aria-label={texts.title} data-testid="lens-formula">
      <h2 className={styles["title"]}>{texts.title}</h2>
      <p data-testid="lens-layer">{sentenceOf(face, layers)}</p>
      <Layer name={texts.layer.a} excess={boxGap} limit={minGap} />
      <Formula
        parts={[
          String.raw`\max_i\mathrm{gap}^i=${digits(boxGap)}`,
          String.raw`\quad${relation(boxGap, minGap)}d=${digits(minGap)}`,
        ]}
      />
      <Layer name={texts.layer.b} excess={shapeExcess} limit={tolerance} />
      <Formula
        parts={[
          String.raw`\max_i\max(-\!\max N^i,\ \min N^i\!-1)`,
          String.raw`\quad=${digits(shapeExcess)}${relation(shapeExcess, tolerance)}t`,
        ]}
      />
      {pair && <SidesAndFaces pair={pair} finds={layers.finds} />}
      <FormulaMeaning>{texts.hint}</FormulaMeaning>
    </section>
  );
}

function SidesAndFaces({ pair, finds }: { readonly pair: SideAndFace; readonly finds: boolean }) {
  const numbers = pair.alphas
    .map((alpha, i) => String.raw`\alpha^{${i + 1}}&=${digits(alpha)}`)
    // Two in a row: four would be wider than the panel.
    .reduce((rows, one, i) => rows + (i % 2 === 0 ? String.raw`\\` : String.raw`&\quad `) + one);
  const { excess } = pair;
  return (
    <>
      <p>
        {texts.layer.c}: {finds ? texts.verdicts.crosses : texts.verdicts.apart}
      </p>
      <Formula parts={meeting} />
      <Formula parts={[String.raw`\begin{aligned}${numbers}\end{aligned}`]} />
      <Formula
        parts={[
          String.raw`\max_i\max(-\alpha^i,\alpha^i-1)`,
          String.raw`\quad=${digits(excess)}${relation(excess, tolerance)}t=${digits(tolerance)}`,
        ]}
      />
    </>
  );
}

function Layer({
  name,
  excess,
  limit,
}: {
  readonly name: string;
  readonly excess: number;
  readonly limit: number;
}) {
  return (
    <p>
      {name}: {excess > limit ? texts.verdicts.apart : texts.verdicts.goesOn}
    </p>
  );
}

function sentenceOf(face: number, { pair, finds }: LayeredTest): string {
  if (pair === null || !finds) return texts.exact(face);
  return texts.found(face, { ...pair, isTouching: pair.excess >= -tolerance });
}

const relation = (excess: number, limit: number): string => (excess > limit ? ">" : String.raw`\le `);
