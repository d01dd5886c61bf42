import type { Project } from "tetrafront/project";
import {
  ownChanges,
  setNumbers,
  steppedChanges,
  type CommonField,
  type OwnChange,
} from "../../document/common-edits";
import type { Entity } from "../../document/entities";
import type { OwnValues, OwnNumber } from "../../ui/fields/number-field";
import { useApp } from "../shared/app-context";

/** Returns how a number of entities changes from the value that each of them has. */
export function useOwnNumbers(
  project: Project,
  entities: readonly Entity[],
): (field: CommonField) => OwnNumber {
  const { documents } = useApp();
  return (field) => {
    const changeOf = (changes: readonly OwnChange[]): OwnValues => ({
      values: changes.map(({ value }) => value),
      commit: () => documents.edit(setNumbers(field, changes)),
    });
    return {
      read: (text) => {
        const changes = ownChanges(project, entities, text);
        return changes ? changeOf(changes) : changes;
      },
      step: (change) => {
        const changes = steppedChanges(project, entities, field, change);
        return changes && changeOf(changes);
      },
    };
  };
}
