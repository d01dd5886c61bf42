import { readFileSync } from "node:fs";
import { expect, it } from "vitest";

const packageFile = (name: string): string =>
  readFileSync(new URL(`../../../wasm/${name}`, import.meta.url), "utf8");

it("the README of the package names every method of a mesher", () => {
  const face = packageFile("src/api/mesher-interface.ts").split("export interface Mesher ")[1] ?? "";
  const methods = [...face.matchAll(/^ {2}(\w+)\(/gm)].map(([, name = ""]) => name);
  expect(methods.length).toBeGreaterThan(20);
  const text = packageFile("README.md");
  expect(methods.filter((name) => !new RegExp(`\\b${name}\\b`).test(text))).toEqual([]);
});
