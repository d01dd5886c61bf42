import { Button, Progress, Text } from "@mantine/core";
import { IconX } from "@tabler/icons-react";
import type { ProjectBody } from "tetrafront/project";
import type { RepairProposal } from "../../document/body-repair";
import { canCompare } from "../../session/body-repairs";
import { formatAngle } from "../../strings/format";
import { IconButton } from "../../ui/icon-button";
import { strings } from "../../strings";
import { useApp } from "../shared/app-context";
import styles from "./bodies.module.css";
import { useBody } from "./use-body";

const texts = strings.bodies.repair.comparison;

interface RepairComparisonProps {
  readonly body: ProjectBody;
  readonly repair: RepairProposal;
}

/** Which of two repairs is proposed: one that welds nodes, or an exact one. Compares them on request. */
export function RepairComparison({ body, repair }: RepairComparisonProps) {
  const app = useApp();
  const { comparison, isExact } = repair;
  const comparing = useBody(body.id)?.comparing ?? null;
  if (comparing !== null)
    return (
      <div className={styles["progress"]} role="status" aria-label={texts.running}>
        <Progress value={100 * comparing} size="sm" aria-label={texts.running} transitionDuration={0} />
        <Text size="xs">{Math.round(100 * comparing)} %</Text>
        <IconButton label={texts.cancel} size={24} onClick={() => app.bodies.cancelComparison(body.id)}>
          <IconX size={14} aria-hidden />
        </IconButton>
      </div>
    );
  if (comparison !== null) {
    const { welded, exact } = comparison;
    const [one, other] = [welded, exact].map((angle) => (angle === null ? null : formatAngle(angle)));
    return (
      <Text size="sm" mb={6}>
        {isExact ? texts.exact(other ?? "", one ?? "") : texts.welded(one ?? "", other ?? null)}
      </Text>
    );
  }
  if (!canCompare(body, repair)) return null;
  return (
    <Button size="xs" variant="default" mb={6} fullWidth onClick={() => void app.bodies.compareRepairs(body)}>
      {texts.start}
    </Button>
  );
}
