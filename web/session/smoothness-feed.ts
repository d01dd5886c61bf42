import type { CurvatureSamples, Mesher } from "tetrafront";
import type { Project } from "tetrafront/project";
import { createStore, type StoreApi } from "zustand/vanilla";
import { engineInput } from "../document/engine-input";
import type { Smoothness, ViewStore } from "../document/selection";
import { derived } from "./derived";
import type { DocumentStore } from "./document-store";
import { LatestTask, pause } from "./latest-task";

/** Normals and curvatures of the patches, and how the view shows them. */
export interface ShownSmoothness {
  readonly samples: CurvatureSamples;
  readonly by: Exclude<Smoothness, "none">;
  /** Values at the ends of the colour scale. */
  readonly range: readonly [low: number, high: number];
}

export interface SmoothnessState {
  /** Null if the view shows none, or it is not known yet. */
  readonly shown: ShownSmoothness | null;
}

/** Time without a change before samples are asked for, in milliseconds. */
const restMs = 120;
/** Share of the values beyond the ends of the colour scale: corners of patches may have curvatures far above all others. */
const beyond = 0.02;
/** Curvatures below this share of 1 / extent are rounding errors of planes. */
const flat = 1e-6;

const nothing: SmoothnessState = { shown: null };

interface Stores {
  readonly documents: DocumentStore;
  readonly view: ViewStore;
}

/** Keeps the normals and curvatures that the view shows up to date with the document. */
export class SmoothnessFeed {
  readonly state: StoreApi<SmoothnessState> = createStore<SmoothnessState>(() => nothing);
  readonly #mesher: Promise<Mesher>;
  readonly #task = new LatestTask();
  /** The last samples, and the project that they belong to. */
  #known: { readonly project: Project; readonly samples: CurvatureSamples } | null = null;

  constructor({ documents, view }: Stores, mesher: Promise<Mesher>) {
    this.#mesher = mesher;
    documents.onLeave(() => {
      this.#task.cancel();
      this.#known = null;
      this.state.setState(nothing);
    });
    const by = derived((read) => read(view.state).smoothness);
    const project = derived((read) => read(documents.state).history.present.project);
    const follow = (): void => this.#follow(project.getState(), by.getState());
    by.subscribe(follow);
    project.subscribe(follow);
  }

  #follow(project: Project, by: Smoothness): void {
    this.#task.cancel();
    if (by === "none" || project.patches.length === 0) return this.state.setState(nothing);
    if (this.#known?.project === project) return this.#show(this.#known.samples, by);
    this.#task
      .run(
        async (signal) => {
          await pause(restMs, signal);
          signal.throwIfAborted();
          const [drawn] = engineInput(project);
          return (await this.#mesher).sampleCurvature(drawn, {}, { signal });
        },
        (samples) => {
          this.#known = { project, samples };
          this.#show(samples, by);
        },
      )
      .catch(() => this.state.setState(nothing));
  }

  #show(samples: CurvatureSamples, by: Exclude<Smoothness, "none">): void {
    this.state.setState({ shown: { samples, by, range: curvatureRange(samples, by) } });
  }
}

/** Returns the values at the ends of the colour scale: around 0 for the Gaussian curvature, from 0 for the largest one. */
export function curvatureRange(
  { points, gaussian, largest }: Pick<CurvatureSamples, "points" | "gaussian" | "largest">,
  by: Exclude<Smoothness, "none">,
): readonly [low: number, high: number] {
  const values = (by === "gaussian" ? gaussian : largest).map(Math.abs).sort();
  const top = values[Math.floor((1 - beyond) * Math.max(0, values.length - 1))] ?? 0;
  const extent = points.reduce((most, x) => Math.max(most, Math.abs(x)), 0) || 1;
  const least = by === "gaussian" ? (flat / extent) ** 2 : flat / extent;
  const high = top > least ? top : 0;
  return [by === "gaussian" ? -high : 0, high];
}
