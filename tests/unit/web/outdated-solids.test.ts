/** Solids whose features follow parameters: made again as part of the step of undo, with what fails. */
import { expect, test } from "vitest";
import { createBody, type Project, type ProjectBody, type SolidFeature } from "tetrafront/project";
import { emptyProject } from "../../../web/document/create";
import { setParameter } from "../../../web/document/parameters";
import { DocumentStore } from "../../../web/session/document-store";
import { OutdatedSolids } from "../../../web/session/outdated-solids";
import { NoSolid } from "../../../web/session/solids";

/** Returns points that encode the width, in place of a box. */
const pointsOf = (width: number): string => `points of ${width}`;

const widthOf = ([box]: readonly SolidFeature[]): number => (box?.type === "box" ? box.size[0] : 0);

const failure = { feature: 1, message: "The box is too small.", remedy: "Change its size." };

/** Makes a box, if its width is positive, as soon as it is released. */
class SlowSolids {
  made = 0;
  #release: (() => void)[] = [];

  async bodyOf(
    _: Project,
    before: ProjectBody | { readonly name: string },
    features: readonly SolidFeature[],
  ) {
    await new Promise<void>((resolve) => this.#release.push(resolve));
    ++this.made;
    const width = widthOf(features);
    if (width <= 0) throw new NoSolid([failure]);
    if (!("id" in before)) throw new Error("a solid that is new");
    const { isOutdated: _outdated, failures: _failures, ...kept } = before;
    return { ...kept, points: pointsOf(width), features };
  }

  async release(): Promise<void> {
    for (const release of this.#release.splice(0)) release();
    await settle();
  }
}

const settle = (): Promise<void> => new Promise((resolve) => setTimeout(resolve));

const box = (width: number): SolidFeature => ({
  id: 1,
  type: "box",
  operation: "new",
  position: [0, 0, 0],
  axis: [0, 0, 1],
  size: [width, 1, 1],
});

function opened(count = 1) {
  const ids = Array.from({ length: count }, (_, k) => k + 1);
  const bodies = ids.map((id): ProjectBody => {
    const surface = {
      points: Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 1),
      triangles: Uint32Array.of(0, 1, 2),
    };
    return { ...createBody(surface, { id, firstPatchId: id }), points: pointsOf(2), features: [box(2)] };
  });
  const documents = new DocumentStore({
    ...emptyProject(),
    bodies,
    parameters: [{ name: "w", expression: "2" }],
    expressions: ids.map((id) => ({ kind: "body", id, field: "features.1.size.0", expression: "w" })),
  });
  const solids = new SlowSolids();
  return { documents, solids, outdated: new OutdatedSolids(documents, solids) };
}

const shownIn = ({ project }: DocumentStore) => project.bodies?.map(({ points }) => points);

test("several solids follow a parameter, in one step of undo", async () => {
  const { documents, solids, outdated } = opened(2);
  documents.edit(setParameter("w", "3"));
  const settled = outdated.settled(new AbortController().signal);
  expect(outdated.state.getState().isPending).toBe(true);
  expect(shownIn(documents)).toEqual([pointsOf(2), pointsOf(2)]);
  for (let k = 0; k < 3; ++k) await solids.release();
  await settled;
  expect(shownIn(documents)).toEqual([pointsOf(3), pointsOf(3)]);
  expect(documents.project.bodies?.some(({ isOutdated }) => isOutdated)).toBe(false);
  expect(documents.state.getState().history.past).toHaveLength(1);
  documents.undo();
  expect(shownIn(documents)).toEqual([pointsOf(2), pointsOf(2)]);
  documents.redo();
  expect(shownIn(documents)).toEqual([pointsOf(3), pointsOf(3)]);
  await solids.release();
  expect(solids.made).toBe(2);
});

test("only the last value counts, and steps that were made meanwhile stay", async () => {
  const { documents, solids } = opened();
  documents.edit(setParameter("w", "3"));
  await settle();
  documents.edit({ ...setParameter("w", "4"), mergeKey: "other" });
  documents.edit({ label: "", change: ({ project }) => void (project.name = "renamed") });
  for (let k = 0; k < 3; ++k) await solids.release();
  expect(shownIn(documents)).toEqual([pointsOf(4)]);
  documents.undo();
  documents.undo();
  for (let k = 0; k < 3; ++k) await solids.release();
  expect(shownIn(documents)).toEqual([pointsOf(3)]);
  for (let k = 0; k < 2; ++k) documents.redo();
  for (let k = 0; k < 3; ++k) await solids.release();
  expect(shownIn(documents)).toEqual([pointsOf(4)]);
  expect(documents.project.name).toBe("renamed");
});

test("features that make nothing are noted, and the shape stays", async () => {
  const { documents, solids } = opened();
  documents.edit(setParameter("w", "-1"));
  await settle();
  await solids.release();
  expect(documents.project.bodies?.[0]).toMatchObject({ points: pointsOf(2), failures: [failure] });
  documents.edit({ ...setParameter("w", "5"), mergeKey: "other" });
  await settle();
  await solids.release();
  expect(shownIn(documents)).toEqual([pointsOf(5)]);
  expect(documents.project.bodies?.[0]?.failures).toBeUndefined();
});
