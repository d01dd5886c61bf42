import { Button, Text } from "@mantine/core";
import { createFrom, makers, sourceMakers } from "../../commands/create-menu";
import { mergeableBody } from "../../commands/surface-actions";
import type { Entity } from "../../document/entities";
import { groupOfSelection, renameGroup } from "../../document/groups";
import { isClosedChain } from "../../document/selection";
import { FieldRow } from "../../ui/fields/field-row";
import { NameField } from "../../ui/fields/name-field";
import { SectionTitle } from "../../ui/frames/section-title";
import { strings } from "../../strings";
import { useApp, useProject } from "../shared/app-context";
import { TextCommandButton } from "../shared/command-button";
import { EntityChips } from "../shared/entity-chips";
import { CommonFields } from "./common-fields";
import { DeleteSection } from "./delete-section";
import { GroupButtons } from "./group-list";
import { useEditedField } from "./use-edited-field";
import styles from "./selection-card.module.css";

/** Several selected entities, and what can be created from them. */
export function SelectionCard({ selection }: { readonly selection: readonly Entity[] }) {
  const app = useApp();
  const project = useProject();
  const closed = isClosedChain(selection);
  const group = groupOfSelection(project, selection);
  const { name: nameField } = useEditedField();
  const unique = closed ? selection.slice(0, -1) : selection;
  return (
    <>
      <SectionTitle>
        {closed
          ? strings.inspector.closedChain(selection.length - 1)
          : strings.inspector.several(selection.length)}
      </SectionTitle>
      {group && (
        <div ref={nameField}>
          <FieldRow label={strings.groups.one}>
            <NameField
              key={group.id}
              label={strings.groups.name(group.name)}
              value={group.name}
              placeholder={group.name}
              testId="group-name"
              onCommit={(next) => app.documents.edit(renameGroup(project, group.id, next))}
            />
          </FieldRow>
        </div>
      )}
      <EntityChips entities={selection} project={project} />
      <CommonFields entities={unique} project={project} />
      <CreateFromSelection selection={selection} explain />
      {mergeableBody(project, selection) && (
        <TextCommandButton command="merge-patches" mt={10} mr={8} testId="merge-patches">
          {strings.bodies.split.merge}
        </TextCommandButton>
      )}
      <GroupButtons selection={selection} />
      <DeleteSection entities={selection} project={project} />
    </>
  );
}

interface CreateFromSelectionProps {
  readonly selection: readonly Entity[];
  /** Also show why the other makers do not fit. */
  readonly explain?: boolean;
}

/** Number of selected entities of several kinds for which the reasons are shown. */
const maxExplained = 8;

/** Buttons for everything that can be created from the selection. */
export function CreateFromSelection({ selection, explain = false }: CreateFromSelectionProps) {
  const app = useApp();
  const project = useProject();
  const kinds = new Set(selection.map(({ kind }) => kind));
  const offers = [...makers, ...sourceMakers]
    .filter(({ from }) => kinds.has(from))
    .map((maker) => ({ maker, offer: maker.offer(project, selection) }));
  const possible = offers.filter(({ offer }) => offer.possible);
  // Of a large selection of all kinds, the reasons say nothing new.
  const isExplained = explain && (kinds.size === 1 || selection.length <= maxExplained);
  const refused = new Map<string, string>();
  for (const { maker, offer } of offers) {
    if (offer.possible || maker.quiet || !isExplained) continue;
    // The same reason often refuses patches of all types: the first maker, of any type, stands for them.
    if (!refused.has(offer.reason)) refused.set(offer.reason, maker.label);
  }
  if (possible.length === 0 && refused.size === 0) return null;
  return (
    <section data-testid="create-from-selection">
      <SectionTitle>{strings.inspector.createFrom}</SectionTitle>
      <div className={styles["makers"]}>
        {possible.map(({ maker }) => (
          <Button
            key={maker.id}
            size="compact-sm"
            variant="default"
            data-testid={`create-${maker.id}`}
            onClick={() => createFrom(app, maker)}
          >
            {maker.label}
          </Button>
        ))}
      </div>
      {[...refused].map(([reason, label]) => (
        <Text key={reason} size="xs" c="dimmed" mt={3}>
          {`${label}: ${reason}`}
        </Text>
      ))}
    </section>
  );
}
