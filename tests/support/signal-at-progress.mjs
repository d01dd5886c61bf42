// Loaded before a program (by NODE_OPTIONS): when its worker reports the first tetrahedra, or the fraction
// TETRAFRONT_TEST_FRACTION of a call that is no inspection, sends the signal TETRAFRONT_TEST_SIGNAL to the program
// itself, or to its parent if TETRAFRONT_TEST_TARGET is "parent".
import { closeSync, openSync } from "node:fs";
import { Worker } from "node:worker_threads";

const {
  TETRAFRONT_TEST_SIGNAL: signal,
  TETRAFRONT_TEST_TARGET: target,
  TETRAFRONT_TEST_FRACTION: fraction,
} = process.env;
const { emit, postMessage } = Worker.prototype;
/** Call of each question to a worker, by id. */
const calls = new Map();
let isSent = false;

/** Returns whether no other child of the parent has sent the signal: a second one would end the parent at once. */
function isFirstChild() {
  try {
    closeSync(openSync(`signal-to-${process.ppid}`, "wx"));
    return true;
  } catch {
    return false;
  }
}

/** Returns whether the moment has come. */
function isDue(id, { tetrahedra, fraction: reached }) {
  if (fraction === undefined) return tetrahedra > 0;
  return calls.get(id) !== "inspectSurface" && reached > Number(fraction);
}

Worker.prototype.postMessage = function (message, ...args) {
  calls.set(message?.id, message?.call ?? message?.kind);
  return postMessage.call(this, message, ...args);
};

Worker.prototype.emit = function (event, ...args) {
  const [reply] = args;
  if (!isSent && event === "message" && reply?.kind === "progress" && isDue(reply.id, reply.progress)) {
    isSent = true;
    if (target !== "parent") process.kill(process.pid, signal);
    else if (isFirstChild()) process.kill(process.ppid, signal);
  }
  return emit.call(this, event, ...args);
};
