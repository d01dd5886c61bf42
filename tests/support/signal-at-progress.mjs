// Loaded before a program (by NODE_OPTIONS): when its worker reports the first tetrahedra, sends the signal
// TETRAFRONT_TEST_SIGNAL to the program itself, or to its parent if TETRAFRONT_TEST_TARGET is "parent".
import { Worker } from "node:worker_threads";

const { TETRAFRONT_TEST_SIGNAL: signal, TETRAFRONT_TEST_TARGET: target } = process.env;
const { emit } = Worker.prototype;
let isSent = false;
Worker.prototype.emit = function (event, ...args) {
  const [reply] = args;
  if (!isSent && event === "message" && reply?.kind === "progress" && reply.progress.tetrahedra > 0) {
    isSent = true;
    process.kill(target === "parent" ? process.ppid : process.pid, signal);
  }
  return emit.call(this, event, ...args);
};
