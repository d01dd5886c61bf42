/** The worker that solves problems on meshes; in the page, they would block it. */
import { serveCalls } from "../workers/serve-calls";
import type { SolveProtocol } from "./solve-protocol";
import { solveProblem } from "./solve-problem";

serveCalls<SolveProtocol>({
  solve: ({ mesh, problem, start }) => {
    const answer = solveProblem(mesh, problem, start);
    return { answer, transfer: answer.fields.map(({ values }) => values.buffer) };
  },
});
