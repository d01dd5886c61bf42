import { describe, expect, it } from "vitest";
import { DocumentLibrary, maxListedDocuments } from "../../../web/session/document-library";
import { DocumentStore, newDocument } from "../../../web/session/document-store";
import { cubeProject } from "../../support/projects";
import { keptDocument, MemoryLocks, MemoryStorage, MemoryTab } from "./storage-doubles";

/** A browser with any number of tabs. */
function browser() {
  const storage = new MemoryStorage();
  const locks = new MemoryLocks();
  const openTab = (memory = new MemoryTab()) => ({
    memory,
    library: new DocumentLibrary(storage, locks, memory),
  });
  const keep = async (name: string, at: number, isListed = true): Promise<string> => {
    const document = keptDocument(newDocument({ ...cubeProject(), name }), at, isListed);
    await storage.write(document);
    return document.id;
  };
  /** Closes the tab. Its memory remains for a reload. */
  const close = ({ memory }: { readonly memory: MemoryTab }): void => void locks.held.delete(memory.id ?? "");
  return { storage, locks, openTab, keep, close };
}

/** A document of the reader's own. */

const nameOf = (opened: Awaited<ReturnType<DocumentLibrary["resume"]>>): string | undefined =>
  opened?.document.history.present.project.name;

describe("the library of kept documents", () => {
  it("gives four reloaded tabs their own documents, in any order and whichever changed last", async () => {
    const { openTab, keep, close } = browser();
    const tabs = await Promise.all(
      ["a", "b", "c", "d"].map(async (name, i) => {
        const tab = openTab();
        tab.library.keepOpen({ id: await keep(name, i) });
        return tab;
      }),
    );
    tabs.forEach(close);
    const names: (string | undefined)[] = [];
    for (const { memory } of [...tabs].reverse()) {
      const { library } = openTab(memory);
      const resumed = await library.resume();
      if (resumed) library.keepOpen(resumed.document, resumed.release);
      names.push(nameOf(resumed));
    }
    expect(names).toEqual(["d", "c", "b", "a"]);
  });

  it("opens the document used last in a new tab, but only if no other tab is open", async () => {
    const { openTab, keep, close } = browser();
    await keep("older", 1);
    const last = await keep("last", 2);
    const first = openTab();
    const resumed = await first.library.resume();
    expect(nameOf(resumed)).toBe("last");
    if (resumed) first.library.keepOpen(resumed.document, resumed.release);
    const second = openTab();
    expect(await second.library.resume()).toBeNull();
    expect(await second.library.take(last)).toBe("open-in-another-tab");
    close(first);
    expect(nameOf(await second.library.resume())).toBe("last");
  });

  it("lists a file that is opened again once, and keeps what was changed or is open in another tab", async () => {
    const { openTab, storage } = browser();
    const [first, second] = [openTab(), openTab()];
    const opened = async (at: number) => {
      const document = newDocument({ ...cubeProject(), name: "part" });
      await storage.write(keptDocument(document, at, true));
      return document;
    };
    const earlier = await opened(1);
    const elsewhere = await opened(2);
    second.library.keepOpen(elsewhere);
    const changed = await opened(3);
    const documents = new DocumentStore(cubeProject());
    documents.show(changed);
    documents.edit({ label: "Rename", change: (draft) => void (draft.project.name = "part, mine") });
    documents.edit({ label: "Rename", change: (draft) => void (draft.project.name = "part") });
    await storage.write(keptDocument(documents.state.getState(), 4, true));
    const again = await opened(5);
    // The first tab leaves the file that it opens again.
    first.library.keepOpen(earlier);
    first.library.keepOpen(again);
    await first.library.removeTwins(again);
    const ids = (await first.library.list()).map(({ id }) => id);
    expect(ids).toEqual([again.id, changed.id, elsewhere.id]);
    expect(ids).not.toContain(earlier.id);
  });

  it("gives a duplicated tab a copy of its own", async () => {
    const { openTab, keep } = browser();
    const id = await keep("original", 1);
    const first = openTab();
    first.library.keepOpen({ id });
    const duplicate = openTab(Object.assign(new MemoryTab(), { id }));
    const resumed = await duplicate.library.resume();
    expect(nameOf(resumed)).toBe("original");
    expect(resumed?.document.id).not.toBe(id);
  });

  it("gives a copy of a document that another tab has opened meanwhile", async () => {
    const { openTab } = browser();
    const document = newDocument(cubeProject());
    const [first, second] = [openTab(), openTab()];
    const taken = await first.library.retake(document);
    expect(taken.document).toBe(document);
    const copy = await second.library.retake(document);
    expect(copy.document.id).not.toBe(document.id);
    expect(copy.document.history).toBe(document.history);
    taken.release();
    expect((await second.library.retake(document)).document).toBe(document);
  });

  it("states in which tab a document is open", async () => {
    const { openTab, keep } = browser();
    const ids = await Promise.all(["other", "own", "closed"].map((name, i) => keep(name, i)));
    const [other, own] = [openTab(), openTab()];
    other.library.keepOpen({ id: ids[0] ?? "" });
    own.library.keepOpen({ id: ids[1] ?? "" });
    const listed = await own.library.list();
    expect(listed.map(({ name, openIn }) => [name, openIn])).toEqual([
      ["closed", null],
      ["own", "this-tab"],
      ["other", "another-tab"],
    ]);
  });

  it("finds the document that would be continued if it has changes in no file", async () => {
    const { storage, openTab, keep } = browser();
    await keep("saved", 1);
    expect(await openTab().library.unsaved()).toBeNull();
    const document = newDocument({ ...cubeProject(), name: "drawn" });
    await storage.write({ ...keptDocument(document, 2, true), savedKey: "of another state" });
    const tab = openTab();
    expect(await tab.library.unsaved()).toEqual({ id: document.id, name: "drawn" });
    // It is not locked.
    expect(nameOf(await tab.library.resume())).toBe("drawn");
    // The document of this tab comes before the one used last.
    const memory = new MemoryTab();
    memory.write(await keep("mine", 0));
    expect(await openTab(memory).library.unsaved()).toBeNull();
  });

  it("releases a document when another one is opened", async () => {
    const { openTab, keep, locks } = browser();
    const [a, b] = [await keep("a", 1), await keep("b", 2)];
    const { library } = openTab();
    library.keepOpen({ id: a });
    library.keepOpen({ id: b });
    await Promise.resolve();
    await Promise.resolve();
    expect([...locks.held]).toEqual([b]);
  });

  it("lists only changed documents, the latest first, and which of them are open", async () => {
    const { openTab, keep } = browser();
    const a = await keep("a", 1);
    await keep("b", 3);
    await keep("untouched", 2, false);
    const { library } = openTab();
    library.keepOpen({ id: a });
    const listed = (await library.list()).map(({ name, openIn }) => [name, openIn]);
    expect(listed).toEqual([
      ["b", null],
      ["a", "this-tab"],
    ]);
  });

  it("removes unchanged documents and the oldest beyond its limit, but no open ones", async () => {
    const { openTab, keep, storage } = browser();
    const oldest = await keep("oldest", 0);
    await keep("second", 1);
    for (let i = 0; i < maxListedDocuments; ++i) await keep(`document ${i}`, 10 + i);
    await keep("untouched", 5, false);
    const open = await keep("untouched and open", 5, false);
    const [first, second] = [openTab(), openTab()];
    first.library.keepOpen({ id: oldest });
    second.library.keepOpen({ id: open });
    await first.library.clean();
    const names = [...storage.documents.values()].map(({ name }) => name);
    expect(names).toHaveLength(maxListedDocuments + 2);
    expect(names).toEqual(expect.arrayContaining(["oldest", "untouched and open", "document 0"]));
    expect(names).not.toContain("second");
    expect(names).not.toContain("untouched");
  });

  it("keeps a new document though the machine is busy: its lock comes late, and it is stored during a cleaning", async () => {
    const { openTab, storage, locks, keep } = browser();
    const busy = {
      openIds: () => locks.openIds(),
      // A lock that comes after 3 s, unless the tab waits less.
      acquire: (id: string, patience: number) =>
        patience < 3000 ? Promise.resolve(null) : locks.acquire(id),
    };
    const second = new DocumentLibrary(storage, busy, new MemoryTab());
    const list = storage.list.bind(storage);
    storage.list = async () => {
      const opened = await keep("new", 5, false);
      second.keepOpen({ id: opened });
      return list();
    };
    await openTab().library.clean();
    expect([...storage.documents.values()].map(({ name }) => name)).toEqual(["new"]);
  });

  it("reports why a document cannot be opened, and does not lock it", async () => {
    const { openTab, storage, locks, keep } = browser();
    const { library } = openTab();
    expect(await library.take("unknown")).toBe("missing");
    const id = await keep("damaged", 1);
    const kept = storage.documents.get(id);
    if (kept) storage.documents.set(id, { ...kept, content: { ...kept.content, text: "{ not JSON" } });
    expect(await library.take(id)).toBe("unreadable");
    expect(locks.held.size).toBe(0);
  });
});
