import { Alert, Button, Checkbox, Text } from "@mantine/core";
import { useState } from "react";
import { PROPOSAL_DEFAULTS } from "tetrafront/internal";
import { applyProposal } from "../../commands/background-actions";
import { DialogButtons } from "../../ui/frames/dialog-buttons";
import { ApplyButton, DialogForm } from "../../ui/frames/dialog-form";
import { formatCount } from "../../strings/format";
import { FramedDialog } from "../../ui/frames/framed-dialog";
import { NumberRow } from "../../ui/fields/number-row";
import { likelySize } from "../../document/extent";
import { strings } from "../../strings";
import { useApp, useProject, useShell } from "../shared/app-context";
import { ProposalSummary } from "./proposal-summary";
import { aboveZero, notNegative } from "../shared/size-fields";
import { coarserOptions, manyTetrahedra, useSizeProposal, type ProposalFields } from "./use-size-proposal";

const texts = strings.background;

/** Proposes sizes from the shape of the model, with the expected number of tetrahedra, and applies them. */
export function ProposeDialog() {
  const app = useApp();
  const opened = useShell((state) => state.dialog === "propose");
  const close = (): void => app.shell.setState({ dialog: null });
  return (
    <FramedDialog opened={opened} title={texts.propose} onClose={close}>
      <ProposeForm onClose={close} />
    </FramedDialog>
  );
}

/** Default smallest size / largest size. */
const smallestShare = 0.05;

function ProposeForm({ onClose }: { readonly onClose: () => void }) {
  const app = useApp();
  const sourceCount = useProject().background.sources?.length ?? 0;
  const [options, setOptions] = useState<ProposalFields>(() => {
    const uniform = likelySize(app.documents.project);
    const smallest = Number((smallestShare * uniform).toPrecision(2));
    return { ...PROPOSAL_DEFAULTS, uniform, smallest };
  });
  const [cover, setCover] = useState(true);
  const [replaceSources, setReplaceSources] = useState(true);
  const { answer, failure } = useSizeProposal(options);
  const apply = (): void => {
    // Options that have just been committed have no answer yet.
    if (!answer) return;
    onClose();
    void applyProposal(app, answer.proposal, { cover, replaceSources });
  };
  const isTooMany = (answer?.tetrahedra ?? 0) > manyTetrahedra;
  return (
    <DialogForm onApply={apply}>
      <Text size="sm" c="dimmed" mb={8}>
        {texts.proposeHint}
      </Text>
      <OptionFields
        options={options}
        onCommit={(name, value) => setOptions((current) => ({ ...current, [name]: value }))}
      />
      <Choice label={texts.coverToo} checked={cover} onChange={setCover} />
      {sourceCount > 0 && (
        <Choice
          label={texts.replaceSources(sourceCount)}
          checked={replaceSources}
          onChange={setReplaceSources}
        />
      )}
      <ProposalSummary answer={answer} failure={failure} />
      {isTooMany && <TooManyElements onCoarser={() => answer && setOptions(coarserOptions(answer))} />}
      <DialogButtons cancel={texts.cancel} onCancel={onClose}>
        <ApplyButton
          data-testid="propose-apply"
          disabled={answer === null}
          {...(isTooMany && { color: "orange" })}
        >
          {isTooMany ? texts.applyAnyway : texts.apply}
        </ApplyButton>
      </DialogButtons>
    </DialogForm>
  );
}

interface ChoiceProps {
  readonly label: string;
  readonly checked: boolean;
  readonly onChange: (checked: boolean) => void;
}

function Choice({ label, checked, onChange }: ChoiceProps) {
  return (
    <Checkbox
      size="xs"
      my={8}
      label={label}
      checked={checked}
      onChange={(event) => onChange(event.currentTarget.checked)}
    />
  );
}

/** Warns that the proposed sizes ask for very many elements, and offers larger ones. */
function TooManyElements({ onCoarser }: { readonly onCoarser: () => void }) {
  return (
    <Alert mt={8} p={8} color="orange" data-testid="proposal-too-many">
      {texts.tooMany}
      <Button mt={6} size="compact-xs" variant="default" data-testid="propose-coarser" onClick={onCoarser}>
        {texts.coarser(formatCount(manyTetrahedra))}
      </Button>
    </Alert>
  );
}

const fields: readonly {
  readonly name: keyof ProposalFields;
  readonly step: number;
  readonly canBeZero: boolean;
}[] = [
  { name: "uniform", step: 0.01, canBeZero: false },
  { name: "smallest", step: 0.001, canBeZero: false },
  { name: "elementsPerCircle", step: 1, canBeZero: true },
  { name: "elementsPerGap", step: 1, canBeZero: true },
  { name: "growth", step: 0.05, canBeZero: true },
];

interface OptionFieldsProps {
  readonly options: ProposalFields;
  readonly onCommit: (name: keyof ProposalFields, value: number) => void;
}

function OptionFields({ options, onCommit }: OptionFieldsProps) {
  return fields.map(({ name, step, canBeZero }) => (
    <NumberRow
      key={name}
      label={texts.proposalOptions[name]}
      value={options[name]}
      step={step}
      refuse={canBeZero ? notNegative : aboveZero}
      testId={`propose-${name}`}
      onCommit={(value) => onCommit(name, value)}
    />
  ));
}
