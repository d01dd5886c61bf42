import js from "@eslint/js";
import reactHooks from "eslint-plugin-react-hooks";
import globals from "globals";
import tseslint from "typescript-eslint";

/**
 * The arrows of docs/ARCHITECTURE.md, guarded: web uses the package's public entry, the package uses the
 * compiled engine, nobody reaches back. Later blocks replace earlier ones, so each lists all it forbids.
 */
const noApp = { group: ["**/web/**", "@tetrafront/app"], message: "The package must not know the app." };
const onlyPublicEntry = {
  group: ["**/wasm/**", "tetrafront/*"],
  message: 'Import the package by its name, "tetrafront".',
};
const noThree = {
  group: ["three", "three/**", "three-*", "camera-controls"],
  message: "three.js stays in viewer/ and tools/.",
};
const noReact = { group: ["react", "react-dom", "@mantine/**"], message: "React stays in panels/ and ui/." };
const noEngine = {
  group: ["**/engine.js"],
  message: "Only wasm/src/engine/loader.ts touches Emscripten's output.",
};
const noModules = (...modules) => ({
  group: modules.map((name) => `**/${name}/**`),
  message: "This import violates the dependency rules of docs/ARCHITECTURE.md.",
});
/**
 * The modules of web/, the lowest first: each may import those before it. All but document and viewer may import ui, and
 * all may import strings.
 */
const webModules = ["document", "workers", "session", "viewer", "tools", "app", "commands", "panels"];
const noUpward = (module) =>
  noModules(
    ...webModules.slice(webModules.indexOf(module) + 1),
    ...(module === "document" || module === "viewer" ? ["ui"] : []),
  );
const restrict = (...patterns) => ({ "no-restricted-imports": ["error", { patterns }] });

export default tseslint.config(
  {
    ignores: [
      "**/node_modules/**",
      "**/dist/**",
      "build/**",
      ".toolchain/**",
      "coverage/**",
      "test-results/**",
      "playwright-report/**",
    ],
  },
  { linterOptions: { noInlineConfig: true, reportUnusedDisableDirectives: "error" } },
  js.configs.recommended,
  {
    rules: {
      eqeqeq: ["error", "always", { null: "ignore" }],
      "max-lines": ["error", { max: 600 }],
      "no-console": "error",
      "no-warning-comments": ["error", { terms: ["todo", "fixme", "xxx"] }],
      "object-shorthand": "error",
      "prefer-const": "error",
    },
  },
  {
    files: ["**/*.ts", "**/*.tsx"],
    extends: [...tseslint.configs.recommendedTypeChecked],
    languageOptions: {
      parserOptions: {
        // vite.config.ts runs in Node: it belongs to no page's project.
        projectService: {
          allowDefaultProject: ["web/vite.config.ts"],
          defaultProject: "tests/tsconfig.json",
        },
        tsconfigRootDir: import.meta.dirname,
      },
    },
    rules: {
      "@typescript-eslint/consistent-type-imports": "error",
      "@typescript-eslint/no-non-null-assertion": "error",
      "@typescript-eslint/no-unnecessary-condition": ["error", { allowConstantLoopConditions: true }],
      "@typescript-eslint/restrict-template-expressions": [
        "error",
        { allowNumber: true, allowBoolean: true },
      ],
      "@typescript-eslint/switch-exhaustiveness-check": [
        "error",
        { considerDefaultExhaustiveForUnions: true },
      ],
      "@typescript-eslint/no-unused-vars": [
        "error",
        { argsIgnorePattern: "^_", destructuredArrayIgnorePattern: "^_", ignoreRestSiblings: true },
      ],
    },
  },
  {
    files: ["scripts/**/*.mjs", "tests/**/*.mjs", "wasm/bin/**/*.mjs", "*.mjs"],
    languageOptions: { globals: globals.node },
  },
  // A benchmark is a program whose output is its result.
  { files: ["tests/bench/**/*.mjs", "examples/**"], rules: { "no-console": "off" } },
  { files: ["examples/**/*.mjs"], languageOptions: { globals: globals.node } },
  {
    files: ["examples/**/*.{js,jsx}"],
    languageOptions: { globals: globals.browser, parserOptions: { ecmaFeatures: { jsx: true } } },
    // React's names are used in JSX alone.
    rules: { "no-unused-vars": ["error", { varsIgnorePattern: "^[A-Z]" }] },
  },

  // Arrows.
  {
    files: ["wasm/**/*.ts"],
    ignores: ["wasm/src/engine/loader.ts"],
    rules: restrict(noApp, noThree, noReact, noEngine),
  },
  { files: ["wasm/src/engine/loader.ts"], rules: restrict(noApp, noThree, noReact) },
  { files: ["web/**/*.{ts,tsx}"], rules: restrict(onlyPublicEntry) },
  {
    files: ["web/document/**/*.ts"],
    rules: restrict(onlyPublicEntry, noThree, noReact, noUpward("document")),
  },
  { files: ["web/workers/**/*.ts"], rules: restrict(onlyPublicEntry, noThree, noReact, noUpward("workers")) },
  { files: ["web/session/**/*.ts"], rules: restrict(onlyPublicEntry, noThree, noReact, noUpward("session")) },
  { files: ["web/viewer/**/*.ts"], rules: restrict(onlyPublicEntry, noReact, noUpward("viewer")) },
  { files: ["web/tools/**/*.ts"], rules: restrict(onlyPublicEntry, noReact, noUpward("tools")) },
  { files: ["web/app/**/*.ts"], rules: restrict(onlyPublicEntry, noThree, noReact, noUpward("app")) },
  {
    files: ["web/commands/**/*.ts"],
    rules: restrict(onlyPublicEntry, noThree, noReact, noUpward("commands")),
  },
  { files: ["web/panels/**/*.{ts,tsx}"], rules: restrict(onlyPublicEntry, noThree) },
  {
    files: ["web/ui/**/*.{ts,tsx}"],
    rules: restrict(onlyPublicEntry, noThree, noModules(...webModules.filter((name) => name !== "document"))),
  },
  {
    files: ["web/strings/**/*.ts"],
    rules: restrict(onlyPublicEntry, noThree, noReact, noModules(...webModules, "ui")),
  },
  {
    files: ["web/**/*.{ts,tsx}"],
    plugins: { "react-hooks": reactHooks },
    rules: { "react-hooks/rules-of-hooks": "error", "react-hooks/exhaustive-deps": "error" },
  },
);
