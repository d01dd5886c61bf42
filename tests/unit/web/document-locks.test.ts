/** Locks of documents in pages without Web Locks: tabs agree on them. */
import { afterEach, describe, expect, it } from "vitest";
import { ChannelLocks } from "../../../web/session/document-locks";

let tabs: ChannelLocks[] = [];
let pages = 0;

/** Opens tabs of a page of its own. */
function openTabs(count: number): readonly [ChannelLocks, ChannelLocks, ...ChannelLocks[]] {
  pages += 1;
  tabs = Array.from({ length: count }, () => new ChannelLocks(`page ${pages}`));
  const [first, second, ...others] = tabs;
  if (!first || !second) throw new Error("Two tabs at least");
  return [first, second, ...others];
}

afterEach(() => tabs.forEach((tab) => tab.close()));

describe("locks that tabs agree on", () => {
  it("opens a document in one tab only, until that tab leaves or ends", async () => {
    const [first, second] = openTabs(2);
    const release = await first.acquire("part", 100);
    expect(release).not.toBeNull();
    expect(await second.acquire("part", 100)).toBeNull();
    expect(await second.acquire("other", 100)).not.toBeNull();
    expect(await first.openIds()).toEqual(new Set(["part", "other"]));
    release?.();
    expect(await second.acquire("part", 100)).not.toBeNull();
    second.close();
    // What the second tab has said last may arrive after its end.
    expect(await first.acquire("part", 1000)).not.toBeNull();
  });

  it("waits for a tab that is about to leave the document", async () => {
    const [first, second] = openTabs(2);
    const release = await first.acquire("part", 100);
    setTimeout(() => release?.(), 300);
    expect(await second.acquire("part", 3000)).not.toBeNull();
  });

  it("gives a document that many tabs want at the same time to exactly one", async () => {
    const many = openTabs(8);
    const taken = await Promise.all(many.map((tab) => tab.acquire("part", 600)));
    expect(taken.filter((release) => release !== null)).toHaveLength(1);
  });
});
