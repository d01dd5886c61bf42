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

/** The result of the exact verification, which ends every run, or of the inspection of an opened or improved mesh. */
export function Verdict({ report, stale }: { readonly report: MeshReport; readonly stale: boolean }) {
  const isValid = useRun((state) => state.isValid);
  const failure = report.diagnostics.find(({ code }) => code === "verification-failed");
  const ofRun = failure ? "failed" : report.status === "done" ? "passed" : "none";
  const verdict = isValid === null ? ofRun : isValid ? "inspected" : "invalid";
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
