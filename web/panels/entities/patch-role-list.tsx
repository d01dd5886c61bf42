import { Text, UnstyledButton } from "@mantine/core";
import { IconArrowBackUp } from "@tabler/icons-react";
import type { Project } from "tetrafront/project";
import type { Entity } from "../../document/entities";
import { Chip } from "../../ui/chip";
import { strings } from "../../strings";
import { useApp } from "../shared/app-context";
import { entityTitle } from "../shared/entity-chips";
import { useEntityHover } from "../shared/use-entity-hover";
import styles from "../shared/patch-roles.module.css";

export interface PatchRoleListProps {
  readonly project: Project;
  readonly loop: readonly number[];
  /** Gives the role of F2 to the line at an index of the loop. */
  readonly onSecond: (index: number) => void;
}

/** The lines of a Barnhill–Gregory–Nielson patch with their roles F1, F2 and F3 in equation (14). */
export function PatchRoleList({ project, loop, onSecond }: PatchRoleListProps) {
  return (
    <>
      <ol className={styles["list"]} aria-label={strings.inspector.lines}>
        {loop.map((step, index) => {
          const entity = { kind: "line", id: Math.abs(step) } as const;
          const title = entityTitle(project, entity);
          const isSecond = index === 1;
          return (
            <li key={step}>
              <b
                className={styles["role"]}
                data-second={isSecond || undefined}
                data-testid={`role-${entity.id}`}
              >
                F{index + 1}
              </b>
              <LineButton entity={entity} title={title} />
              {step < 0 && <IconArrowBackUp size={14} role="img" aria-label={strings.inspector.reversed} />}
              {!isSecond && (
                <Chip
                  aria-label={strings.inspector.makeSecond(title)}
                  data-testid={`make-second-${entity.id}`}
                  onClick={() => onSecond(index)}
                >
                  {strings.inspector.makeSecondShort}
                </Chip>
              )}
            </li>
          );
        })}
      </ol>
      <Text size="xs" c="dimmed" mt={4}>
        {strings.inspector.secondRole}
      </Text>
    </>
  );
}

function LineButton({ entity, title }: { readonly entity: Entity; readonly title: string }) {
  const { view } = useApp();
  return (
    <UnstyledButton
      className={styles["line"]}
      onClick={() => view.select(entity)}
      {...useEntityHover(entity)}
    >
      {title}
    </UnstyledButton>
  );
}
