// Loaded before a program (by NODE_OPTIONS): when its worker reports progress of a call that is no inspection, sends the
// signal TETRAFRONT_TEST_SIGNAL to the program. From then on, the worker is not heard: it is in a call that does not end.
import { Worker } from "node:worker_threads";

const { emit, postMessage } = Worker.prototype;
const calls = new Map();
let isSilent = false;

Worker.prototype.postMessage = function (message, ...args) {
  calls.set(message?.id, message?.call ?? message?.kind);
  return postMessage.call(this, message, ...args);
};

Worker.prototype.emit = function (event, ...args) {
  const [reply] = args;
  if (event !== "message") return emit.call(this, event, ...args);
  if (!isSilent && reply?.kind === "progress" && calls.get(reply.id) !== "inspectSurface") {
    isSilent = true;
    process.stderr.write(`signal at ${Date.now()}\n`);
    process.kill(process.pid, process.env.TETRAFRONT_TEST_SIGNAL);
  }
  return isSilent ? true : emit.call(this, event, ...args);
};
