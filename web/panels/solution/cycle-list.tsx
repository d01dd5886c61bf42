import { Group } from "@mantine/core";
import { IconChevronLeft, IconChevronRight } from "@tabler/icons-react";
import { useStore } from "zustand";
import type { SolvedMesh } from "../../session/solutions";
import { formatCount } from "../../strings/format";
import { solutionStrings as texts } from "../../strings/solution";
import { Explained } from "../../ui/explained";
import { SectionTitle } from "../../ui/frames/section-title";
import { IconButton } from "../../ui/icon-button";
import table from "../../ui/table.module.css";
import { TextButton } from "../../ui/text-button";
import { useApp } from "../shared/app-context";
import { ErrorChart } from "./error-chart";

/** The meshes of an adaptation, to step through, and their errors. */
export function CycleList() {
  const { solutions } = useApp();
  const meshes = useStore(solutions.state, (state) => state.meshes);
  const at = useStore(solutions.state, (state) => state.at);
  const step = (change: number, label: string, Icon: typeof IconChevronLeft) => {
    const index = (at ?? 0) + change;
    return (
      <IconButton
        label={label}
        size={24}
        data-testid={change < 0 ? "cycle-previous" : "cycle-next"}
        disabled={meshes[index] === undefined}
        onClick={() => solutions.show(index)}
      >
        <Icon size={15} aria-hidden />
      </IconButton>
    );
  };
  const [name, elements, error, quality] = texts.columns;
  return (
    <section aria-label={texts.cycles}>
      <Group justify="space-between" wrap="nowrap" mt={10}>
        <SectionTitle>{texts.cycles}</SectionTitle>
        <Group gap={2}>
          {step(-1, texts.previous, IconChevronLeft)}
          {step(1, texts.next, IconChevronRight)}
        </Group>
      </Group>
      <table className={`${table["table"]} ${table["compact"]}`} data-testid="cycle-list">
        <thead>
          <tr>
            <th scope="col">{name}</th>
            <th scope="col">{elements}</th>
            <th scope="col">
              <Explained name={error} meaning={texts.errorMeaning} />
            </th>
            <th scope="col">
              <Explained name={quality} meaning={texts.qualityMeaning} />
            </th>
          </tr>
        </thead>
        <tbody>
          {meshes.map((solved, index) => (
            <CycleRow key={index} solved={solved} index={index} isShown={index === at} />
          ))}
        </tbody>
      </table>
      {meshes.length > 1 && <ErrorChart meshes={meshes} at={at} />}
    </section>
  );
}

interface CycleRowProps {
  readonly solved: SolvedMesh;
  readonly index: number;
  readonly isShown: boolean;
}

function CycleRow({ solved: { mesh, estimatedError, leastQuality }, index, isShown }: CycleRowProps) {
  const { solutions } = useApp();
  return (
    <tr data-highlighted={isShown || undefined} data-testid={`cycle-${index}`} data-error={estimatedError}>
      <th scope="row">
        <TextButton aria-pressed={isShown} onClick={() => solutions.show(index)}>
          {texts.cycle(index)}
        </TextButton>
      </th>
      <td>{formatCount(mesh.report.tetrahedra)}</td>
      <td>{estimatedError === null ? "" : texts.error3(estimatedError)}</td>
      <td>{leastQuality?.toFixed(2)}</td>
    </tr>
  );
}
