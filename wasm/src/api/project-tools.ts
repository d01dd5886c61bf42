/** Calls of a mesher about a project before it is meshed. */
import type { RunControl } from "../engine/control.js";
import { gridByIndex } from "../diagnostics/entity-names.js";
import { refuse } from "../diagnostics/mesher-error.js";
import type { EngineClient } from "../engine/engine-client.js";
import { modelArrays, modelWithBodyBoxes } from "../project/arrays.js";
import {
  backgroundFrom,
  backgroundOf,
  projectBackground,
  projectSources,
  withNodes,
} from "../project/grid-arrays.js";
import { projectNamer, withMissingId } from "../project/names.js";
import type { ProjectPreview } from "../project/preview.js";
import type { Project, ProjectBackground } from "../project/project-types.js";
import { bodyProblems, hasBodies } from "./body-preparation.js";
import { beginCall } from "./call-checks.js";
import { checkProject, drawnArrays, nothingToCover } from "./input-checks.js";
import type { CurvatureSamples, SizeProposal } from "./mesher-interface.js";
import type { CoverOptions, CurvatureOptions, PreviewOptions, ProposalOptions } from "./option-types.js";
import {
  checkCoverOptions,
  checkCurvatureOptions,
  checkProposalOptions,
  engineCoverOptions,
  engineProposalOptions,
} from "./grid-options.js";
import { SHADED_CELLS } from "../generated/constants.js";
import { checkPreviewOptions, engineOptions, withSettings } from "./mesh-options.js";
import { describedPreview } from "./report.js";

export class ProjectTools {
  readonly #client: EngineClient;

  constructor(client: EngineClient) {
    this.#client = client;
  }

  async preview(project: Project, options: PreviewOptions, control: RunControl): Promise<ProjectPreview> {
    beginCall(this.#client, control);
    const unusable = checkPreviewOptions(options);
    const drawn = drawnArrays(project);
    const { size, innerShells, background } = withSettings(unusable.length > 0 ? {} : options, project);
    const wrong = unusable.length > 0 ? unusable : checkPreviewOptions({ size, innerShells, background });
    const hasGrid = background !== undefined && wrong.length === 0;
    const grid = hasGrid ? withNodes(drawn.grid, background) : drawn.grid;
    // Bodies alone need no sizes.
    const isAlone = hasBodies(project) && project.patches.length === 0 && grid.tetrahedra.length === 0;
    const meshing = engineOptions(
      wrong.length > 0 ? {} : { size: isAlone ? (size ?? 1) : size, innerShells },
    );
    const samplesOnly = unusable.length === 0 && options.samplesOnly === true;
    const name = projectNamer(project);
    const answer = await this.#client.ask("previewModel", [drawn.model, grid, meshing, samplesOnly], control);
    const preview = describedPreview(answer, hasGrid ? gridByIndex(name) : name);
    const named = hasGrid ? { ...project, background: undefined } : project;
    const described = preview.diagnostics.map((found) => withMissingId(found, named));
    if (!hasBodies(project)) return { ...preview, diagnostics: [...wrong, ...described] };
    const ofModel = described.filter(({ code }) => code !== "empty-model");
    return { ...preview, diagnostics: [...wrong, ...bodyProblems(project), ...ofModel] };
  }

  async cover(project: Project, options: CoverOptions, control: RunControl): Promise<ProjectBackground> {
    beginCall(this.#client, control);
    refuse([...checkProject(project), ...checkCoverOptions(options)]);
    const model = modelWithBodyBoxes(project);
    const { size, shape } = engineCoverOptions(options);
    const grid = backgroundFrom(await this.#client.ask("cover", [model, size, shape], control));
    if (grid.tetrahedra.length === 0) refuse([nothingToCover()]);
    const { sources } = backgroundOf(project);
    return { ...projectBackground(grid), ...(sources && { sources }) };
  }

  async curvature(
    project: Project,
    options: CurvatureOptions,
    control: RunControl,
  ): Promise<CurvatureSamples> {
    beginCall(this.#client, control);
    refuse([...checkProject(project), ...checkCurvatureOptions(options)]);
    const { cells = SHADED_CELLS } = options;
    return this.#client.ask("sampleCurvature", [modelArrays(project), cells], control);
  }

  async propose(project: Project, options: ProposalOptions, control: RunControl): Promise<SizeProposal> {
    beginCall(this.#client, control);
    refuse([...checkProject(project), ...checkProposalOptions(options)]);
    const model = modelWithBodyBoxes(project);
    const answer = await this.#client.ask("propose", [model, engineProposalOptions(options)], control);
    return { size: answer.size, sources: projectSources(answer.sources) };
  }
}
