import { Alert, Text } from "@mantine/core";
import { useStore } from "zustand";
import { solutionStrings as texts } from "../../strings/solution";
import { ScrollPanel } from "../../ui/frames/scroll-panel";
import { useApp } from "../shared/app-context";
import { CycleList } from "./cycle-list";
import { FieldSection } from "./field-section";
import { ProblemForm } from "./problem-form";

/** The fields of the shown mesh, the cycles of its adaptation, and the problem that is solved on it. */
export function SolutionPanel() {
  const { solutions } = useApp();
  const meshes = useStore(solutions.state, (state) => state.meshes);
  const failure = useStore(solutions.state, (state) => state.failure);
  // A mesh file is no list.
  const isSolved = typeof meshes[0]?.estimatedError === "number";
  return (
    <ScrollPanel label={texts.title} data-testid="solution-panel">
      {failure !== null && (
        <Alert color="red" variant="light" role="alert" p={8} mb={8} data-testid="solve-failure">
          <Text size="sm">{failure}</Text>
        </Alert>
      )}
      {meshes.length === 0 && (
        <Text size="sm" c="dimmed">
          {texts.intro}
        </Text>
      )}
      {meshes.length > 0 && <FieldSection />}
      {(meshes.length > 1 || isSolved) && <CycleList />}
      <ProblemForm />
    </ScrollPanel>
  );
}
