import type { Project } from "tetrafront/project";
import { expect, it } from "vitest";
import {
  commonNumbers,
  commonType,
  setCommonLineType,
  setCommonNumber,
} from "../../../web/document/common-edits";
import { emptyProject } from "../../../web/document/create";
import { withDependents } from "../../../web/document/edits";
import type { Entity } from "../../../web/document/entities";
import { addGroup, extendGroup } from "../../../web/document/groups";
import { DocumentStore } from "../../../web/session/document-store";

const count = 20_000;
const ids = Array.from({ length: count }, (_, k) => k + 1);
const chain: Project = {
  ...emptyProject(),
  points: ids.map((id) => ({ id, position: [id, 0, 0] })),
  lines: ids.slice(1).map((id) => ({ id, type: "straight", points: [id - 1, id] })),
  expressions: ids.map((id) => ({ kind: "point", id, field: "position.1", expression: "0*2" })),
};
const points: readonly Entity[] = ids.map((id) => ({ kind: "point", id }));
const lines: readonly Entity[] = chain.lines.map(({ id }) => ({ kind: "line", id }));

/** Enough for edits, which cost more. */
const [somePoints, someLines] = [points.slice(0, 4000), lines.slice(0, 4000)];

const searches = ["find", "findIndex", "some", "includes", "indexOf", "filter"] as const;

type Method = (this: readonly unknown[], ...args: unknown[]) => unknown;

class TooManySearched extends Error {}

/** Returns the total length of the lists that are searched. Throws where a quadratic number is certain. */
function searched(work: () => void): number {
  let total = 0;
  const kept = searches.map((name) => [name, Reflect.get(Array.prototype, name) as Method] as const);
  for (const [name, method] of kept) {
    const counted: Method = function (...args) {
      total += this.length;
      if (total > 1000 * count) throw new TooManySearched(name);
      return Reflect.apply(method, this, args);
    };
    Object.assign(Array.prototype, { [name]: counted });
  }
  try {
    work();
  } finally {
    for (const [name, method] of kept) {
      Object.defineProperty(Array.prototype, name, { value: method, enumerable: false });
    }
  }
  return total;
}

const store = (): DocumentStore => new DocumentStore(chain, () => 0);

it.each<readonly [string, () => void]>([
  ["common numbers", () => void commonNumbers(chain, points)],
  ["the common type", () => void commonType(chain, lines, "line")],
  ["dependents", () => void withDependents(chain, points)],
  ["a new group", () => void addGroup(chain, points)],
  [
    "a larger group",
    () => {
      const documents = store();
      documents.edit(addGroup(chain, somePoints));
      documents.edit(extendGroup(documents.project, 1, [...somePoints, ...someLines]));
      expect(documents.project.groups?.[0]?.members).toHaveLength(8000);
    },
  ],
  [
    "a number of all, with its expression",
    () => {
      const documents = store();
      documents.edit(setCommonNumber(somePoints, "position.2", 3, "1+2"));
      expect(documents.project.expressions).toHaveLength(count + 4000);
      documents.edit(setCommonNumber(somePoints, "position.2", 4, null));
      expect(documents.project.expressions).toEqual(chain.expressions);
      expect(documents.project.points[3999]?.position).toEqual([4000, 0, 4]);
    },
  ],
  [
    "the type of all",
    () => {
      const documents = store();
      documents.edit(setCommonLineType(someLines, "spline"));
      expect(documents.project.lines[3999]?.type).toBe("spline");
    },
  ],
])("thousands of selected entities: %s need no search per entity", (_, work) => {
  expect(searched(work)).toBeLessThan(60 * count);
});

it("what depends on a selection is complete, and each once", () => {
  expect(withDependents(chain, points)).toHaveLength(2 * count - 1);
});
