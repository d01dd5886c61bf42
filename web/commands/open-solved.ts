import type { App } from "../app/app";
import { solvedExamples, strings, type SolvedExample } from "../strings";
import { showFailure } from "./messages";

/** Opens an example, meshes it and solves it in cycles. The solver is loaded for it. */
export async function openSolved(app: App, name: SolvedExample): Promise<void> {
  try {
    const { openSolvedExample } = await import("./solution-examples");
    await openSolvedExample(app, name);
  } catch (error) {
    showFailure(app, strings.messages.openFailed(solvedExamples[name].title), error);
  }
}
