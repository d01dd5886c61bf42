import type { Problem, ProblemSolution, SolvedMesh } from "./problem";

/** The call that the worker with the solver answers. */
export interface SolveProtocol {
  readonly solve: {
    readonly argument: {
      readonly mesh: SolvedMesh;
      readonly problem: Problem;
      /** As in `solveProblem`. */
      readonly start: Float64Array | null;
    };
    readonly answer: ProblemSolution;
  };
}
