/** `tetrafront check`: everything that is wrong with a project, at once and without meshing it. */
import { withMesher } from "./cli-grids.js";
import { numberIn, readProjectFile, refuseOptions } from "./cli-input.js";
import { asBadInput, BadInput, ExitCode, say, tell } from "./cli-messages.js";
import { checkPreviewOptions } from "./options.js";
import type { Diagnostic, PreviewOptions } from "./types.js";

export interface CheckCommandOptions {
  readonly size?: string;
  readonly json?: boolean;
  readonly quiet?: boolean;
}

/** Who checks wants to see them all; beyond this, `--json` has the rest. */
const TOLD_PER_CODE = 50;

/** Runs the command; resolves with the exit code. */
export async function checkFile(input: string, options: CheckCommandOptions): Promise<number> {
  const { subject, diagnostics } = await problemsOf(input, { size: numberIn(options.size) });
  const errors = diagnostics.filter(({ severity }) => severity === "error").length;
  const isQuiet = options.quiet === true;
  if (options.json === true) {
    process.stdout.write(`${JSON.stringify({ input, errors, diagnostics }, null, 2)}\n`);
  } else {
    tell(subject, diagnostics, { isQuiet, perCode: TOLD_PER_CODE });
    if (!isQuiet) say(`${input}: ${counted(diagnostics)}`);
  }
  return errors > 0 ? ExitCode.badInput : ExitCode.meshed;
}

async function problemsOf(input: string, options: PreviewOptions): Promise<BadInput> {
  try {
    refuseOptions(checkPreviewOptions(options));
    const project = await readProjectFile(input);
    const { diagnostics } = await withMesher((mesher) => mesher.previewProject(project, options));
    return new BadInput(input, diagnostics);
  } catch (failure) {
    const bad = asBadInput(failure, input);
    if (bad === undefined) throw failure;
    return bad;
  }
}

/** "2 errors, 1 warning", or "no problems". */
function counted(diagnostics: readonly Diagnostic[]): string {
  const parts = (["error", "warning"] as const).flatMap((severity) => {
    const count = diagnostics.filter((diagnostic) => diagnostic.severity === severity).length;
    return count === 0 ? [] : [`${count} ${severity}${count === 1 ? "" : "s"}`];
  });
  return parts.length === 0 ? "no problems" : parts.join(", ");
}
