/** A tab that is killed at any moment, by the crash of its process: the page gets no event. */
import { afterEach, beforeEach, expect, it, vi } from "vitest";
import { documentKey } from "../../../web/document/content-keys";
import { Autosave } from "../../../web/session/autosave";
import type { OpenDocument } from "../../../web/session/document-store";
import { openKept, type KeptDocument } from "../../../web/session/kept-document";
import { randomSource } from "../../support/random";
import { RandomUser } from "./random-user";
import { CrashingStorage } from "./storage-doubles";

/** Moments at which the tab is killed. */
const moments = 60;
/** Longest life of a tab, longest pause between two edits, and longest duration of a write, in milliseconds. */
const [longestLife, longestPause, longestWrite] = [1200, 60, 40];
/** An edit is stored after the delay of autosave, a write that was already running, and its own. */
const longestLoss = 20 + 20 + 2 * longestWrite + 1;

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

/** A state of the document in memory, and when it began. */
interface Noted {
  readonly key: string;
  readonly past: number;
  readonly future: number;
  readonly time: number;
}

const keyOf = ({ history }: OpenDocument): string => documentKey(history.present.project);

it(`loses no edit that was stored, and none of more than ${longestLoss} ms ago, at ${moments} random moments`, async () => {
  const random = randomSource(7);
  const below = (limit: number): number => (limit * random()) / 2 ** 32;
  let kept: KeptDocument | undefined;
  let lostEdits = 0;
  for (let moment = 0; moment < moments; ++moment) {
    const user = new RandomUser(moment + 1);
    const { documents } = user;
    const reopened = kept && (await openKept(kept));
    if (reopened) documents.show(reopened);
    const storage = new CrashingStorage(() => 1 + below(longestWrite - 1));
    const autosave = new Autosave(documents, storage);
    const noted: Noted[] = [];
    const note = (): void => {
      const state = documents.state.getState();
      if (state.gestureStart !== null) return;
      const { past, future } = state.history;
      noted.push({ key: keyOf(state), past: past.length, future: future.length, time: Date.now() });
    };
    note();
    const stops = [documents.state.subscribe(note), autosave.follow()];
    await vi.advanceTimersByTimeAsync(longestLoss);
    let stored = noted.length - 1;
    const end = Date.now() + below(longestLife);
    while (Date.now() < end) {
      user.act();
      await vi.advanceTimersByTimeAsync(Math.min(below(longestPause), end - Date.now()));
      if (!autosave.state.getState().pending) stored = noted.length - 1;
    }
    const killed = Date.now();
    storage.kill();
    for (const stop of stops) stop();
    await vi.advanceTimersByTimeAsync(10_000);

    kept = storage.documents.get(documents.state.getState().id);
    const found = kept && (await openKept(kept));
    if (!found) throw new Error(`moment ${moment}: the document is lost`);
    const { past, future } = found.history;
    const index = noted.findLastIndex(
      (one) => one.key === keyOf(found) && one.past === past.length && one.future === future.length,
    );
    // One of the states that the user has seen: nothing is stored in part.
    expect(index, `moment ${moment}`).toBeGreaterThanOrEqual(stored);
    const lost = noted.slice(index + 1);
    for (const { time } of lost) expect(killed - time, `moment ${moment}`).toBeLessThanOrEqual(longestLoss);
    lostEdits += lost.length;
  }
  // Otherwise the moments would prove little.
  expect(lostEdits).toBeGreaterThan(moments / 10);
}, 300_000);
