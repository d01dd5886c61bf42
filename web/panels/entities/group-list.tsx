import { Button } from "@mantine/core";
import { IconEye, IconEyeOff, IconFocusCentered, IconPointer, IconTrash } from "@tabler/icons-react";
import type { ProjectGroup } from "tetrafront/project";
import { isolate } from "../../commands/selection-actions";
import { entityKey, type Entity } from "../../document/entities";
import {
  colorFromCss,
  colorGroup,
  cssColor,
  extendGroup,
  groupedColor,
  groupEntities,
  isGroupable,
  membershipIn,
  reduceGroup,
  removeGroup,
  renameGroup,
} from "../../document/groups";
import { NameField } from "../../ui/fields/name-field";
import { SectionTitle } from "../../ui/frames/section-title";
import { IconButton } from "../../ui/icon-button";
import { strings } from "../../strings";
import { useApp, useProject, useView } from "../shared/app-context";
import { TextCommandButton } from "../shared/command-button";
import styles from "./group-list.module.css";

const texts = strings.groups;

/** The groups of the project. */
export function GroupList() {
  const { groups = [] } = useProject();
  if (groups.length === 0) return null;
  return (
    <section data-testid="groups">
      <SectionTitle>{texts.title}</SectionTitle>
      <ul className={styles["list"]}>
        {groups.map((group) => (
          <GroupRow key={group.id} group={group} />
        ))}
      </ul>
    </section>
  );
}

function GroupRow({ group }: { readonly group: ProjectGroup }) {
  const app = useApp();
  const { documents, view } = app;
  const project = useProject();
  const hidden = useView((state) => state.hidden);
  const { id, name, color = groupedColor } = group;
  const entities = groupEntities(project, group);
  const isHidden = entities.length > 0 && entities.every((entity) => hidden.has(entityKey(entity)));
  return (
    <li className={styles["row"]} data-testid={`group-${id}`}>
      <input
        type="color"
        className={styles["color"]}
        aria-label={texts.color(name)}
        value={cssColor(color)}
        onChange={({ currentTarget: { value } }) =>
          documents.edit(colorGroup(project, id, colorFromCss(value)))
        }
      />
      <NameField
        label={texts.name(name)}
        value={name}
        placeholder={name}
        onCommit={(next) => documents.edit(renameGroup(project, id, next))}
      />
      <IconButton
        label={texts.select(name, entities.length)}
        size={28}
        onClick={() => view.selectAll(entities)}
      >
        <IconPointer size={15} aria-hidden />
      </IconButton>
      <IconButton label={strings.tree.isolate(name)} size={28} onClick={() => isolate(app, entities)}>
        <IconFocusCentered size={15} aria-hidden />
      </IconButton>
      <IconButton
        label={isHidden ? texts.show(name) : texts.hide(name)}
        size={28}
        onClick={() => view.setHidden(entities, !isHidden)}
      >
        {isHidden ? <IconEyeOff size={15} aria-hidden /> : <IconEye size={15} aria-hidden />}
      </IconButton>
      <IconButton
        label={texts.remove(name)}
        size={28}
        onClick={() => documents.edit(removeGroup(project, id))}
      >
        <IconTrash size={15} aria-hidden />
      </IconButton>
    </li>
  );
}

/** Buttons that make a group of the selection, add it to the groups that there are, or take it out of them. */
export function GroupButtons({ selection }: { readonly selection: readonly Entity[] }) {
  const { documents } = useApp();
  const project = useProject();
  if (!selection.some(isGroupable)) return null;
  const { groups = [] } = project;
  const additions = groups
    .filter((group) => membershipIn(group, selection) !== "all")
    .map(({ id, name }) => ({
      key: `extend-group-${id}`,
      label: texts.add(name),
      edit: () => extendGroup(project, id, selection),
    }));
  const removals = groups
    .filter((group) => membershipIn(group, selection) !== "none")
    .map(({ id, name }) => ({
      key: `reduce-group-${id}`,
      label: texts.takeOut(name),
      edit: () => reduceGroup(project, id, selection),
    }));
  return (
    <div className={styles["buttons"]}>
      <TextCommandButton command="group" testId="group-selection" />
      {[...additions, ...removals].map(({ key, label, edit }) => (
        <Button
          key={key}
          size="compact-xs"
          variant="default"
          data-testid={key}
          onClick={() => documents.edit(edit())}
        >
          {label}
        </Button>
      ))}
    </div>
  );
}
