import { Button, Group, Text } from "@mantine/core";
import { useState } from "react";
import { REMESH_DEFAULTS } from "tetrafront";
import type { ProjectBody } from "tetrafront/project";
import { previewSplit, splitPatches } from "../../commands/surface-actions";
import { NumberRow } from "../../ui/fields/number-row";
import { strings } from "../../strings";
import { useApp } from "../shared/app-context";
import { featureAngle } from "../shared/size-fields";
import styles from "./bodies.module.css";
import { useBody } from "./use-body";

const texts = strings.bodies.split;

interface SplitSectionProps {
  readonly body: ProjectBody;
  /** Id of the only patch to split; null for all. */
  readonly patch: number | null;
}

/** Splits patches along sharp edges. The view shows the result in colours before it is applied. */
export function SplitSection({ body, patch }: SplitSectionProps) {
  const app = useApp();
  const [angle, setAngle] = useState<number>(REMESH_DEFAULTS.featureAngle);
  const [isOpen, setOpen] = useState(false);
  const split = useBody(body.id)?.split;
  const proposed = split?.patch === patch ? split : null;
  const propose = (next: number): void => void previewSplit(app, body, next, patch);
  return (
    <details
      className={styles["options"]}
      data-testid="split-patches"
      open={isOpen || proposed !== null}
      onToggle={({ currentTarget }) => setOpen(currentTarget.open)}
    >
      <summary>{texts.title}</summary>
      <NumberRow
        label={texts.angle}
        value={angle}
        step={5}
        refuse={featureAngle}
        testId="split-angle"
        onCommit={(next) => {
          setAngle(next);
          if (proposed) propose(next);
        }}
      />
      <Text size="xs" c="dimmed" mb={6}>
        {texts.hint}
        {patch === null && body.patches.length > 1 && ` ${texts.named}`}
      </Text>
      {proposed ? (
        <>
          <Text size="sm" mb={6} role="status" data-testid="split-result">
            {texts.result(proposed.split.patches.length)}
          </Text>
          <Group gap={8}>
            <Button
              size="compact-sm"
              disabled={proposed.split.patches.length === body.patches.length}
              data-testid="split-apply"
              onClick={() => void splitPatches(app, body.id)}
            >
              {texts.apply}
            </Button>
            <Button size="compact-sm" variant="default" onClick={() => app.bodies.dropSplit(body.id)}>
              {texts.cancel}
            </Button>
          </Group>
        </>
      ) : (
        <Button
          size="compact-sm"
          variant="default"
          data-testid="split-preview"
          onClick={() => propose(angle)}
        >
          {texts.preview}
        </Button>
      )}
    </details>
  );
}
