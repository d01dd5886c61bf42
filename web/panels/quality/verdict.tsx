import { IconAlertTriangle, IconCircleCheck, IconClockExclamation } from "@tabler/icons-react";
import type { MeshReport } from "tetrafront";
import { strings } from "../../strings";
import { useRun } from "../shared/app-context";
import styles from "./quality-report.module.css";

const texts = strings.report;
const icons = {
  passed: IconCircleCheck,
  inspected: IconCircleCheck,
  failed: IconAlertTriangle,
  invalid: IconAlertTriangle,
  none: IconClockExclamation,
} as const;

/** The result of the exact verification, which ends every run, or of the inspection of an opened mesh. */
export function Verdict({ report, stale }: { readonly report: MeshReport; readonly stale: boolean }) {
  const origin = useRun((state) => state.origin);
  const failure = report.diagnostics.find(({ code }) => code === "verification-failed");
  const verdict = origin
    ? origin.isValid
      ? "inspected"
      : "invalid"
    : failure
      ? "failed"
      : report.status === "done"
        ? "passed"
        : "none";
  const Icon = icons[verdict];
  return (
    <div className={styles["verdict"]} data-verdict={verdict} data-testid="verdict">
      <Icon size={18} aria-hidden />
      <div>
        <b>{texts.verdicts[verdict]}</b>
        <p>{failure ? failure.message : texts.verdictHints[verdict]}</p>
        {stale && <p>{strings.viewport.staleHint}</p>}
      </div>
    </div>
  );
}
