import { describe, expect, it } from "vitest";
import { defectsOf, type Problem } from "../../../web/document/validate";

const problem = (part: Partial<Problem>): Problem => ({
  key: "",
  severity: "error",
  code: "",
  message: "",
  remedy: "",
  entities: [],
  triangles: [],
  body: null,
  position: null,
  ...part,
});

describe("defectsOf", () => {
  const patch = (id: number) => ({ kind: "patch", id }) as const;

  it("returns the triangles that an error names, or else its patches if it names nothing else", () => {
    const defects = defectsOf([
      problem({ entities: [patch(1)], triangles: [7, 8] }),
      problem({ entities: [patch(2), patch(3)] }),
      problem({ entities: [{ kind: "line", id: 5 }, patch(4)] }),
      problem({ entities: [patch(6)], severity: "warning" }),
    ]);
    expect(defects).toEqual({
      triangles: [7, 8],
      patches: new Set([2, 3]),
      openLines: new Set(),
      areOpenLinesExpected: false,
      bodies: new Map(),
    });
  });
});
