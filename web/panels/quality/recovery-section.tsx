import { Text } from "@mantine/core";
import type { MeshReport } from "tetrafront";
import { SectionTitle } from "../../ui/frames/section-title";
import { recoverySteps, strings } from "../../strings";
import styles from "./quality-report.module.css";

const texts = strings.report;

/** How the front was closed after it stalled. */
export function RecoverySection({ recovery }: { readonly recovery: MeshReport["recovery"] }) {
  const steps = recoverySteps(recovery);
  return (
    <section data-testid="recovery">
      <SectionTitle>{texts.recovery}</SectionTitle>
      {steps.length === 0 ? (
        <Text size="sm" c="dimmed">
          {texts.noRecovery}
        </Text>
      ) : (
        <ul className={styles["recovery"]}>
          {steps.map((step) => (
            <li key={step}>{step}</li>
          ))}
        </ul>
      )}
    </section>
  );
}
