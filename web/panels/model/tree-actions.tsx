import { ActionIcon } from "@mantine/core";
import { IconEye, IconEyeOff, IconFocusCentered, IconPlus } from "@tabler/icons-react";
import type { MouseEvent, ReactNode } from "react";
import type { App } from "../../app/app";
import { createOrHint, lineMakers, patchMakers } from "../../commands/create-menu";
import { isolate } from "../../commands/selection-actions";
import { runNamed } from "../../commands/registry";
import { entityKey, type DrawnKind, type Entity } from "../../document/entities";
import { layersOfKinds } from "../../document/select-related";
import { commandLabels, entityWords, strings } from "../../strings";
import { useApp, useView } from "../shared/app-context";
import styles from "./model-tree.module.css";

interface RowActionProps {
  readonly label: string;
  readonly isOff?: boolean;
  readonly testId?: string;
  readonly onRun: () => void;
  readonly children: ReactNode;
}

/** A button in a row of the tree. A click on it does not activate the row. */
function RowAction({ label, isOff = false, testId, onRun, children }: RowActionProps) {
  return (
    <ActionIcon
      className={styles["action"]}
      size={24}
      variant="subtle"
      color="gray"
      tabIndex={-1}
      data-off={isOff || undefined}
      aria-label={label}
      title={label}
      data-testid={testId}
      onClick={(event: MouseEvent) => {
        event.stopPropagation();
        onRun();
      }}
    >
      {children}
    </ActionIcon>
  );
}

/** Shows a group and hides all other entities. */
export function IsolateButton({
  entities,
  name,
}: {
  readonly entities: readonly Entity[];
  readonly name: string;
}) {
  const app = useApp();
  return (
    <RowAction label={strings.tree.isolate(name)} onRun={() => isolate(app, entities)}>
      <IconFocusCentered size={14} aria-hidden />
    </RowAction>
  );
}

/** Shows everything that was hidden. */
export function ShowAllButton() {
  const app = useApp();
  return (
    <RowAction label={commandLabels.showAll} testId="groups-show-all" onRun={() => runNamed(app, "show-all")}>
      <IconEye size={14} aria-hidden />
    </RowAction>
  );
}

interface EyeProps {
  readonly isHidden: boolean;
  readonly name: string;
  readonly onToggle: () => void;
}

function Eye({ isHidden, name, onToggle }: EyeProps) {
  const Icon = isHidden ? IconEyeOff : IconEye;
  return (
    <RowAction
      label={isHidden ? strings.tree.show(name) : strings.tree.hide(name)}
      isOff={isHidden}
      onRun={onToggle}
    >
      <Icon size={14} aria-hidden />
    </RowAction>
  );
}

interface EntitiesEyeProps {
  readonly entities: readonly Entity[];
  readonly name: string;
}

/** Hides and shows entities together. */
export function EntitiesEye({ entities, name }: EntitiesEyeProps) {
  const app = useApp();
  const hidden = useView((state) => state.hidden);
  const isHidden = entities.length > 0 && entities.every((entity) => hidden.has(entityKey(entity)));
  return <Eye isHidden={isHidden} name={name} onToggle={() => app.view.setHidden(entities, !isHidden)} />;
}

/** Hides and shows one entity. */
export function EntityEye({ entity, title }: { readonly entity: Entity; readonly title: string }) {
  const app = useApp();
  const isHidden = useView((state) => state.hidden.has(entityKey(entity)));
  return <Eye isHidden={isHidden} name={title} onToggle={() => app.view.setHidden([entity], !isHidden)} />;
}

/** Hides and shows all entities of a kind. */
export function GroupEye({ kind }: { readonly kind: DrawnKind }) {
  const app = useApp();
  const layer = layersOfKinds[kind];
  const isVisible = useView((state) => state.layers[layer]);
  const name = entityWords[kind].many.toLowerCase();
  return <Eye isHidden={!isVisible} name={name} onToggle={() => app.view.setLayer(layer, !isVisible)} />;
}

const addEntity: { readonly [K in DrawnKind]: (app: App) => void } = {
  point: (app) => runNamed(app, "new-point"),
  line: (app) => createOrHint(app, lineMakers, strings.create.line, strings.create.lineHint),
  patch: (app) => createOrHint(app, patchMakers, strings.create.patch, strings.create.patchHint),
  body: (app) => runNamed(app, "import-surface"),
  "body-patch": (app) => runNamed(app, "import-surface"),
  "background-node": (app) => runNamed(app, "new-node"),
  source: (app) => runNamed(app, "source-point"),
};

/** Adds an entity of a kind. */
export function AddButton({ kind }: { readonly kind: DrawnKind }) {
  const app = useApp();
  return (
    <RowAction
      label={strings.tree.add(entityWords[kind].one.toLowerCase())}
      testId={`add-${kind}`}
      onRun={() => addEntity[kind](app)}
    >
      <IconPlus size={14} aria-hidden />
    </RowAction>
  );
}
