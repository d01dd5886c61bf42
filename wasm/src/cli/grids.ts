/** `tetrafront cover` and `tetrafront propose`: write projects with a new background grid. */
import type { Mesher } from "../api/mesher-interface.js";
import { createMesher } from "../api/mesher.js";
import type { CoverOptions, ProposalOptions } from "../api/option-types.js";
import { checkCoverOptions, checkProposalOptions } from "../api/grid-options.js";
import { plural } from "../base/plural.js";
import { extensionOf } from "../formats/file-formats.js";
import type { CoverShape } from "../generated/constants.js";
import { writeProject } from "../project/project.js";
import type { Project, ProjectBackground, ProjectSource } from "../project/project-types.js";
import { checkOutput, FileError, refuseFolder, STANDARD_STREAM, writeOutput } from "./files.js";
import { numberIn, PROJECT_EXTENSION, readProjectFile, refuseOptions } from "./input.js";
import { ExitCode, print, reportFailure } from "./messages.js";

/** Options as commander passes them: numbers are still text. */
interface CommonOptions {
  readonly output: string;
  readonly shape?: CoverShape;
  readonly quiet?: boolean;
}

export interface CoverCommandOptions extends CommonOptions {
  readonly size?: string;
}

export interface ProposeCommandOptions extends CommonOptions {
  readonly minSize?: string;
  readonly maxSize?: string;
  readonly anglePerEdge?: string;
  readonly layers?: string;
  readonly growth?: string;
}

/** Runs `cover`; resolves with the exit code. */
export function coverFile(input: string, options: CoverCommandOptions): Promise<number> {
  const cover: CoverOptions = { size: numberIn(options.size), shape: options.shape };
  return rewritten(input, options, {
    check: () => checkCoverOptions(cover),
    change: async (mesher, project) => {
      const size = cover.size ?? project.meshing?.size;
      return withGrid(project, await mesher.coverProject(project, { ...cover, size }));
    },
  });
}

/** Returns the options of a proposal, which are those of a project and of a surface. */
export const proposalOptions = (options: Omit<ProposeCommandOptions, "output">): ProposalOptions => ({
  minSize: numberIn(options.minSize),
  maxSize: numberIn(options.maxSize),
  anglePerEdge: numberIn(options.anglePerEdge),
  layers: numberIn(options.layers),
  growth: numberIn(options.growth),
});

/** Runs `propose`; resolves with the exit code. */
export function proposeForFile(input: string, options: ProposeCommandOptions): Promise<number> {
  const proposal = proposalOptions(options);
  return rewritten(input, options, {
    check: () => checkProposalOptions(proposal),
    change: async (mesher, project) => {
      const { size, sources } = await mesher.proposeSizes(project, {
        ...proposal,
        maxSize: proposal.maxSize ?? project.meshing?.size,
      });
      const background = await mesher.coverProject(project, {
        ...(size > 0 ? { size } : {}),
        shape: options.shape,
      });
      const all = withNewIds(background.sources ?? [], sources);
      return withGrid(project, { ...background, sources: all });
    },
  });
}

/** Also removes the project's uniform size, which would take precedence over the grid. */
function withGrid(project: Project, background: ProjectBackground): Project {
  const { size: _, ...meshing } = project.meshing ?? {};
  return { ...project, background, meshing: Object.keys(meshing).length > 0 ? meshing : undefined };
}

/** Returns the old sources and those proposed ones that are new, with ids after the old ones. */
function withNewIds(old: readonly ProjectSource[], proposed: readonly ProjectSource[]): ProjectSource[] {
  const last = old.reduce((most, { id }) => Math.max(most, id), 0);
  const asText = ({ id: _, ...source }: ProjectSource) =>
    JSON.stringify(
      Object.entries(source)
        .filter(([, value]) => value !== undefined)
        .sort(([a], [b]) => (a < b ? -1 : 1)),
    );
  const known = new Set(old.map(asText));
  const added = proposed.filter((source) => !known.has(asText(source)));
  return [...old, ...added.map((source, i) => ({ ...source, id: last + 1 + i }))];
}

interface Rewriting {
  readonly check: () => ReturnType<typeof checkCoverOptions>;
  readonly change: (mesher: Mesher, project: Project) => Promise<Project>;
}

async function rewritten(
  input: string,
  options: CommonOptions,
  { check, change }: Rewriting,
): Promise<number> {
  try {
    refuseOptions(check());
    await checkProjectPath(options.output);
    const project = await readProjectFile(input, input === STANDARD_STREAM ? "json" : undefined);
    const changed = await withMesher((mesher) => change(mesher, project));
    await writeOutput(options.output, writeProject(changed));
    if (options.quiet !== true) print(summary(input, changed, options.output));
    return ExitCode.meshed;
  } catch (failure) {
    return reportFailure(failure, input);
  }
}

export async function withMesher<T>(use: (mesher: Mesher) => Promise<T>): Promise<T> {
  const mesher = await createMesher();
  try {
    return await use(mesher);
  } finally {
    mesher.dispose();
  }
}

async function checkProjectPath(output: string): Promise<void> {
  await refuseFolder(output);
  if (output !== STANDARD_STREAM && extensionOf(output) !== PROJECT_EXTENSION) {
    throw new FileError(output, "the output is a project", `Use a name that ends in ${PROJECT_EXTENSION}.`);
  }
  await checkOutput(output);
}

function summary(input: string, { background }: Project, output: string): string {
  const { nodes, tetrahedra, sources = [] } = background;
  const size = nodes[0] === undefined ? "" : ` of size ${Number(nodes[0].size.toPrecision(6))}`;
  const parts = [
    `a grid of ${plural(tetrahedra.length, "tetrahedron")}${size}`,
    plural(sources.length, "source"),
  ];
  return `${input}: ${parts.join(", ")} -> ${output}`;
}
