// Work that only one process at a time may do, even if a process dies meanwhile.
import { linkSync, readFileSync, renameSync, rmSync, writeFileSync } from "node:fs";
import { setTimeout as sleep } from "node:timers/promises";

const LOOK_AGAIN_MS = 100;

/**
 * Runs `work` while the file `lock` names this process. Waits for the process that it names; takes over the lock
 * of a dead one.
 */
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

/** Creating a link is atomic and fails if the name exists. */
function isTaken(own, lock) {
  try {
    linkSync(own, lock);
    return true;
  } catch (failure) {
    if (failure.code === "EEXIST") return false;
    throw failure;
  }
}

/**
 * Returns whether the lock belonged to a dead process and is now free. If two processes notice this, only one
 * moves the lock aside.
 */
function isFreed(lock, own) {
  const owner = ownerOf(lock);
  if (owner === undefined || isAlive(owner)) return owner === undefined;
  const aside = `${own}.dead`;
  try {
    renameSync(lock, aside);
  } catch {
    return true;
  }
  // If another process took the lock between the two checks, it gets the lock back.
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
