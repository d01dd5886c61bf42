// Stands for `tetrafront` in tests of examples/cluster: node part-command.mjs LOG MS mesh INPUT ... Writes into the
// log when a part is begun, with its process, and when it has ended. Takes at least so many milliseconds, so that a test can
// kill a machine that meshes. A part called "endless" does not end, and "greedy" uses all memory that it gets.
import { appendFileSync } from "node:fs";
import path from "node:path";
import { setTimeout } from "node:timers/promises";
import { main } from "../../wasm/dist/cli/main.js";

const [log, delay, ...command] = process.argv.slice(2);
const { name } = path.parse(command[1]);
appendFileSync(log, `begin,${name},${process.pid}\n`);
await setTimeout(name === "endless" ? 2 ** 31 - 1 : Number(delay));
for (const held = []; name === "greedy"; await setTimeout(1)) held.push(Buffer.alloc(1 << 24, 1));
process.exitCode = await main(command);
appendFileSync(log, `end,${name}\n`);
