// What only one process at a time may do, whatever becomes of the others.
import { linkSync, readFileSync, renameSync, rmSync, writeFileSync } from "node:fs";
import { setTimeout as sleep } from "node:timers/promises";

const LOOK_AGAIN_MS = 100;

/** Runs `work` while the file `lock` names this process. Waits for the one that it names; a dead one's is taken over. */
export async function withLock(lock, work) {
  const own = `${lock}.${process.pid}`;
  writeFileSync(own, String(process.pid));
  try {
    while (!isTaken(own, lock)) {
      if (!isFreed(lock, own)) await sleep(LOOK_AGAIN_MS);
    }
  } finally {
    rmSync(own, { force: true });
  }
  try {
    return await work();
  } finally {
    rmSync(lock, { force: true });
  }
}

/** A link appears whole, or not at all where the name is taken. */
function isTaken(own, lock) {
  try {
    linkSync(own, lock);
    return true;
  } catch (failure) {
    if (failure.code === "EEXIST") return false;
    throw failure;
  }
}

/** Whether the lock was that of a dead process and is no more. Of two who find it so, one moves it aside. */
function isFreed(lock, own) {
  const owner = ownerOf(lock);
  if (owner === undefined || isAlive(owner)) return owner === undefined;
  const aside = `${own}.dead`;
  try {
    renameSync(lock, aside);
  } catch {
    return true;
  }
  // Between the two looks another may have taken it: that one gets it back.
  if (ownerOf(aside) !== owner) isTaken(aside, lock);
  rmSync(aside, { force: true });
  return true;
}

function ownerOf(file) {
  try {
    return Number(readFileSync(file, "utf8"));
  } catch {
    return undefined;
  }
}

function isAlive(owner) {
  try {
    process.kill(owner, 0);
    return true;
  } catch (failure) {
    return failure.code === "EPERM";
  }
}
