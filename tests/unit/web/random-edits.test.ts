import { parseProject } from "tetrafront/project";
import { describe, expect, it } from "vitest";
import { documentKey } from "../../../web/document/content-keys";
import { Autosave } from "../../../web/session/autosave";
import type { DocumentStore } from "../../../web/session/document-store";
import { openKept } from "../../../web/session/kept-document";
import { RandomUser } from "./random-user";
import { MemoryStorage } from "./storage-doubles";

/** Sequences of edits, and edits of each. */
const sequences = 150;
const edits = 12;
/** Sequences that are also written to the storage and read again after each edit. */
const stored = 15;

const stepsOf = (documents: DocumentStore) => {
  const { past, future } = documents.state.getState().history;
  return { past: past.length, future: future.length };
};

/** Undoes and redoes everything, and returns to the present. */
function checkHistory(documents: DocumentStore, empty: string): void {
  const { past, future } = stepsOf(documents);
  const present = documentKey(documents.project);
  for (let i = 0; i < past; ++i) documents.undo();
  expect(documentKey(documents.project)).toBe(empty);
  const keys: string[] = [];
  for (let i = 0; i < past + future; ++i) {
    documents.redo();
    keys.push(documentKey(documents.project));
  }
  if (past > 0) expect(keys[past - 1]).toBe(present);
  for (let i = past + future - 1; i > 0; --i) {
    documents.undo();
    expect(documentKey(documents.project)).toBe(keys[i - 1]);
  }
  documents.jumpTo(past);
  expect(documentKey(documents.project)).toBe(present);
  expect(stepsOf(documents)).toEqual({ past, future });
}

describe(`${sequences} random sequences of edits`, () => {
  it("are undone to the empty project and redone to the same, and give projects that a file may hold", () => {
    const kinds = new Set<string>();
    for (let seed = 1; seed <= sequences; ++seed) {
      const { documents, ...user } = opened(seed);
      const empty = documentKey(documents.project);
      for (let i = 0; i < edits; ++i) user.act();
      const read = parseProject(documents.project);
      if (!read.success) throw new Error(`seed ${seed}: ${read.errors[0].path} ${read.errors[0].message}`);
      for (const { label } of documents.state.getState().history.past) kinds.add(label.replace(/\d+/g, ""));
      checkHistory(documents, empty);
    }
    // Otherwise the sequences would prove little.
    expect(kinds.size).toBeGreaterThan(40);
  });

  it("are in the storage after each edit as in memory", async () => {
    for (let seed = 1; seed <= stored; ++seed) {
      const { documents, act } = opened(seed);
      const storage = new MemoryStorage();
      const autosave = new Autosave(documents, storage);
      const stop = autosave.follow();
      for (let i = 0; i < edits; ++i) {
        act();
        await autosave.flush();
        const kept = storage.documents.get(documents.state.getState().id);
        const read = kept && (await openKept(kept));
        expect(read && documentKey(read.history.present.project)).toBe(documentKey(documents.project));
        const { past, future } = stepsOf(documents);
        expect([read?.history.past.length, read?.history.future.length]).toEqual([past, future]);
      }
      stop();
    }
  });
});

function opened(seed: number) {
  const user = new RandomUser(seed);
  return { documents: user.documents, act: () => user.act() };
}
