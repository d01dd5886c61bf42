import { Text } from "@mantine/core";
import type { ProjectBody } from "tetrafront/project";
import { placedLength } from "../../document/body-repair";
import { placed } from "../../document/placement";
import { SectionTitle } from "../../ui/frames/section-title";
import { formatShort } from "../../strings/format";
import { strings } from "../../strings";
import { PositionList } from "../shared/position-list";
import styles from "./bodies.module.css";

const texts = strings.bodies.repair;

/** What repairs have changed in the given surface. */
export function BodyRepairs({ body }: { readonly body: ProjectBody }) {
  const { repairs = [], repairDeviation = 0, placement } = body;
  if (repairs.length === 0) return null;
  return (
    <section data-testid="body-repairs">
      <SectionTitle>{texts.done}</SectionTitle>
      <ul className={styles["changes"]}>
        {repairs.map(({ kind, count, positions }) => (
          <li key={kind}>
            <PositionList
              summary={texts.made[kind](count)}
              count={count}
              positions={positions.map((position, index) => ({
                label: texts.nouns[kind](index + 1),
                position: placed(position, placement),
              }))}
              testId={`repaired-${kind}`}
            />
          </li>
        ))}
      </ul>
      <Text size="sm" c="dimmed" data-testid="body-repair-deviation">
        {texts.moved(formatShort(placedLength(repairDeviation, body)))}
      </Text>
    </section>
  );
}
