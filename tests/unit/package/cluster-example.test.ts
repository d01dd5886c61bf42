/** The example of many parts: limits, interruptions, a Slurm script, and, if Python has Ray, a cluster that loses a node. */
import { type ChildProcess, execFile, spawn, spawnSync } from "node:child_process";
import { once } from "node:events";
import { existsSync, mkdirSync, readdirSync, readFileSync, statSync } from "node:fs";
import path from "node:path";
import { createInterface } from "node:readline";
import type { Readable } from "node:stream";
import { setTimeout } from "node:timers/promises";
import { fileURLToPath } from "node:url";
import { promisify } from "node:util";

import { describe, expect, test } from "vitest";
import { offFile } from "../../support/surface-files.js";
import { boxSurface } from "../../support/surfaces.js";
import { temporaryFolder } from "../../support/temporary-folder.js";

const python = process.env["TETRAFRONT_PYTHON"] ?? "python3";
const inTests = (name: string) => fileURLToPath(new URL(`../../${name}`, import.meta.url));
const example = inTests("../examples/cluster/mesh_parts.py");
const isAvailable = spawnSync(python, ["-c", "import ray"]).status === 0;

/** A busy machine takes minutes to start the 10 programs of a cluster. */
const CLUSTER_LIMIT = { timeout: 600_000 };

type Row = Readonly<Record<string, string>>;

describe("the example of many parts", () => {
  const folder = temporaryFolder();
  const parts = () => folder.inFolder("parts");
  const inOut = (name: string) => folder.inFolder(path.join("out", name));

  /** Writes boxes of these names; returns the arguments of a run, whose starts and ends of parts go into a log. */
  function saveBoxes(names: readonly string[], delay = 0): string[] {
    mkdirSync(parts(), { recursive: true });
    for (const name of names) folder.save(`parts/${name}.off`, offFile(boxSurface(2)));
    const command = [process.execPath, inTests("support/part-command.mjs"), folder.inFolder("log"), delay];
    return [example, parts(), folder.inFolder("out"), "--command", command.join(" ")];
  }

  /** Lines of the log: an event, the part, and its process. */
  const logged = () =>
    existsSync(folder.inFolder("log"))
      ? readFileSync(folder.inFolder("log"), "utf8")
          .trim()
          .split("\n")
          .map((line) => line.split(","))
      : [];

  /** How often each part was begun, or has ended. */
  function counted(what: "begin" | "end"): Record<string, number> {
    const counts: Record<string, number> = {};
    for (const [event, name = ""] of logged()) {
      if (event === what) counts[name] = (counts[name] ?? 0) + 1;
    }
    return counts;
  }

  /** Reads the table; no field of these tests has a comma. */
  function table(): Row[] {
    const [head = "", ...lines] = readFileSync(inOut("parts.csv"), "utf8").trim().split("\n");
    const columns = head.split(",");
    return lines.map((line) =>
      Object.fromEntries(line.split(",").map((field, c) => [columns[c] ?? "", field])),
    );
  }

  const rowOf = (part: string) => table().find((row) => row["part"] === part);
  const run = (args: readonly string[], env = {}) =>
    promisify(execFile)(python, args, { env: { ...process.env, ...env } });

  test("ends a part at its limits, and says why; the next one is meshed", async () => {
    const args = saveBoxes(["endless", "greedy", "plain"]);
    const mesh = (part: string, ...limits: string[]) => run([...args, "--part", part, ...limits]);
    await expect(mesh("endless.off", "--minutes", "0.02")).rejects.toMatchObject({ code: 1 });
    await expect(mesh("greedy.off", "--memory", "400M")).rejects.toMatchObject({ code: 1 });
    await mesh("plain.off");
    expect(rowOf("endless.off")?.["reason"]).toBe("out of time: more than 0.02 minutes (--minutes)");
    expect(rowOf("greedy.off")?.["reason"]).toBe("out of memory: more than 400 MB (--memory)");
    expect(rowOf("plain.off")).toMatchObject({ status: "done", volume: "1", mesh: "plain.vtu" });
    expect(counted("end")).toEqual({ plain: 1 });
  });

  test("meshes a part again only if it failed, or if its file or its options have changed", async () => {
    const args = saveBoxes(["a", "b"]);
    folder.save("parts/b.off", "OFF\n1");
    const mesh = async (...options: string[]) => {
      for (const part of ["a.off", "b.off"]) await run([...args, "--part", part, ...options]).catch(() => 1);
      return [rowOf("a.off")?.["status"], rowOf("b.off")?.["status"]];
    };
    expect(await mesh()).toEqual(["done", "failed"]);
    expect(rowOf("b.off")?.["reason"]).toMatch(/the file is truncated/);
    expect(await mesh()).toEqual(["done", "failed"]);
    expect(counted("begin")).toEqual({ a: 1, b: 2 });
    saveBoxes(["b"]);
    expect(await mesh()).toEqual(["done", "done"]);
    const coarse = Number(rowOf("a.off")?.["tetrahedra"]);
    expect(await mesh("--", "--size", "0.2")).toEqual(["done", "done"]);
    expect(Number(rowOf("a.off")?.["tetrahedra"])).toBeGreaterThan(2 * coarse);
    expect(counted("begin")).toEqual({ a: 2, b: 4 });
  });

  test("prints a job array for Slurm that meshes each part once and writes the table", async () => {
    const args = saveBoxes(["a", "b c", "done"]);
    await run([...args, "--part", "done.off"]);
    const { stdout } = await run([
      ...args,
      "--slurm",
      "--minutes",
      "5",
      "--memory",
      "1G",
      "--",
      "--size",
      "0.5",
    ]);
    // With other options, the mesh that is there is not what is asked for.
    expect(stdout).toContain("#SBATCH --array=0-2\n");
    expect(stdout).toContain("#SBATCH --time=6\n");
    folder.save("job.sh", stdout);
    for (const element of ["0", "1", "2"]) {
      const env = { ...process.env, SLURM_ARRAY_TASK_ID: element };
      await promisify(execFile)("bash", [folder.inFolder("job.sh")], { env });
      expect(existsSync(inOut("parts.csv")), "the last element writes the table").toBe(element === "2");
    }
    expect(table().map((row) => [row["part"], row["status"]])).toEqual([
      ["a.off", "done"],
      ["b c.off", "done"],
      ["done.off", "done"],
    ]);
    const { stdout: rest } = await run([...args, "--slurm", "--", "--size", "0.5"]);
    expect(rest).toBe("");
    expect(counted("end")).toEqual({ a: 1, "b c": 1, done: 2 });
  });

  if (existsSync("/usr/bin/setpriv")) {
    test("leaves no process behind if it is killed", async () => {
      const args = saveBoxes(["endless"]);
      const killed = spawn(python, [...args, "--part", "endless.off"], { stdio: "ignore" });
      while (logged().length === 0) await setTimeout(20);
      killed.kill("SIGKILL");
      const id = Number(logged()[0]?.[2]);
      while (isAlive(id)) await setTimeout(20);
      expect(existsSync(inOut("endless.report.json"))).toBe(false);
    });
  }

  test("says how to install Ray if it is missing", async () => {
    const args = saveBoxes(["a"]);
    folder.save("ray.py", "raise ImportError");
    const failed = run(args, { PYTHONPATH: folder.path });
    await expect(failed).rejects.toMatchObject({
      code: 1,
      stderr: expect.stringMatching(/pip install ray/) as string,
    });
  });

  test("refuses parts whose meshes would have one name, and folders without parts", async () => {
    const args = saveBoxes(["a"]);
    folder.save("parts/a.stl", "");
    await expect(run(args)).rejects.toMatchObject({
      stderr: "a.off and a.stl would have meshes of the same name: rename one of them.\n",
    });
    const empty = run([example, folder.inFolder("out"), folder.inFolder("meshes")]);
    mkdirSync(folder.inFolder("out"), { recursive: true });
    await expect(empty).rejects.toMatchObject({ code: 1 });
  });

  if (isAvailable) {
    test(
      "every part is done once, although a machine dies and the run is killed",
      CLUSTER_LIMIT,
      async () => {
        const names = ["a", "b", "c", "d"];
        const args = saveBoxes(names, 1000);
        folder.save("parts/damaged.off", "OFF\n1");
        const cluster = spawn(python, [inTests("support/ray_cluster.py")], {
          stdio: ["pipe", "pipe", "ignore"],
        });
        const isOver = once(cluster, "exit");
        const said = createInterface({ input: cluster.stdout })[Symbol.asyncIterator]();
        try {
          const { value: address } = (await said.next()) as { value: string };
          expect(address, "the cluster starts").toMatch(/:\d+$/);
          const start = () =>
            spawn(python, [...args, "--address", address], { stdio: ["ignore", "pipe", "ignore"] });
          const first = start();
          const isNoticed = printed(first, / on try 1 of 5/);
          cluster.stdin.write("kill\n");
          expect((await said.next()).value).toMatch(/^[0-9a-f]{56}$/);
          await isNoticed;
          const kept = await reportsAfter(first, 3);
          first.kill("SIGKILL");
          await once(first, "exit");
          const second = start();
          second.stdout.resume();
          const [code] = (await once(second, "exit")) as [number];
          expect(code, "one part is damaged").toBe(1);
          expect(table().map((row) => [row["part"], row["status"]])).toEqual([
            ["a.off", "done"],
            ["b.off", "done"],
            ["c.off", "done"],
            ["d.off", "done"],
            ["damaged.off", "failed"],
          ]);
          const ended = counted("end");
          for (const { name, changed } of kept) {
            expect(statSync(inOut(`${name}.report.json`)).mtimeMs, name).toBe(changed);
            expect(ended[name], name).toBe(1);
          }
        } finally {
          cluster.stdin.end();
          await isOver;
        }
      },
    );
  }

  /** Waits until a run has reported so many parts; returns the files of the reports of those that are done. */
  async function reportsAfter(process: ChildProcess, count: number) {
    const reports = () => (existsSync(inOut("")) ? readdirSync(inOut("")) : []).filter(isReport);
    while (reports().length < count && !hasEnded(process)) await setTimeout(50);
    return reports()
      .filter(
        (name) => (JSON.parse(readFileSync(inOut(name), "utf8")) as { row: Row }).row["status"] === "done",
      )
      .map((name) => ({ name: name.replace(REPORT, ""), changed: statSync(inOut(name)).mtimeMs }));
  }
});

const REPORT = /(?<=^[^.]+)\.report\.json$/;
const isReport = (name: string) => REPORT.test(name);

/** Resolves when a process has printed a line that matches; rejects if it ends before. */
async function printed(
  process: ChildProcess & { readonly stdout: Readable },
  pattern: RegExp,
): Promise<void> {
  let text = "";
  process.stdout.on("data", (piece: Buffer) => (text += piece.toString()));
  while (!pattern.test(text)) {
    if (hasEnded(process)) throw new Error(`ended with ${process.exitCode ?? "a signal"}: ${text}`);
    await setTimeout(20);
  }
}

const hasEnded = (process: ChildProcess) => process.exitCode !== null || process.signalCode !== null;

function isAlive(id: number): boolean {
  try {
    process.kill(id, 0);
    return true;
  } catch {
    return false;
  }
}
