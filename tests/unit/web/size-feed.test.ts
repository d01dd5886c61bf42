import type { Mesher } from "tetrafront";
import type { ProjectPreview } from "tetrafront/project";
import { afterEach, beforeEach, expect, it, vi } from "vitest";
import { createStore } from "zustand/vanilla";
import { ViewStore } from "../../../web/document/selection";
import type { BodyFeed } from "../../../web/session/bodies";
import { DocumentStore } from "../../../web/session/document-store";
import type { PreviewFeed, PreviewState } from "../../../web/session/preview";
import type { MeshRun } from "../../../web/session/run";
import { SizeFeed } from "../../../web/session/size-feed";
import { cubeProject } from "../../support/projects";
import { preview } from "./scene";

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

/** `isImmediate`: the preview of a change comes before the size feed hears of the change. */
function opened({ isImmediate = false } = {}) {
  const documents = new DocumentStore(cubeProject(), () => 0);
  const samples: ProjectPreview = preview([], []);
  const previews = createStore<PreviewState>(() => ({
    preview: samples,
    project: documents.project,
    checked: documents.project,
    failure: null,
  }));
  const answer = (): void => previews.setState({ project: documents.project });
  if (isImmediate) documents.onProject(answer);
  const bodies = createStore(() => ({}));
  const view = new ViewStore();
  const asked: number[] = [];
  const mesher: Pick<Mesher, "sampleSizes"> = {
    sampleSizes: ({ points }) => {
      asked.push(points[0]?.position[0] ?? NaN);
      return Promise.resolve({ sizes: new Float64Array(), tetrahedra: 100 + asked.length });
    },
  };
  const feed = new SizeFeed(
    {
      documents,
      previews: { state: previews } as unknown as PreviewFeed,
      bodies: { state: bodies, preparations: { allOf: () => [] } } as unknown as BodyFeed,
      run: { state: createStore(() => ({ busy: false, mesh: null })) } as unknown as MeshRun,
      view,
    },
    Promise.resolve(mesher as Mesher),
  );
  const moveTo = (x: number): void =>
    documents.edit({
      label: "Move",
      change: ({ project }) => {
        const first = project.points[0];
        if (first) first.position[0] = x;
      },
    });
  const fail = (): void =>
    previews.setState({ failure: { project: documents.project, reason: "no memory" } });
  const changeBodies = (): void => bodies.setState({});
  return { feed, asked, moveTo, answer, fail, changeBodies, view };
}

it("sizes are not asked for while the document changes, however slowly its previews come", async () => {
  const { feed, asked, moveTo, answer } = opened();
  for (let step = 1; step <= 40; ++step) {
    moveTo(step);
    // Only every eighth change gets a preview: 240 ms pass between two of them.
    if (step % 8 === 0) answer();
    await vi.advanceTimersByTimeAsync(30);
  }
  expect(asked).toEqual([]);
  await vi.advanceTimersByTimeAsync(1000);
  expect(asked).toEqual([40]);
  expect(feed.state.getState().expected).toBe(101);
});

it("sizes whose document changes are asked for again, also if the change is taken back", async () => {
  const { feed, asked, moveTo, answer } = opened();
  moveTo(1);
  answer();
  await vi.advanceTimersByTimeAsync(1000);
  moveTo(2);
  moveTo(1);
  answer();
  await vi.advanceTimersByTimeAsync(1000);
  expect(asked).toEqual([1, 1]);
  expect(feed.state.getState().expected).toBe(102);
});

it("sizes of a project that has changed are not asked for while its preview is awaited", async () => {
  const { feed, asked, moveTo, answer, changeBodies, view } = opened();
  moveTo(1);
  answer();
  await vi.advanceTimersByTimeAsync(60);
  moveTo(2);
  await vi.advanceTimersByTimeAsync(200);
  changeBodies();
  view.setSizes({ enabled: true });
  await vi.advanceTimersByTimeAsync(200);
  expect(asked).toEqual([]);
  answer();
  await vi.advanceTimersByTimeAsync(200);
  expect(asked).toEqual([2]);
  expect(feed.state.getState().expected).toBe(101);
});

it("sizes are asked for if the preview comes before the change is reported, or fails", async () => {
  const immediate = opened({ isImmediate: true });
  immediate.moveTo(1);
  await vi.advanceTimersByTimeAsync(200);
  expect(immediate.asked).toEqual([1]);

  const { asked, moveTo, answer, fail } = opened();
  moveTo(1);
  answer();
  moveTo(2);
  fail();
  await vi.advanceTimersByTimeAsync(200);
  // Those of the last project that has a preview, which the view still shows.
  expect(asked).toEqual([1]);
});
