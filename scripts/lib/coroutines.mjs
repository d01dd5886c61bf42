import { readFileSync } from "node:fs";
import path from "node:path";
import { filesUnder } from "./fresh.mjs";
import { inRoot, root } from "./paths.mjs";

/** Modules of hot loops, which must not use coroutines. */
const modulesWithout = ["geom"];

/**
 * Finds forbidden uses of coroutines in the engine, its tests and its bindings. Returns one "file:line: reason"
 * each. The reasons: GCC 12 miscompiles `co_await` inside the braces of an initializer and in some arguments,
 * without a warning; and the captures of a lambda that is a coroutine are destroyed before the coroutine ends.
 */
export function wrongCoroutines() {
  return filesUnder([inRoot("cpp"), inRoot("tests", "cpp"), inRoot("wasm")])
    .filter((file) => /\.(h|cpp)$/.test(file))
    .flatMap((file) => {
      const name = path.relative(root, file);
      const mayAwait = !modulesWithout.some((module) => name.startsWith(path.join("cpp", "src", module)));
      return wrongCoroutinesIn(readFileSync(file, "utf8"), mayAwait).map(
        ({ line, reason }) => `${name}:${line}: ${reason}`,
      );
    });
}

/**
 * Finds forbidden uses in the text of one file. Returns the line, from 1, and the reason of each.
 * @param {string} source
 */
export function wrongCoroutinesIn(source, mayAwait = true) {
  const code = withoutCommentsAndTexts(source);
  const wrong = [];
  const report = (index, reason) => wrong.push({ line: code.slice(0, index).split("\n").length, reason });
  for (const { index } of code.matchAll(/\bco_await\b/g)) {
    if (!mayAwait) report(index, "no coroutines in this module");
    else if (!isPermitted(code.slice(0, index)))
      report(index, "co_await must be a statement, a whole initializer or a condition");
  }
  for (const { index } of code.matchAll(/\[[^[\]]+\]\s*\([^()]*\)\s*(?:mutable\s*)?->\s*Task\b/g))
    report(index, "a lambda that is a coroutine must not capture");
  return wrong.sort((a, b) => a.line - b.line);
}

/** Returns whether `co_await` may follow this code. */
function isPermitted(before) {
  const open = innermostOpenBracket(before);
  const outside = before.slice(0, open).trimEnd();
  const inside = before.slice(open + 1);
  if (before[open] === "{") return opensBlock(outside) && beginsStatement(inside);
  const isCondition = /^(?:[^]*(?:&&|\|\|))?\s*!?\s*$/;
  if (/\b(?:if|while)$/.test(outside)) return isCondition.test(inside);
  return /\bfor$/.test(outside) && isCondition.test(inside.slice(inside.lastIndexOf(";") + 1));
}

/** Returns whether a brace after this code begins a block rather than a list of initializers. */
function opensBlock(code) {
  return /(?:[;{})]|\b(?:else|do|try|const|noexcept|override)|->\s*Task\b[^;{}()]*)$/.test(code);
}

/** Returns whether this code of a block ends where a statement, or the initializer of a variable, begins. */
function beginsStatement(code) {
  const flat = withoutNested(code);
  const statement = flat.slice(Math.max(flat.lastIndexOf(";"), flat.lastIndexOf("}")) + 1).trim();
  const afterControl = statement.replace(/^(?:(?:else\s+)?(?:if|while|for)\s*\(\)|else\b|do\b)\s*/, "");
  return /^(?:co_return|\w[^=(,]*(?:<[^=(]*>[^=(,]*)?[^=!<>(,]=|auto\s*&?\s*\[\]\s*=)?$/.test(afterControl);
}

/** Returns the index of the last bracket in `code` that is not closed there, or -1. */
function innermostOpenBracket(code) {
  let closed = 0;
  for (let i = code.length - 1; i >= 0; --i) {
    if (")}".includes(code[i])) ++closed;
    else if ("({".includes(code[i]) && closed-- === 0) return i;
  }
  return -1;
}

/** Returns the code without the contents of brackets. */
function withoutNested(code) {
  let depth = 0;
  let flat = "";
  for (const character of code) {
    if (")}]".includes(character)) --depth;
    if (depth === 0) flat += character;
    if ("({[".includes(character)) ++depth;
  }
  return flat;
}

/** Returns the code with its comments and strings replaced by blanks, so that indices stay the same. */
function withoutCommentsAndTexts(source) {
  const blanked = (match) => match.replace(/[^\n]/g, " ");
  return source.replace(/\/\/[^\n]*|\/\*[^]*?\*\/|"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])'/g, blanked);
}
