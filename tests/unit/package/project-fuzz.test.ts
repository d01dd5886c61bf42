/**
 * Damaged project files: each is rejected or checked, with errors that have a code, a message
 * and a remedy.
 */
import { readdirSync, readFileSync } from "node:fs";
import path from "node:path";
import { fileURLToPath } from "node:url";

import { createMesher, type Diagnostic, type Mesher, type ReadResult } from "tetrafront";
import { parseProject, readProject, type Project } from "tetrafront/project";
import { afterAll, beforeAll, expect, test } from "vitest";

/** Number of damaged files; `npm run fuzz COUNT` reads more. */
const FILES = Number(process.env["TETRAFRONT_FUZZ"] ?? 200);
/** Number of damaged projects that are meshed. */
const MESHED = 25;
/** Longer files are used less often: they reveal the same errors more slowly. */
const SMALL = 12_000;
/** Generous, because a loaded machine is slow. */
const SECONDS_PER_FILE = 20;

type Json = null | boolean | number | string | Json[] | { [key: string]: Json };
type Random = () => number;

/** Integers below 2^32, the same on every machine (Marsaglia's xorshift). */
function randomSource(seed: number): Random {
  let state = (seed * 2_654_435_761) >>> 0 || 1;
  return () => {
    state ^= state << 13;
    state ^= state >>> 17;
    state ^= state << 5;
    return state >>> 0;
  };
}

function pick<Value>(random: Random, values: readonly Value[]): Value {
  const value = values[random() % values.length];
  if (value === undefined) throw new Error("nothing to pick from");
  return value;
}

const folder = fileURLToPath(new URL("../../../public/models", import.meta.url));
const texts = readdirSync(folder).map((name) => readFileSync(path.join(folder, name), "utf8"));
const smallTexts = texts.filter((text) => text.length < SMALL);

const UNUSUAL_VALUES: readonly Json[] = [
  0,
  -1,
  1e308,
  -1e308,
  1e-320,
  1e12,
  1e-9,
  0.5,
  7,
  1e300,
  null,
  "NaN",
  "",
  true,
];

/** Changes, removes or repeats a few characters. */
function damagedText(text: string, random: Random): string {
  const at = random() % text.length;
  const length = random() % 60;
  switch (random() % 4) {
    case 0:
      return text.slice(0, at) + text.slice(at + length);
    case 1:
      return text.slice(0, at + length) + text.slice(at);
    case 2:
      return (
        text.slice(0, at) + pick(random, ["]", "}", ",", "-", "9", '"', "null", "e"]) + text.slice(at + 1)
      );
    default:
      return text.slice(0, at);
  }
}

/** Replaces one number in the text, which stays valid JSON. */
function damagedNumber(text: string, random: Random): string {
  const numbers = [...text.matchAll(/-?\d+(\.\d+)?(e-?\d+)?/g)];
  const chosen = pick(random, numbers);
  const number = pick(random, ["0", "-1", "1e308", "1e-320", "2", "3", "12", "-7", "1e9", "0.1", "1e999"]);
  return text.slice(0, chosen.index) + number + text.slice(chosen.index + chosen[0].length);
}

/** Replaces one value somewhere in the tree. */
function damageTree(root: Json, random: Random): void {
  let node = root;
  for (;;) {
    if (typeof node !== "object" || node === null) return;
    const keys = Object.keys(node);
    if (keys.length === 0) return;
    const key = pick(random, keys);
    const holder = node as Record<string, Json>;
    const child = holder[key] as Json;
    if (typeof child !== "object" || child === null || random() % 6 === 0) {
      damageValue(holder, key, child, random);
      return;
    }
    node = child;
  }
}

function damageValue(holder: Record<string, Json>, key: string, child: Json, random: Random): void {
  if (Array.isArray(child) && child.length > 0) {
    const at = random() % child.length;
    const other = random() % child.length;
    switch (random() % 6) {
      case 0:
        holder[key] = [];
        return;
      case 1:
        child.reverse();
        return;
      case 2:
        child.splice(at, 1);
        return;
      case 3:
        child.push(structuredClone(child[at] as Json));
        return;
      case 4:
        [child[at], child[other]] = [child[other] as Json, child[at] as Json];
        return;
      default:
        child[at] = structuredClone(child[other] as Json);
        return;
    }
  }
  if (typeof child === "number" && random() % 2 === 0) {
    holder[key] = pick(random, [
      -child,
      child + 1,
      child * 1e6,
      child * 1e-9,
      Math.round(child) + (random() % 9),
    ]);
    return;
  }
  if (random() % 8 === 0) {
    Reflect.deleteProperty(holder, key);
    return;
  }
  holder[key] = pick(random, UNUSUAL_VALUES);
}

/** Moves points onto each other, reverses lines or shuffles loops; the result conforms to the schema. */
function damageDrawing(project: Project, random: Random): Project {
  const copy = structuredClone(project) as unknown as {
    points: { position: number[] }[];
    lines: { type: string; points: number[] }[];
    patches: { type: string; loops: number[][] }[];
    background: { nodes: { size: number; at: number[] }[] };
  };
  const point = pick(random, copy.points);
  const line = pick(random, copy.lines);
  const patch = pick(random, copy.patches);
  const loop = pick(random, patch.loops);
  switch (random() % 9) {
    case 0:
      point.position = [...pick(random, copy.points).position];
      break;
    case 1:
      line.points.reverse();
      break;
    case 2:
      loop.sort(() => (random() % 2 === 0 ? 1 : -1));
      break;
    case 3:
      loop.forEach((id, i) => (loop[i] = random() % 3 === 0 ? -id : id));
      break;
    case 4:
      patch.type = pick(random, copy.patches).type;
      break;
    case 5:
      line.type = pick(random, ["straight", "parabolic", "spline", "arc", "circle"]);
      break;
    case 6:
      point.position = point.position.map((x) => x + (random() % 200) / 100 - 1);
      break;
    case 7: {
      const size = pick(random, [1e-6, 1e-300, 1e6, 1e300, -1, 0]);
      for (const node of copy.background.nodes) node.size = size;
      break;
    }
    default:
      for (const each of copy.points)
        each.position = each.position.map((x) => x * pick(random, [1e-200, 1e25, -1, 0]));
  }
  return copy as unknown as Project;
}

function damagedFile(seed: number): ReadResult<Project> {
  const random = randomSource(seed);
  const text = pick(random, random() % 12 === 0 ? texts : smallTexts);
  switch (random() % 4) {
    case 0:
      return readProject(damagedText(text, random));
    case 1:
      return readProject(damagedNumber(text, random));
    case 2: {
      const tree = JSON.parse(text) as Json;
      for (let damage = 1 + (random() % 3); damage > 0; damage--) damageTree(tree, random);
      return parseProject(tree);
    }
    default: {
      const valid = readProject(text);
      return valid.success ? parseProject(damageDrawing(valid.value, random)) : valid;
    }
  }
}

/** Codes about the project, its sizes or its options as a whole. */
const CODES_WITHOUT_ENTITIES = [
  "empty-model",
  "empty-background-grid",
  "too-many-elements",
  "size-too-large",
  "stalled",
  "invalid-project",
];

function defectOf({ code, severity, message, remedy, entities, position }: Diagnostic): string | undefined {
  if (!/^\S.*\S$/.test(message) || /undefined|NaN|\[object/.test(message))
    return `invalid message "${message}"`;
  if (severity !== "information" && !/\.$/.test(remedy)) return `no remedy: "${message}"`;
  if (severity === "error" && entities.length === 0 && !CODES_WITHOUT_ENTITIES.includes(code))
    return `${code} without entities`;
  if (position?.some((coordinate) => !Number.isFinite(coordinate)) === true)
    return `${code} at an invalid position`;
  if (code === "verification-failed" || code === "engine-failed") return message;
  return undefined;
}

let mesher: Mesher;
beforeAll(async () => {
  mesher = await createMesher();
});
afterAll(() => mesher.dispose());

async function inTime<Value>(work: Promise<Value>, seed: number): Promise<Value> {
  let timer: NodeJS.Timeout | undefined;
  const late = new Promise<never>((_, reject) => {
    timer = setTimeout(() => reject(new Error(`seed ${seed} takes too long`)), SECONDS_PER_FILE * 1000);
  });
  try {
    return await Promise.race([work, late]);
  } finally {
    clearTimeout(timer);
  }
}

test(`${FILES} damaged files are rejected or checked with named errors`, { timeout: 600_000 }, async () => {
  const defects: string[] = [];
  let refused = 0;
  let faulty = 0;
  let fine = 0;
  for (let seed = 1; seed <= FILES; seed++) {
    const read = damagedFile(seed);
    if (!read.success) {
      refused++;
      for (const { message, remedy } of read.errors) {
        if (!/\S/.test(message) || !/\.$/.test(remedy))
          defects.push(`seed ${seed}: rejected without a message or a remedy`);
      }
      continue;
    }
    const { diagnostics } = await inTime(mesher.previewProject(read.value), seed);
    if (diagnostics.some(({ severity }) => severity === "error")) faulty++;
    else fine++;
    for (const diagnostic of diagnostics) {
      const defect = defectOf(diagnostic);
      if (defect !== undefined) defects.push(`seed ${seed}: ${defect}`);
    }
  }
  expect(defects).toEqual([]);
  expect(refused).toBeGreaterThan(FILES / 5);
  expect(faulty).toBeGreaterThan(FILES / 5);
  expect(fine).toBeGreaterThan(FILES / 50);
});

test(`${MESHED} damaged projects give a mesh or a named error`, { timeout: 600_000 }, async () => {
  let meshed = 0;
  for (let seed = 1; meshed < MESHED; seed++) {
    const random = randomSource(seed);
    const valid = readProject(pick(random, smallTexts));
    if (!valid.success) throw new Error("a bundled model cannot be read");
    const read = parseProject(damageDrawing(valid.value, random));
    if (!read.success) continue;
    meshed++;
    const { nodes } = valid.value.background;
    const size = 2 * Math.max(...nodes.map((node) => node.size));
    const work = mesher.meshProject(read.value, { size, optimization: "none" });
    const { report } = await inTime(work, seed);
    const errors = report.diagnostics.filter(({ severity }) => severity === "error");
    expect(errors.length > 0, `seed ${seed}: ${report.status}`).toBe(report.status !== "done");
    expect(report.diagnostics.map(defectOf).filter((defect) => defect !== undefined)).toEqual([]);
  }
});
