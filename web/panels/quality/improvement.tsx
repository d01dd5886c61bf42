import { Button, Text } from "@mantine/core";
import { IconSparkles } from "@tabler/icons-react";
import type { MeshShapes } from "tetrafront/internal";
import { runNamed } from "../../commands/registry";
import { canImprove } from "../../session/run-state";
import { formatAngle, formatCount, formatShortShare } from "../../strings/format";
import { SectionTitle } from "../../ui/frames/section-title";
import { TableHead } from "../../ui/table-head";
import { improvementOutcome, strings } from "../../strings";
import { ratioMeanings } from "../../strings/ratio-meanings";
import { Explained } from "../../ui/explained";
import table from "../../ui/table.module.css";
import { useApp, useDocument, useRun } from "../shared/app-context";

const texts = strings.improvement;

/** What an improvement does, or why the shown mesh cannot be improved. */
const useHint = (): string => useRun((state) => (state.mesh?.metricShapes ? texts.stretched : texts.hint));

/** Improves the elements of the shown mesh. */
export function ImproveButton() {
  const app = useApp();
  const document = useDocument((state) => state);
  const isPossible = useRun((state) => canImprove(state, document));
  const hint = useHint();
  return (
    <Button
      size="compact-sm"
      variant="default"
      leftSection={<IconSparkles size={14} aria-hidden />}
      title={hint}
      disabled={!isPossible}
      data-testid="improve"
      onClick={() => runNamed(app, "improve")}
    >
      {texts.improve}
    </Button>
  );
}

/** Returns a count and its share of all: the share never grows, but the count may. */
const countWithShare = (count: number, all: number): string =>
  count === 0 ? formatCount(0) : `${formatCount(count)} (${formatShortShare(count / all)})`;

const rows: readonly (readonly [name: string, text: (shapes: MeshShapes) => string])[] = [
  [texts.smallestAngle, ({ dihedral }) => formatAngle(dihedral.min)],
  [texts.largestAngle, ({ dihedral }) => formatAngle(dihedral.max)],
  [texts.leastRatio, ({ radiusRatio }) => radiusRatio.min.toFixed(3)],
  [texts.meanRatio, ({ radiusRatio }) => radiusRatio.mean.toFixed(3)],
  [texts.outOfRange, ({ outOfRange, tetrahedra }) => countWithShare(outOfRange, tetrahedra)],
  [texts.tetrahedra, ({ tetrahedra }) => formatCount(tetrahedra)],
];

const isRatio = (name: string): boolean => name === texts.leastRatio || name === texts.meanRatio;

/** What the last improvement has gained. */
export function ImprovementSection() {
  const improvement = useRun((state) => state.improvement);
  const hint = useHint();
  return (
    <section data-testid="improvement">
      <SectionTitle>{texts.title}</SectionTitle>
      {improvement && (
        <Text size="sm" mb={6} data-testid="improvement-result">
          {improvementOutcome(improvement)}
        </Text>
      )}
      {improvement?.isImproved === true && (
        <table className={`${table["table"]} ${table["compact"]}`}>
          <TableHead titles={texts.columns} />
          <tbody>
            {rows.map(([name, text]) => (
              <tr key={name}>
                <th scope="row">
                  {isRatio(name) ? <Explained name={name} meaning={ratioMeanings.tetrahedron} /> : name}
                </th>
                <td>{text(improvement.before)}</td>
                <td>{text(improvement.after)}</td>
              </tr>
            ))}
          </tbody>
        </table>
      )}
      <Text size="xs" c="dimmed" my={6}>
        {hint}
      </Text>
      <ImproveButton />
    </section>
  );
}
