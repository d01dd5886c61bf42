import { Button, Text, UnstyledButton } from "@mantine/core";
import { IconAlertTriangle, IconExclamationCircle } from "@tabler/icons-react";
import { showEntities, showProblem } from "../commands/selection-actions";
import type { Problem } from "../document/validate";
import { formatPlace } from "../ui/format";
import { strings } from "../ui/strings";
import { useApp, useProject } from "./app-context";
import { EntityChips } from "./entity-chips";
import { TriangleList } from "./triangle-list";

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
  const project = useProject();
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
          <EntityChips
            entities={problem.entities}
            project={project}
            onChoose={(entity) => showEntities(app, [entity])}
          />
          {problem.place && <PlaceButton place={problem.place} />}
          <code className="tf-code">{problem.code}</code>
        </div>
        {problem.triangles.length > 0 && <TriangleList triangles={problem.triangles} />}
      </div>
    </div>
  );
}

function PlaceButton({ place }: { readonly place: readonly [number, number, number] }) {
  const app = useApp();
  return (
    <UnstyledButton
      className="tf-problem-place"
      aria-label={strings.bottom.showPosition(formatPlace(place))}
      onClick={() => app.viewer.getState().viewer?.fitPosition(place)}
    >
      {strings.bottom.at(formatPlace(place))}
    </UnstyledButton>
  );
}
