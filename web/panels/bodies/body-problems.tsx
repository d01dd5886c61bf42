import { Button, Text } from "@mantine/core";
import { IconTool } from "@tabler/icons-react";
import type { RepairChange, SurfaceInspection } from "tetrafront";
import type { ProjectBody } from "tetrafront/project";
import { repairBody } from "../../commands/surface-actions";
import {
  ownLength,
  placedLength,
  placedVolume,
  repairGroups,
  type RepairProposal,
} from "../../document/body-repair";
import { entityKey } from "../../document/entities";
import { groupProblems } from "../../document/validate";
import { placed } from "../../document/placement";
import { SectionTitle } from "../../ui/frames/section-title";
import { NumberRow } from "../../ui/fields/number-row";
import { formatShort } from "../../strings/format";
import { remedyInApp, strings } from "../../strings";
import { ProblemCard } from "../problems/problem-card";
import { useApp, useProblems } from "../shared/app-context";
import { TextCommandButton } from "../shared/command-button";
import { PositionList } from "../shared/position-list";
import { notNegative, upTo } from "../shared/size-fields";
import styles from "./bodies.module.css";
import { RepairComparison } from "./repair-comparison";
import { useBody } from "./use-body";

const texts = strings.bodies;

const maxHoleEdges = 200;

interface BodyProblemsProps {
  readonly body: ProjectBody;
  readonly inspection: SurfaceInspection;
}

/** The problems of a given surface, and the repair that would change them. */
export function BodyProblems({ body, inspection }: BodyProblemsProps) {
  const problems = useProblems((state) => state.byEntity.get(entityKey({ kind: "body", id: body.id })));
  const repair = useBody(body.id)?.repair;
  if (!problems && inspection.isFillable) return null;
  // One problem of each code is enough to understand the repair, which would otherwise be far below.
  const listed = groupProblems(problems ?? []).flatMap((group) => group.problems.slice(0, 1));
  return (
    <section data-testid="body-problems">
      <SectionTitle>{texts.problems}</SectionTitle>
      {listed.map((problem) => (
        <ProblemCard key={problem.key} problem={problem} />
      ))}
      {problems && problems.length > listed.length && (
        <TextCommandButton command="problems" variant="subtle">
          {texts.allProblems(problems.length)}
        </TextCommandButton>
      )}
      {repair && !inspection.isFillable && <RepairSection body={body} repair={repair} />}
    </section>
  );
}

interface RepairSectionProps {
  readonly body: ProjectBody;
  readonly repair: RepairProposal;
}

/** Returns what a change is about. */
const changeLabel = (change: RepairChange): string =>
  (texts.repair.subjects[change.kind] as (change: RepairChange) => string)(change);

/** What a repair would change, with its options. */
function RepairSection({ body, repair }: RepairSectionProps) {
  const app = useApp();
  const { wishes, changes, deviation, after, unresolved } = repair;
  const errors = after.diagnostics.filter(({ severity }) => severity === "error").length;
  const propose = (change: Partial<typeof wishes>): void =>
    void app.bodies.proposeRepair(body, { ...wishes, ...change });
  return (
    <section data-testid="body-repair">
      <SectionTitle>{texts.repair.title}</SectionTitle>
      <Text size="sm">{changes.length === 0 ? texts.repair.none : texts.repair.intro}</Text>
      <ul className={styles["changes"]}>
        {repairGroups(changes).map(([kind, group]) => (
          <li key={kind}>
            <PositionList
              summary={texts.repair.changes[kind](group.length)}
              positions={group.map((change) => ({
                label: changeLabel(change),
                position: placed(change.position, body.placement),
              }))}
              testId={`repair-${kind}`}
            />
          </li>
        ))}
      </ul>
      <Text size="sm" c="dimmed" mb={6} data-testid="repair-outcome">
        {changes.length > 0 && `${texts.repair.moves(formatShort(placedLength(deviation, body)))} `}
        {after.isFillable ? texts.repair.solves : texts.repair.remains(errors)}
      </Text>
      {!after.isFillable &&
        unresolved.map((found) => (
          <Text key={found.message} size="sm" mb={6}>
            {`${found.message}. ${remedyInApp(found)}`}
          </Text>
        ))}
      {repair.shared > 0 && (
        <Text size="sm" c="dimmed" mb={6}>
          {texts.repair.shared(formatShort(placedVolume(repair.shared, body)))}
        </Text>
      )}
      <RepairComparison body={body} repair={repair} />
      <NumberRow
        label={texts.repair.weld}
        value={placedLength(typeof wishes.weld === "number" ? wishes.weld : 0, body)}
        step={0.001}
        refuse={notNegative}
        testId="repair-weld"
        onCommit={(weld) => propose({ weld: ownLength(weld, body) })}
      />
      <NumberRow
        label={texts.repair.holes}
        value={wishes.fillHoles ?? 0}
        step={1}
        refuse={upTo(maxHoleEdges, notNegative)}
        testId="repair-holes"
        onCommit={(edges) => propose({ fillHoles: Math.round(edges) })}
      />
      <Button
        size="xs"
        mt={8}
        fullWidth
        disabled={changes.length === 0}
        leftSection={<IconTool size={14} aria-hidden />}
        data-testid="body-repair-apply"
        onClick={() => void repairBody(app, body.id)}
      >
        {texts.repair.apply}
      </Button>
      {after.isFillable && (
        <Text size="xs" c="dimmed" mt={4}>
          {texts.repair.first}
        </Text>
      )}
    </section>
  );
}
