import { Button, Text } from "@mantine/core";
import { make, makers, sourceMakers } from "../commands/create-menu";
import { deleteSelection } from "../commands/selection-actions";
import type { Entity } from "../document/entities";
import { isClosedChain } from "../document/selection";
import { SectionTitle } from "../ui/field-row";
import { strings } from "../ui/strings";
import { useApp, useProject } from "./app-context";
import { EntityChips } from "./entity-chips";

/** Several things selected: which, and what can be made of them. */
export function SelectionCard({ selection }: { readonly selection: readonly Entity[] }) {
  const app = useApp();
  const project = useProject();
  const closed = isClosedChain(selection);
  return (
    <>
      <SectionTitle>
        {closed
          ? strings.inspector.closedChain(selection.length - 1)
          : strings.inspector.several(selection.length)}
      </SectionTitle>
      <EntityChips entities={selection} project={project} />
      <MakeOfSelection selection={selection} explain />
      <Button mt={10} size="compact-xs" variant="default" onClick={() => deleteSelection(app)}>
        {strings.inspector.deleteAll}
      </Button>
    </>
  );
}

interface MakeOfSelectionProps {
  readonly selection: readonly Entity[];
  /** Says of the others why they cannot be made. */
  readonly explain?: boolean;
}

/** Buttons for what can be made of the selection. */
export function MakeOfSelection({ selection, explain = false }: MakeOfSelectionProps) {
  const app = useApp();
  const project = useProject();
  const kinds = new Set(selection.map(({ kind }) => kind));
  const offers = [...makers, ...sourceMakers]
    .filter(({ from }) => kinds.has(from))
    .map((maker) => ({ maker, offer: maker.offer(project, selection) }));
  const possible = offers.filter(({ offer }) => offer.possible);
  const refused = offers.flatMap(({ maker, offer }) =>
    offer.possible || maker.quiet ? [] : [`${maker.label}: ${offer.reason}`],
  );
  if (possible.length === 0 && !(explain && refused.length > 0)) return null;
  return (
    <section data-testid="make-of-selection">
      <SectionTitle>{strings.inspector.makeOf}</SectionTitle>
      <div className="tf-makers">
        {possible.map(({ maker }) => (
          <Button
            key={maker.id}
            size="compact-sm"
            variant="default"
            data-testid={`make-${maker.id}`}
            onClick={() => make(app, maker)}
          >
            {maker.label}
          </Button>
        ))}
      </div>
      {explain &&
        refused.map((text) => (
          <Text key={text} size="xs" c="dimmed" mt={3}>
            {text}
          </Text>
        ))}
    </section>
  );
}
