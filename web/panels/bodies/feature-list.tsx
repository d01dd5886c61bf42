import { Checkbox, Group, Text } from "@mantine/core";
import { IconArrowDown, IconArrowUp, IconPencil, IconTrash } from "@tabler/icons-react";
import type { SolidFeature } from "tetrafront/project";
import { useStore } from "zustand";
import { editFeature, explodeSolid, setFeatures } from "../../commands/solid-commands";
import { startOperation } from "../../commands/start-operation";
import { explode } from "../../document/operations/solid-explosion";
import { featureLabel } from "../../document/operations/feature-names";
import type { Solid } from "../../document/operations/solids";
import { operationStrings } from "../../strings";
import { SectionTitle } from "../../ui/frames/section-title";
import { IconButton } from "../../ui/icon-button";
import { TextButton } from "../../ui/text-button";
import { useApp } from "../shared/app-context";
import styles from "./bodies.module.css";

const texts = operationStrings.features;

/** The features of a solid: each can be edited, switched off, moved and deleted. */
export function FeatureList({ solid }: { readonly solid: Solid }) {
  const app = useApp();
  const { isPending, failure } = useStore(app.outdatedSolids.state);
  const { failures = [] } = solid;
  return (
    <section>
      <SectionTitle>{texts.title}</SectionTitle>
      <ol className={styles["features"]} aria-label={texts.list} data-testid="feature-list">
        {solid.features.map((feature, index) => (
          <FeatureRow
            key={feature.id}
            solid={solid}
            index={index}
            failure={failures.find((one) => one.feature === feature.id)}
          />
        ))}
      </ol>
      <Text size="xs" c="dimmed" my={4} role="status" data-testid="solid-status">
        {solid.isOutdated !== true ? texts.hint : isPending ? operationStrings.computing : failure}
      </Text>
      <Group gap="2px 16px">
        <TextButton onClick={() => startOperation(app, explode)}>{texts.explodeToPatches}</TextButton>
        <TextButton title={texts.explodeHint} onClick={() => explodeSolid(app, solid)}>
          {texts.explode}
        </TextButton>
      </Group>
    </section>
  );
}

interface FeatureRowProps {
  readonly solid: Solid;
  readonly index: number;
  readonly failure: { readonly message: string; readonly remedy: string } | undefined;
}

function FeatureRow({ solid, index, failure }: FeatureRowProps) {
  const app = useApp();
  const { features } = solid;
  const feature = features[index];
  if (!feature) return null;
  const label = featureLabel(features, feature.id);
  const isOff = feature.isOff === true;
  const set = (change: (all: readonly SolidFeature[]) => readonly SolidFeature[]): void =>
    void setFeatures(app, solid.id, change);
  const move = (by: 1 | -1): void => set((all) => moved(all, feature.id, by));
  return (
    <li
      className={styles["feature"]}
      data-testid={`feature-${feature.id}`}
      data-failed={failure !== undefined || undefined}
      onDoubleClick={() => editFeature(app, solid, feature)}
    >
      <div className={styles["featureHead"]}>
        <Checkbox
          size="xs"
          aria-label={texts.use(label)}
          checked={!isOff}
          onChange={() => set((all) => all.map((one) => (one.id === feature.id ? withUse(one, isOff) : one)))}
        />
        <span className={styles["featureName"]}>
          {label}
          {"operation" in feature && index > 0 && <small> {texts.uses[feature.operation]}</small>}
        </span>
        <IconButton size="sm" label={texts.edit(label)} onClick={() => editFeature(app, solid, feature)}>
          <IconPencil size={14} />
        </IconButton>
        <IconButton size="sm" label={texts.earlier(label)} disabled={index === 0} onClick={() => move(-1)}>
          <IconArrowUp size={14} />
        </IconButton>
        <IconButton
          size="sm"
          label={texts.later(label)}
          disabled={index === features.length - 1}
          onClick={() => move(1)}
        >
          <IconArrowDown size={14} />
        </IconButton>
        <IconButton
          size="sm"
          label={texts.remove(label)}
          disabled={!canBegin(without(features, feature.id))}
          onClick={() => set((all) => beginning(without(all, feature.id)))}
        >
          <IconTrash size={14} />
        </IconButton>
      </div>
      {failure && (
        <Text size="xs" c="var(--tf-error)" role="alert">
          {failure.message} {failure.remedy}
        </Text>
      )}
    </li>
  );
}

function withUse(feature: SolidFeature, isUsed: boolean): SolidFeature {
  const { isOff: _, ...used } = feature;
  return isUsed ? used : { ...feature, isOff: true };
}

function moved(features: readonly SolidFeature[], id: number, by: 1 | -1): readonly SolidFeature[] {
  const index = features.findIndex((one) => one.id === id);
  const others = without(features, id);
  return [...others.slice(0, index + by), ...features.slice(index, index + 1), ...others.slice(index + by)];
}

const without = (features: readonly SolidFeature[], id: number): readonly SolidFeature[] =>
  features.filter((one) => one.id !== id);

/** Returns whether a solid can begin with the first of these features. */
function canBegin([first]: readonly SolidFeature[]): boolean {
  return first !== undefined && "operation" in first && /new|join/.test(first.operation);
}

/** Returns features of which the first stands by itself. */
const beginning = (features: readonly SolidFeature[]): readonly SolidFeature[] =>
  features.map((one, k) => (k === 0 && "operation" in one ? { ...one, operation: "new" } : one));
