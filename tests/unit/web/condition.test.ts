/** Conditions at which the player pauses: their text, and the steps that meet them. */
import { createMesher } from "tetrafront";
import { EDGE_REFUSALS, readTrace, type Trace, type TraceStep } from "tetrafront/trace";
import { beforeAll, describe, expect, it } from "vitest";
import { type Condition, parseCondition } from "../../../web/teach/player/condition";
import { holds } from "../../../web/teach/player/condition-test";
import { faceSize } from "../../../web/teach/player/front-values";
import { firstState } from "../../../web/teach/player/phases";
import { nextStop, refusedIn } from "../../../web/teach/player/stops";
import { recordSurface } from "../../support/recorded-models";
import { boxSurface } from "../../support/surfaces";
import { starSurface, starTrace } from "../../support/traces";

function conditionOf(text: string): Condition {
  const parsed = parseCondition(text);
  if (!parsed.success) throw new Error(JSON.stringify(parsed.error));
  return parsed.condition;
}

describe("the text of a condition", () => {
  it.each<[string, Condition]>([
    ["face 214", { kind: "is", thing: "face", index: 214 }],
    ["face 2,849", { kind: "is", thing: "face", index: 2849 }],
    ["front > 1,234,567", { kind: "compare", quantity: "front", relation: ">", value: 1234567 }],
    ["size < 0.02", { kind: "compare", quantity: "size", relation: "<", value: 0.02 }],
    ["Size<=2e-3", { kind: "compare", quantity: "size", relation: "<=", value: 0.002 }],
    ["refused", { kind: "refused", reason: null }],
    ["refused: crosses", { kind: "refused", reason: "crosses" }],
    ["crosses", { kind: "refused", reason: "crosses" }],
    ["too close", { kind: "refused", reason: "too-close" }],
    ["refused:too close", { kind: "refused", reason: "too-close" }],
    ["refused: too-close", { kind: "refused", reason: "too-close" }],
    ["  new   node ", { kind: "happens", what: "new node" }],
  ])("%s", (text, condition) => {
    expect(parseCondition(text)).toEqual({ success: true, condition });
  });

  it("binds and closer than or", () => {
    const [a, b, c] = ["accepted", "recovery", "front > 3"].map(conditionOf);
    const parts = [a, { kind: "all", parts: [b, c] }];
    expect(conditionOf("accepted or recovery and front > 3")).toEqual({ kind: "any", parts });
  });

  it("reads every reason for which a candidate is refused", () => {
    for (const reason of EDGE_REFUSALS)
      expect(conditionOf(`refused: ${reason.replace("-", " ")}`)).toEqual({ kind: "refused", reason });
  });

  it.each([
    ["", "condition", "", 0],
    ["sise < 2", "condition", "sise", 0],
    ["size 2", "relation", "2", 5],
    ["size <", "number", "", 6],
    ["size < large", "number", "large", 7],
    ["face 2.5", "index", "2.5", 5],
    ["face 2,84", "end", ",", 6],
    ["face 2849,100", "end", ",", 9],
    ["face -1", "index", "-1", 5],
    ["refused: ugly", "reason", "ugly", 9],
    ["accepted recovery", "end", "recovery", 9],
    ["accepted and", "condition", "", 12],
    ["size < 1e999", "number", "1e999", 7],
  ])("%j is refused", (text, expected, found, at) => {
    expect(parseCondition(text)).toEqual({ success: false, error: { expected, found, at } });
  });
});

describe("in the volume", () => {
  const { bytes } = starTrace({
    ...starSurface(boxSurface(3, [-1, -1, -1], [1, 1, 1])),
    postponeEvery: 6,
    reopenAfter: 20,
  });
  const read = readTrace(bytes);
  if (!read.success) throw new Error(read.errors[0].message);
  const trace = read.value;
  const steps = Array.from({ length: trace.stepCount }, (_, i) => trace.stepAt(i + 1));

  /** Expected steps, by the decoded steps. */
  const expected = (test: (step: TraceStep) => boolean): number[] =>
    steps.flatMap((step, i) => (step && test(step) ? [i + 1] : []));
  const found = (text: string): number[] => {
    const condition = conditionOf(text);
    return steps.flatMap((_, i) => (holds(trace, i + 1, condition) ? [i + 1] : []));
  };
  const advance = (test: (step: Extract<TraceStep, { kind: "advance" }>) => boolean) =>
    expected((step) => step.kind === "advance" && test(step));

  it("holds for the steps whose decoded content meets it", () => {
    const { face } = steps.find((step) => step?.kind === "advance") ?? { face: 0 };
    const size = faceSize(trace, face);
    const cases: readonly (readonly [string, readonly number[]])[] = [
      [`face ${face}`, advance((s) => s.face === face || s.candidates.some((c) => c.culprit === face))],
      ["node 0", advance((s) => s.candidates.some(({ node }) => node === 0))],
      ["element 7", expected((s) => s.addedElements.includes(7))],
      [`size > ${size}`, advance((s) => faceSize(trace, s.face) > size)],
      [`size = ${size}`, advance((s) => faceSize(trace, s.face) === size)],
      ["candidates >= 2", advance((s) => s.candidates.length >= 2)],
      ["front < 30", expected(({ step }) => trace.frontAt(step).length < 30)],
      ["accepted", advance((s) => s.outcome === "accepted")],
      ["postponed", advance((s) => s.outcome === "postponed")],
      ["recovery", expected(({ kind }) => kind === "recovery")],
      ["new node", expected(({ addedNodes }) => addedNodes.length > 0)],
      ["refused: crosses", advance((s) => s.candidates.some(({ verdict }) => verdict === "crosses"))],
      ["refused", advance((s) => s.candidates.some(({ verdict }) => verdict !== "accepted"))],
      ["refused: outside", []],
      ["patch 1 or line 1 or edge 1", []],
      [
        "postponed and refused: crosses or recovery",
        expected(
          (s) =>
            s.kind === "recovery" ||
            (s.outcome === "postponed" && s.candidates.some(({ verdict }) => verdict === "crosses")),
        ),
      ],
    ];
    for (const [text, met] of cases) expect(found(text), text).toEqual(met);
    expect(cases.filter(([, met]) => met.length > 0).length).toBeGreaterThan(10);
  });

  it("is found forwards and backwards, and not beyond a limit", () => {
    const condition = conditionOf("refused: crosses");
    const all = found("refused: crosses");
    const [first = 0, second = 0] = all;
    expect(nextStop(trace, 0, 1, condition)).toBe(first);
    expect(nextStop(trace, second, -1, condition)).toBe(first);
    expect(nextStop(trace, first, 1, condition, second - 1)).toBeNull();
    const step = trace.stepAt(first);
    const rank = refusedIn(trace, first, condition) ?? -1;
    expect(step?.kind === "advance" && step.candidates[rank]?.verdict).toBe("crosses");
  });
});

describe("in lines and patches", () => {
  let trace: Trace;
  beforeAll(async () => {
    const mesher = await createMesher();
    ({ trace } = await recordSurface(mesher, "unit-cube"));
    mesher.dispose();
  });

  it("holds for the steps whose decoded content meets it", () => {
    const { surface } = trace;
    if (!surface) throw new Error("the trace has no lines and patches");
    const all = Array.from({ length: surface.stepCount }, (_, i) => i + 1);
    const found = (text: string): number[] => {
      const condition = conditionOf(text);
      return all.filter((step) => holds(trace, firstState(trace) + step, condition));
    };
    const edges = (test: (step: ReturnType<typeof edgeAt> & object) => boolean): number[] =>
      all.filter((step) => {
        const edge = edgeAt(step);
        return edge !== null && test(edge);
      });
    const edgeAt = (at: number) => {
      const step = surface.stepAt(at);
      return step?.kind === "edge" ? step : null;
    };
    expect(found("patch 2 and accepted")).toEqual(edges((s) => s.patch === 1 && s.outcome === "accepted"));
    expect(found("edge 3")).toEqual(
      edges((s) => s.edge === 3 || s.candidates.some(({ culprit }) => culprit === 3)),
    );
    expect(found("candidates > 1")).toEqual(edges((s) => s.candidates.length > 1));
    expect(found("refused: behind")).toEqual(
      edges((s) => s.candidates.some(({ verdict }) => verdict === "behind")),
    );
    const lines = all.filter((step) => surface.divisions[surface.divisionAt(step) ?? -1]?.line === 0);
    expect(found("line 1")).toEqual(lines);
    expect(lines.length).toBeGreaterThan(1);
    const layers = new Set(edges(() => true).map((step) => edgeAt(step)?.layer));
    expect(layers.size).toBeGreaterThan(2);
    expect(found("layer >= 2")).toEqual(edges((s) => s.layer >= 2));
    expect(found("size > 0").length).toBe(edges(() => true).length);
  });
});
