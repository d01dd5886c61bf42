// Runs the command line for tests, one command after the other, in one process: a short command would spend most of
// its time on starting Node and compiling the engine. Messages name a folder and arguments.
import { setTimeout as sleep } from "node:timers/promises";

import { main } from "../../wasm/dist/cli/main.js";

/** A command that would not let its process end within this time hangs. */
const END_MS = 60_000;

/** Returns what keeps this process alive. */
async function activeResources() {
  await sleep(0);
  return process.getActiveResourcesInfo().sort().join(" ");
}

/** Collects what is written to a stream; returns a function that ends this and returns the text. */
function capture(stream) {
  const pieces = [];
  const { write } = stream;
  stream.write = (piece, encoding, callback = encoding) => {
    pieces.push(typeof piece === "string" ? Buffer.from(piece) : piece);
    if (typeof callback === "function") process.nextTick(callback);
    return true;
  };
  return () => {
    stream.write = write;
    // Each command adds a listener.
    stream.removeAllListeners("error");
    return Buffer.concat(pieces).toString();
  };
}

async function answer({ folder, args }) {
  process.chdir(folder);
  const [stdout, stderr] = [capture(process.stdout), capture(process.stderr)];
  const idle = await activeResources();
  let code = 1;
  let failure = "";
  try {
    code = await main(args);
  } catch (thrown) {
    failure = String(thrown?.stack ?? thrown);
  }
  const result = { code, stdout: stdout(), stderr: stderr() + failure };
  const deadline = performance.now() + END_MS;
  for (let active = await activeResources(); active !== idle; active = await activeResources()) {
    if (performance.now() > deadline)
      throw new Error(`tetrafront ${args.join(" ")} would not end: ${active}`);
    await sleep(1);
  }
  process.send(result);
}

process.on("message", answer);
process.on("disconnect", () => process.exit());
