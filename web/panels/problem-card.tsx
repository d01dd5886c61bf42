import { Button, Text } from "@mantine/core";
import { IconAlertTriangle, IconExclamationCircle } from "@tabler/icons-react";
import { showProblem } from "../actions";
import type { Problem } from "../document/validate";
import { formatPlace } from "../ui/format";
import { strings } from "../ui/strings";
import { useApp } from "./app-context";

const icons = {
  error: IconExclamationCircle,
  warning: IconAlertTriangle,
} as const;

export interface ProblemCardProps {
  readonly problem: Problem;
  readonly testId?: string;
}

/** What is wrong, what to do, and the way to the place. */
export function ProblemCard({ problem, testId }: ProblemCardProps) {
  const app = useApp();
  const Icon = icons[problem.severity];
  const canShow = problem.entities.length > 0 || problem.place !== null;
  return (
    <div
      className="tf-problem"
      data-severity={problem.severity}
      data-testid={testId}
      data-code={problem.code}
    >
      <Icon size={16} role="img" aria-label={strings.severities[problem.severity]} />
      <div className="tf-problem-body">
        <Text size="sm" fw={500}>
          {problem.message}
        </Text>
        <Text size="sm" c="dimmed">
          {problem.remedy}
        </Text>
        <div className="tf-problem-foot">
          {canShow && (
            <Button size="compact-xs" variant="default" onClick={() => showProblem(app, problem)}>
              {strings.bottom.show}
            </Button>
          )}
          {problem.place && (
            <Text size="xs" c="dimmed">
              {strings.bottom.at(formatPlace(problem.place))}
            </Text>
          )}
        </div>
      </div>
    </div>
  );
}
