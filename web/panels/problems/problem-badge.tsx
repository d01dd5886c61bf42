import { Badge } from "@mantine/core";
import { useProblems } from "../shared/app-context";
import { useShownSeverity } from "../shared/problem-severity";

/** The number of problems: red, unless all of them are expected while a model is drawn. Nothing without problems. */
export function ProblemBadge() {
  const problems = useProblems((state) => state.problems);
  const severityOf = useShownSeverity();
  if (problems.length === 0) return null;
  const isCalm = problems.every((problem) => severityOf(problem) === "expected");
  return (
    <Badge
      size="sm"
      miw="max-content"
      color={isCalm ? "gray" : "red"}
      variant={isCalm ? "default" : "filled"}
    >
      {problems.length}
    </Badge>
  );
}
