import { spawn, spawnSync } from "node:child_process";
import { closeSync, mkdirSync, openSync, readFileSync } from "node:fs";
import { availableParallelism } from "node:os";
import path from "node:path";
import { root } from "./paths.mjs";

/** Number of parallel processes: the number of processors, or TETRAFRONT_JOBS. */
export const jobs = Number(process.env.TETRAFRONT_JOBS) || availableParallelism();

/** Runs `work` on each item, `jobs` items at a time; returns the results in the order of the items. */
export async function inParallel(items, work) {
  const answers = Array.from(items, () => undefined);
  const queue = [...items.entries()];
  const worker = async () => {
    for (let next = queue.shift(); next !== undefined; next = queue.shift()) {
      const [at, item] = next;
      answers[at] = await work(item);
    }
  };
  await Promise.all(Array.from({ length: jobs }, worker));
  return answers;
}

/** An error that the user must act on: printed without a stack. */
export class UserError extends Error {}

/**
 * Runs a program with its output on our terminal; resolves with the exit status (1 for a signal). `quietOut`
 * redirects its standard output to standard error, `log` both to a file; `timeout` is in milliseconds.
 */
export async function run(program, args, { cwd = root, env = {}, quietOut = false, log, timeout } = {}) {
  if (log) mkdirSync(path.dirname(log), { recursive: true });
  const file = log ? openSync(log, "w") : undefined;
  try {
    return await new Promise((resolve, reject) => {
      const child = spawn(program, args, {
        cwd,
        env: merged(env),
        timeout,
        stdio: ["ignore", file ?? (quietOut ? 2 : "inherit"), file ?? "inherit"],
      });
      child.on("error", (error) => reject(new UserError(`${program} cannot be started: ${error.message}`)));
      child.on("close", (status) => resolve(status ?? 1));
    });
  } finally {
    if (file !== undefined) closeSync(file);
  }
}

/** As `run`, but throws unless the status is 0. */
export async function must(program, args, options = {}) {
  const status = await run(program, args, options);
  if (status === 0) return;
  if (options.log) say(readFileSync(options.log, "utf8"));
  throw new UserError(`${[program, ...args].join(" ")} failed with status ${status}`);
}

/** Runs a short program; returns its output, or undefined if it fails. */
export function output(program, args, { cwd = root, env = {}, timeout = 60_000 } = {}) {
  const result = spawnSync(program, args, { cwd, env: merged(env), encoding: "utf8", timeout });
  return result.status === 0 ? `${result.stdout}` : undefined;
}

/** Returns our environment with changes; a change to `undefined` removes the variable. */
function merged(changes) {
  const env = { ...process.env, ...changes };
  for (const [name, value] of Object.entries(changes)) if (value === undefined) delete env[name];
  return env;
}

/** Runs a script's main function; a UserError becomes one line on stderr and exit status 1. */
export async function main(body) {
  try {
    await body();
  } catch (error) {
    if (!(error instanceof UserError)) throw error;
    process.stderr.write(`\n${error.message}\n`);
    process.exitCode = 1;
  }
}

export function say(text) {
  process.stderr.write(`${text}\n`);
}
