import type { Mesher } from "tetrafront";
import { expect, it } from "vitest";
import { emptyProject } from "../../../web/document/create";
import { renameProject } from "../../../web/document/edits";
import { PreviewFeed } from "../../../web/session/preview";
import { DocumentStore } from "../../../web/session/document-store";

interface Question {
  readonly name: string;
  readonly signal: AbortSignal;
  readonly answer: () => void;
  readonly fail: (error: Error) => void;
}

/** A mesher that answers only when the test says so, unless the question is cancelled. */
function slowMesher(questions: Question[]): Mesher {
  const previewProject: Mesher["previewProject"] = (project, _options, control) =>
    new Promise((resolve, reject) => {
      const { signal } = control ?? {};
      if (!signal) return reject(new Error("a preview that cannot be given up"));
      signal.addEventListener("abort", () => reject(new Error("cancelled")));
      questions.push({
        name: project.name,
        signal,
        answer: () => resolve({ diagnostics: [] } as never),
        fail: reject,
      });
    });
  return { previewProject } as never;
}

const settled = (): Promise<void> => new Promise((resolve) => setTimeout(resolve, 0));

it("a newer preview cancels a pending one at once, but not two before an answer", async () => {
  const questions: Question[] = [];
  const documents = new DocumentStore(emptyProject("first"), () => 0);
  const feed = new PreviewFeed(documents, Promise.resolve(slowMesher(questions)));
  await settled();
  const shown = () => feed.state.getState().project?.name;
  const rename = async (name: string): Promise<void> => {
    documents.edit(renameProject(name));
    await settled();
  };
  await rename("second");
  expect(questions.map(({ name }) => name)).toEqual(["first", "second"]);
  expect(questions[0]?.signal.aborted).toBe(true);
  await rename("third");
  await rename("fourth");
  expect(questions).toHaveLength(2);
  expect(feed.busy).toBe(true);
  questions[1]?.answer();
  await settled();
  expect(shown()).toBe("second");
  expect(questions.map(({ name }) => name)).toEqual(["first", "second", "fourth"]);
  questions[2]?.answer();
  await settled();
  expect(shown()).toBe("fourth");
  expect(feed.busy).toBe(false);
  expect(feed.state.getState().failure).toBeNull();
});

it("gives samples of the present project, null if it changes, and the reason of a failure, at once and later", async () => {
  const questions: Question[] = [];
  const documents = new DocumentStore(emptyProject("first"), () => 0);
  const feed = new PreviewFeed(documents, Promise.resolve(slowMesher(questions)));
  await settled();
  const first = feed.samples();
  questions[0]?.answer();
  expect(await first).toBe(feed.state.getState().preview);
  expect(await feed.samples()).not.toBeNull();

  documents.edit(renameProject("second"));
  const second = feed.samples();
  await settled();
  documents.edit(renameProject("third"));
  await settled();
  questions.at(-1)?.answer();
  expect(await second).toBeNull();

  documents.edit(renameProject("fourth"));
  const fourth = feed.samples();
  await settled();
  questions.at(-1)?.fail(new Error("no memory"));
  await expect(fourth).rejects.toThrow("no memory");
  await expect(feed.samples()).rejects.toThrow("no memory");

  documents.edit(renameProject("fifth"));
  const fifth = feed.samples();
  await settled();
  questions.at(-1)?.answer();
  expect(await fifth).not.toBeNull();
});
