import { Badge } from "@mantine/core";
import { useProblems } from "../shared/app-context";
import { isCalm, useShownSeverity } from "../shared/problem-severity";

/** The number of problems: red, unless none of them alarms. Nothing without problems. */
export function ProblemBadge() {
  const problems = useProblems((state) => state.problems);
  const severityOf = useShownSeverity();
  if (problems.length === 0) return null;
  const areCalm = problems.every((problem) => isCalm(severityOf(problem)));
  return (
    <Badge
      size="sm"
      miw="max-content"
      color={areCalm ? "gray" : "red"}
      variant={areCalm ? "default" : "filled"}
    >
      {problems.length}
    </Badge>
  );
}
