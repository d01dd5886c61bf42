import { describe, expect, it } from "vitest";
import { createMesher, type Mesher, type Phase, type Progress, type RunControl } from "tetrafront";
import { emptyProject } from "../../../web/document/create";
import { MeshRun, type LogLine } from "../../../web/session/run";
import { DocumentStore } from "../../../web/session/document-store";

const report = (phase: Phase, elapsedSeconds: number): Progress => ({
  phase,
  fraction: 0,
  nodes: 0,
  triangles: 0,
  tetrahedra: 0,
  frontFaces: 0,
  expectedTetrahedra: 0,
  exactFillFraction: 0,
  elapsedSeconds,
});

/** Runs with these progress reports and without a result. Returns the reports that the page shows, and the log. */
async function shownAndLogged(reports: readonly Progress[]): Promise<[Progress[], readonly LogLine[]]> {
  const real = await createMesher();
  const mesher: Mesher = Object.assign(Object.create(real) as Mesher, {
    meshProject: (_project: unknown, _options: unknown, control: { onProgress: (p: Progress) => void }) => {
      for (const progress of reports) control.onProgress(progress);
      return real.meshProject(emptyProject("nothing"));
    },
  });
  const run = new MeshRun(new DocumentStore(emptyProject("nothing")), Promise.resolve(mesher));
  const states: Progress[] = [];
  run.state.subscribe(({ progress }, before) => {
    if (progress && progress !== before.progress) states.push(progress);
  });
  await run.generate();
  real.dispose();
  return [states, run.state.getState().log];
}

const shown = async (reports: readonly Progress[]): Promise<Progress[]> => (await shownAndLogged(reports))[0];

describe("the progress of a run", () => {
  it("is shown at longer intervals in a long run, but at most 1.1 s apart", async () => {
    const reports = Array.from({ length: 1000 }, (_, i) => report("optimize", 0.1 * i));
    const states = await shown(reports);
    expect(states.length).toBeLessThan(200);
    states.slice(1).forEach(({ elapsedSeconds }, i) => {
      const wait = elapsedSeconds - (states[i]?.elapsedSeconds ?? 0);
      expect(wait).toBeLessThanOrEqual(1.1);
      expect(wait).toBeGreaterThanOrEqual(Math.min(1, 0.04 * elapsedSeconds) - 1e-9);
    });
  });

  it("is shown immediately when a phase begins", async () => {
    const phases: readonly Phase[] = ["check", "sides", "surface", "volume", "optimize", "verify"];
    const reports = phases.flatMap((phase, i) => [
      report(phase, 50 + i / 100),
      report(phase, 50.001 + i / 100),
    ]);
    expect((await shown(reports)).map(({ phase }) => phase)).toEqual(phases);
  });

  it("is logged with the times of the run, however late its messages arrive", async () => {
    const [, log] = await shownAndLogged([report("check", 1), report("sides", 20), report("optimize", 300)]);
    expect(log.slice(0, 4).map(({ seconds }) => seconds)).toEqual([0, 1, 20, 300]);
    // The last entry has the time of the run's own report.
    expect(log.at(-1)?.seconds).toBeLessThan(1);
  });
});

describe("the picture of a run", () => {
  it("is the last front until the mesh to be optimized replaces it, and that mesh until the end", async () => {
    const real = await createMesher();
    const front = new Float64Array(9);
    const unoptimized = await real.meshProject(emptyProject("nothing"));
    const pictures: unknown[] = [];
    const mesher: Mesher = Object.assign(Object.create(real) as Mesher, {
      meshProject: (_project: unknown, _options: unknown, control: RunControl) => {
        const shownNow = (): unknown[] => {
          const state = run.state.getState();
          return [state.front, state.unoptimized];
        };
        control.onFront?.(front);
        control.onProgress?.(report("volume", 1));
        control.onProgress?.(report("optimize", 2));
        pictures.push(shownNow());
        control.onUnoptimized?.(unoptimized);
        control.onProgress?.(report("verify", 3));
        pictures.push(shownNow());
        return Promise.resolve(unoptimized);
      },
    });
    const run = new MeshRun(new DocumentStore(emptyProject("nothing")), Promise.resolve(mesher));
    await run.generate();
    real.dispose();
    expect(pictures).toEqual([
      [front, null],
      [null, unoptimized],
    ]);
    expect(run.state.getState()).toMatchObject({ front: null, unoptimized: null });
  });
});
