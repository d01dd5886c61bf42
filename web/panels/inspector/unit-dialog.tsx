import { Button, Group, Text } from "@mantine/core";
import { convertProject, setProjectUnit, unitFactor, unitOf } from "../../document/length-units";
import { strings } from "../../strings";
import { formatNumber } from "../../strings/format";
import { FramedDialog } from "../../ui/frames/framed-dialog";
import { useApp, useProject, useShell } from "../shared/app-context";

/** Asks what becomes of the numbers of the project in another unit. */
export function UnitDialog() {
  const app = useApp();
  const to = useShell((state) => state.chosenUnit);
  const onClose = (): void => app.shell.setState({ chosenUnit: null });
  const from = unitOf(useProject().units);
  const texts = strings.units;
  const convert = (): void => {
    if (from && to) app.documents.edit(convertProject(app.documents.project, from, to));
    onClose();
  };
  const relabel = (): void => {
    app.documents.edit(setProjectUnit(to));
    onClose();
  };
  return (
    <FramedDialog opened={to !== null} title={texts.changeTitle} onClose={onClose}>
      {from && to && (
        <Text size="sm" data-testid="unit-question">
          {texts.question(texts[from], texts[to], formatNumber(unitFactor(from, to)))}
        </Text>
      )}
      <Group justify="flex-end" gap="xs" mt="md">
        <Button size="xs" variant="default" onClick={onClose}>
          {texts.cancel}
        </Button>
        <Button size="xs" variant="default" onClick={relabel} data-testid="unit-relabel">
          {texts.relabel}
        </Button>
        <Button size="xs" onClick={convert} data-testid="unit-convert" data-autofocus>
          {texts.convert}
        </Button>
      </Group>
    </FramedDialog>
  );
}
