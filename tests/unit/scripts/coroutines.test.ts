/** Tests the lint rule that permits co_await only where GCC 12 compiles it correctly. */
import { describe, expect, test } from "vitest";

import { wrongCoroutines, wrongCoroutinesIn } from "../../../scripts/lib/coroutines.mjs";

const inTask = (...lines: string[]) => ["Task<int> run(Work& work) {", ...lines, "}"].join("\n");

describe("co_await is permitted", () => {
  test.each([
    "co_await work.yield();",
    "step(1); co_await work.finish(builder, 16);",
    "const int sum = co_await add(work, 3);",
    "sum += co_await add(work, 3);",
    "std::pair<int, Mesh> both = co_await two(work);",
    "const auto [first, second] = co_await two(work);",
    "co_return co_await add(work, 3);",
    "if (co_await isDone(work)) stop();",
    "if (!co_await isDone(work)) { co_await work.yield(); }",
    "if (isFirst && !co_await isDone(work)) co_await work.yield();",
    "if (isFirst) { step(); } else co_await work.yield();",
    "while (!builder.advance(work.remaining())) co_await work.yield();",
    "for (int i = 0; i < 3; ++i) co_await work.spend(1);",
    "for (Blocks block(work); co_await block.next();) visit(block);",
    "for (int i = 0; i < 3; ++i) { if (i == 1) continue; co_await work.spend(1); }",
    "try { co_await work.yield(); } catch (...) { fail(); }",
    "Box box{1, 2}; co_await work.yield();",
    "Job job([](Work& inner) -> Task<> { co_await inner.yield(); });",
  ])("%s", (line) => {
    expect(wrongCoroutinesIn(inTask(line))).toEqual([]);
  });
});

describe("co_await is rejected", () => {
  test.each([
    "Pair pair{co_await a(work), co_await b(work)};",
    "Pair pair{1, co_await b(work)};",
    "const Pair pair = {co_await a(work), 2};",
    "const Pair pair{.first = co_await a(work)};",
    "use(co_await a(work));",
    "use(1, co_await a(work));",
    "const int sum = 1 + co_await a(work);",
    "return use({co_await a(work)});",
    "if (use(co_await a(work))) stop();",
    "const int sum = isFirst ? co_await a(work) : 0;",
  ])("%s", (line) => {
    expect(wrongCoroutinesIn(inTask(line))[0]).toEqual({
      line: 2,
      reason: "co_await must be a statement, a whole initializer or a condition",
    });
  });
});

test("co_await in a comment or a string is ignored", () => {
  expect(wrongCoroutinesIn(inTask("use(1);  // use(co_await a)", 'say("use(co_await a)");'))).toEqual([]);
});

test("a lambda that is a coroutine must not capture", () => {
  const captures = "Job job([this](Work& work) -> Task<> { co_await work.yield(); });";
  expect(wrongCoroutinesIn(inTask(captures))).toEqual([
    { line: 2, reason: "a lambda that is a coroutine must not capture" },
  ]);
});

test("modules of hot loops must not use coroutines", () => {
  expect(wrongCoroutinesIn(inTask("co_await work.yield();"), false)).toEqual([
    { line: 2, reason: "no coroutines in this module" },
  ]);
});

test("the project follows the rule", () => {
  expect(wrongCoroutines()).toEqual([]);
});
