import { Button, Text, UnstyledButton } from "@mantine/core";
import {
  IconAlertTriangle,
  IconCircleDashed,
  IconExclamationCircle,
  IconInfoCircle,
} from "@tabler/icons-react";
import { showEntities, showProblem } from "../../commands/selection-actions";
import type { Problem } from "../../document/validate";
import { formatPosition } from "../../strings/format";
import { strings } from "../../strings";
import { useApp, useProject } from "../shared/app-context";
import { EntityChips } from "../shared/entity-chips";
import { useShownSeverity } from "../shared/problem-severity";
import { FixButton } from "./fix-button";
import { TriangleList } from "./triangle-list";
import styles from "./problem-card.module.css";

const icons = {
  error: IconExclamationCircle,
  warning: IconAlertTriangle,
  expected: IconCircleDashed,
  note: IconInfoCircle,
} as const;

export interface ProblemCardProps {
  readonly problem: Problem;
  readonly testId?: string;
}

/** A problem with its remedy, and buttons that show where it is. */
export function ProblemCard({ problem, testId }: ProblemCardProps) {
  const app = useApp();
  const project = useProject();
  const severity = useShownSeverity()(problem);
  const Icon = icons[severity];
  const canShow = problem.entities.length > 0 || problem.position !== null;
  return (
    <div className={styles["card"]} data-severity={severity} data-testid={testId} data-code={problem.code}>
      <Icon size={16} role="img" aria-label={strings.severities[severity]} />
      <div className={styles["body"]}>
        <Text size="sm" fw={500}>
          {problem.message}
        </Text>
        <Text size="sm" c="dimmed">
          {problem.remedy}
        </Text>
        <div className={styles["foot"]}>
          <FixButton problem={problem} />
          {canShow && (
            <Button size="compact-xs" variant="default" onClick={() => showProblem(app, problem)}>
              {strings.bottom.show}
            </Button>
          )}
          <EntityChips
            entities={problem.entities}
            project={project}
            paddingTop={0}
            onChoose={(entity) => showEntities(app, [entity])}
          />
          {problem.position && <PositionButton position={problem.position} />}
          <code className={styles["code"]}>{problem.code}</code>
        </div>
        {problem.triangles.length > 0 && <TriangleList problem={problem} />}
      </div>
    </div>
  );
}

function PositionButton({ position }: { readonly position: readonly [number, number, number] }) {
  const app = useApp();
  return (
    <UnstyledButton
      className={styles["position"]}
      aria-label={strings.bottom.showPosition(formatPosition(position))}
      onClick={() => app.viewer.getState().viewer?.framing.fitPosition(position)}
    >
      {strings.bottom.at(formatPosition(position))}
    </UnstyledButton>
  );
}
