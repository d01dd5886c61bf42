import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { moveEntity, renameProject } from "../../../web/document/edits";
import { Autosave } from "../../../web/session/autosave";
import { DocumentStore, newDocument } from "../../../web/session/document-store";
import { openKept } from "../../../web/session/kept-document";
import { cubeProject } from "../../support/projects";
import { randomSource } from "../../support/random";
import { MemoryStorage, UnreliableStorage } from "./storage-doubles";

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

/** Milliseconds; longer than the delay between an edit and its write. */
const shortly = 50;

function following<Storage extends MemoryStorage>(storage: Storage) {
  const documents = new DocumentStore(cubeProject(), () => 0);
  const autosave = new Autosave(documents, storage);
  autosave.follow();
  const keptName = (id = documents.state.getState().id) => storage.documents.get(id)?.name;
  return { documents, storage, autosave, keptName };
}

/** A page whose events are dispatched by hand. */
function fakePage(autosave: Autosave) {
  const window = new EventTarget();
  const visible: { visibilityState: DocumentVisibilityState } = { visibilityState: "visible" };
  const document = Object.assign(new EventTarget(), visible);
  const stop = autosave.followPage({ window, document });
  return { window, document, stop };
}

describe("autosave", () => {
  it("writes a document when it is opened, and within a few milliseconds after each edit", async () => {
    const { documents, autosave, keptName } = following(new MemoryStorage());
    await vi.advanceTimersByTimeAsync(shortly);
    expect(keptName()).toBe("Unit cube");
    documents.edit(renameProject("edited"));
    expect(autosave.state.getState().pending).toBe(true);
    await vi.advanceTimersByTimeAsync(shortly);
    expect(keptName()).toBe("edited");
    expect(autosave.state.getState()).toEqual({ pending: false, failure: null });
    documents.undo();
    await vi.advanceTimersByTimeAsync(shortly);
    expect(keptName()).toBe("Unit cube");
  });

  it("writes a burst of edits once, without waiting for its end", async () => {
    const { documents, storage, keptName } = following(new MemoryStorage());
    await vi.advanceTimersByTimeAsync(shortly);
    const before = storage.writes;
    for (let i = 0; i < 10; ++i) documents.edit(renameProject(`name ${i}`));
    await vi.advanceTimersByTimeAsync(shortly);
    expect(storage.writes).toBe(before + 1);
    for (let i = 0; i < 100; ++i) {
      documents.edit(renameProject(`name ${i}`));
      await vi.advanceTimersByTimeAsync(10);
    }
    expect(keptName()).not.toBe("name 9");
  });

  it("writes as quickly after a slow write", async () => {
    const { documents, storage, keptName } = following(new MemoryStorage());
    storage.latency = 400;
    await vi.advanceTimersByTimeAsync(2 * storage.latency);
    documents.edit(renameProject("edited"));
    await vi.advanceTimersByTimeAsync(shortly);
    expect(keptName()).toBe("edited");
  });

  it.each(["pagehide", "beforeunload"])("writes at once on %s alone", async (event) => {
    const { documents, autosave, storage, keptName } = following(new MemoryStorage());
    await vi.advanceTimersByTimeAsync(shortly);
    const { window, stop } = fakePage(autosave);
    documents.edit(renameProject("last edit"));
    const before = storage.writes;
    window.dispatchEvent(new Event(event, { cancelable: true }));
    // A page that is being left runs no timers.
    expect(storage.writes).toBe(before + 1);
    expect(keptName()).toBe("last edit");
    stop();
    documents.edit(renameProject("after"));
    window.dispatchEvent(new Event(event));
    expect(keptName()).toBe("last edit");
  });

  it("writes at once when the page is hidden, but not when it is shown", async () => {
    const { documents, autosave, keptName } = following(new MemoryStorage());
    await vi.advanceTimersByTimeAsync(shortly);
    const { document } = fakePage(autosave);
    documents.edit(renameProject("last edit"));
    document.dispatchEvent(new Event("visibilitychange"));
    expect(keptName()).toBe("Unit cube");
    document.visibilityState = "hidden";
    document.dispatchEvent(new Event("visibilitychange"));
    expect(keptName()).toBe("last edit");
  });

  it("warns when the user leaves the page only if a change is not yet written", async () => {
    const { documents, autosave } = following(new MemoryStorage());
    await vi.advanceTimersByTimeAsync(shortly);
    const { window } = fakePage(autosave);
    const leave = (): boolean => !window.dispatchEvent(new Event("beforeunload", { cancelable: true }));
    expect(leave()).toBe(false);
    documents.edit(renameProject("edited"));
    expect(leave()).toBe(true);
    await vi.advanceTimersByTimeAsync(shortly);
    expect(leave()).toBe(false);
  });

  it("reports a failure of the storage, retries by itself and reports the success", async () => {
    const { documents, storage, autosave, keptName } = following(new MemoryStorage());
    await vi.advanceTimersByTimeAsync(shortly);
    storage.failure = "no space";
    documents.edit(renameProject("kept in the end"));
    await vi.advanceTimersByTimeAsync(shortly);
    expect(autosave.state.getState()).toEqual({ pending: true, failure: "no space" });
    await vi.advanceTimersByTimeAsync(60_000);
    const attempts = storage.writes;
    expect(attempts).toBeGreaterThan(5);
    // The time between attempts grows, but stays below a minute.
    expect(attempts).toBeLessThan(15);
    storage.failure = null;
    await vi.advanceTimersByTimeAsync(60_000);
    expect(keptName()).toBe("kept in the end");
    expect(autosave.state.getState()).toEqual({ pending: false, failure: null });
  });

  it("keeps a document that is no longer open in its queue until the storage works again", async () => {
    const { documents, storage, keptName } = following(new MemoryStorage());
    await vi.advanceTimersByTimeAsync(shortly);
    storage.failure = "no space";
    documents.edit(renameProject("left behind"));
    await vi.advanceTimersByTimeAsync(shortly);
    const { id } = documents.show(newDocument({ ...cubeProject(), name: "next" }));
    await vi.advanceTimersByTimeAsync(shortly);
    storage.failure = null;
    await vi.advanceTimersByTimeAsync(60_000);
    expect(keptName(id)).toBe("left behind");
    expect(keptName()).toBe("next");
  });

  it("does not let an older state of a document overwrite a newer one after a failure", async () => {
    const { documents, storage, autosave, keptName } = following(new MemoryStorage());
    await vi.advanceTimersByTimeAsync(shortly);
    storage.failure = "no space";
    documents.edit(renameProject("older"));
    const failing = autosave.flush();
    documents.edit(renameProject("newer"));
    await failing;
    storage.failure = null;
    await vi.advanceTimersByTimeAsync(60_000);
    expect(keptName()).toBe("newer");
  });

  it("stores every edit if writes begin while others are under way, and some fail", async () => {
    const random = randomSource(3);
    const below = (limit: number): number => random() % limit;
    for (let sequence = 0; sequence < 100; ++sequence) {
      const storage = new UnreliableStorage(() => ({ fails: below(4) === 0, after: below(60) }));
      const { documents, autosave } = following(storage);
      for (let i = 0; i < 20; ++i) {
        if (below(4) === 0) documents.undo();
        else {
          const point = { id: 100 + i, name: "x".repeat(below(3) * 9_000), position: [i, 0, 0] as const };
          documents.edit({
            label: "Add",
            replace: { points: [...documents.project.points, point] },
          });
        }
        if (below(2) === 0) void autosave.flush();
        await vi.advanceTimersByTimeAsync(below(100));
      }
      storage.isRepaired = true;
      await vi.advanceTimersByTimeAsync(60_000);
      expect(autosave.state.getState().pending).toBe(false);
      const kept = storage.documents.get(documents.state.getState().id);
      const opened = kept && (await openKept(kept));
      const { present, past, future } = documents.state.getState().history;
      expect(opened?.history.present.project).toEqual(present.project);
      expect([opened?.history.past.length, opened?.history.future.length]).toEqual([
        past.length,
        future.length,
      ]);
    }
  });

  it("writes the whole document again if the storage has lost it", async () => {
    const { documents, storage, autosave, keptName } = following(new MemoryStorage());
    await vi.advanceTimersByTimeAsync(shortly);
    storage.documents.clear();
    documents.edit(renameProject("edited"));
    await vi.advanceTimersByTimeAsync(5000);
    expect(autosave.state.getState()).toEqual({ pending: false, failure: null });
    expect(keptName()).toBe("edited");
  });

  it("keeps what was written last if two tabs without locks write one document", async () => {
    const { documents, storage, autosave } = following(new MemoryStorage());
    await vi.advanceTimersByTimeAsync(shortly);
    documents.edit(renameProject("first"));
    await vi.advanceTimersByTimeAsync(shortly);
    const { id } = documents.state.getState();
    const opened = async () => {
      const kept = await storage.read(id);
      return (kept && (await openKept(kept))) ?? newDocument(cubeProject());
    };
    const others = new DocumentStore(cubeProject(), () => 0);
    others.show(await opened());
    new Autosave(others, storage).follow();
    await vi.advanceTimersByTimeAsync(shortly);
    others.edit(moveEntity("point", 1, 0, 5));
    others.edit(moveEntity("point", 2, 0, 6));
    await vi.advanceTimersByTimeAsync(shortly);
    // This change continues a content that the other tab has replaced.
    documents.edit(renameProject("last"));
    await vi.advanceTimersByTimeAsync(shortly);
    expect((await opened()).history).toMatchObject({ present: { project: others.project } });
    await vi.advanceTimersByTimeAsync(5000);
    expect(autosave.state.getState()).toEqual({ pending: false, failure: null });
    expect((await opened()).history.present.project).toEqual(documents.project);
  });

  it("begins no change at a content that is about to be replaced", async () => {
    const { documents, storage, autosave } = following(new MemoryStorage());
    await vi.advanceTimersByTimeAsync(shortly);
    const failures: (string | null)[] = [];
    autosave.state.subscribe(({ failure }) => failures.push(failure));
    storage.latency = 400;
    // Too long for a change.
    documents.edit(renameProject("x".repeat(300_000)));
    void autosave.flush();
    documents.undo();
    documents.edit(renameProject("last"));
    void autosave.flush();
    await vi.advanceTimersByTimeAsync(5000);
    expect(failures.filter((failure) => failure !== null)).toEqual([]);
    const kept = await storage.read(documents.state.getState().id);
    expect((kept && (await openKept(kept)))?.history.present.project).toEqual(documents.project);
  });

  it("writes a gesture when it ends, but not a cancelled one", async () => {
    const { documents, storage } = following(new MemoryStorage());
    await vi.advanceTimersByTimeAsync(shortly);
    const before = storage.writes;
    const cancelled = documents.begin("Drag");
    cancelled.update(moveEntity("point", 1, 0, 5));
    await vi.advanceTimersByTimeAsync(shortly);
    cancelled.cancel();
    await vi.advanceTimersByTimeAsync(shortly);
    expect(storage.writes).toBe(before);
    const gesture = documents.begin("Drag");
    gesture.update(moveEntity("point", 1, 0, 6));
    await vi.advanceTimersByTimeAsync(shortly);
    expect(storage.writes).toBe(before);
    gesture.commit();
    await vi.advanceTimersByTimeAsync(shortly);
    expect(storage.writes).toBe(before + 1);
  });

  it("lists a document after its first change", async () => {
    const { documents, storage } = following(new MemoryStorage());
    await vi.advanceTimersByTimeAsync(shortly);
    expect(await storage.list()).toEqual([]);
    documents.edit(renameProject("edited"));
    await vi.advanceTimersByTimeAsync(shortly);
    expect((await storage.list()).map(({ name }) => name)).toEqual(["edited"]);
  });
});
