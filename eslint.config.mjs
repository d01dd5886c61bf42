import js from "@eslint/js";
import reactHooks from "eslint-plugin-react-hooks";
import globals from "globals";
import tseslint from "typescript-eslint";

/**
 * The borders of docs/ARCHITECTURE.md: web uses the package's public entry, the package uses the compiled engine, and
 * neither imports what uses it. scripts/lib/dependencies.mjs checks the order of the modules within each. Later blocks
 * replace earlier ones, so each lists all it forbids.
 */
const noApp = { group: ["**/web/**", "@tetrafront/app"], message: "The package must not know the app." };
const onlyPublicEntry = {
  group: ["**/wasm/**", "tetrafront/*", "!tetrafront/trace", "!tetrafront/project", "!tetrafront/internal"],
  message: 'Import the package by the names of its entries, such as "tetrafront".',
};
const noThree = {
  group: ["three", "three/**", "three-*", "camera-controls"],
  message: "three.js stays in viewer/, tools/ and teach/player/.",
};
const noReact = { group: ["react", "react-dom", "@mantine/**"], message: "React stays in panels/ and ui/." };
const noEngine = {
  group: ["**/engine.js", "**/tools.js"],
  message: "Only wasm/src/engine/loader.ts touches Emscripten's output.",
};
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
        projectService: true,
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
    files: ["scripts/**/*.mjs", "tests/**/*.mjs", "wasm/bin/**/*.mjs", "web/*.mjs", "*.mjs"],
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

  {
    files: ["wasm/**/*.ts"],
    ignores: ["wasm/src/engine/loader.ts"],
    rules: restrict(noApp, noThree, noReact, noEngine),
  },
  { files: ["wasm/src/engine/loader.ts"], rules: restrict(noApp, noThree, noReact) },
  { files: ["web/**/*.{ts,tsx}"], rules: restrict(onlyPublicEntry, noThree, noReact) },
  { files: ["web/{viewer,tools,teach/player}/**/*.ts"], rules: restrict(onlyPublicEntry, noReact) },
  {
    files: ["web/{panels,ui,teach/panels,teach/embed}/**/*.{ts,tsx}", "web/main.tsx"],
    rules: restrict(onlyPublicEntry, noThree),
  },
  {
    files: ["web/**/*.{ts,tsx}"],
    plugins: { "react-hooks": reactHooks },
    rules: { "react-hooks/rules-of-hooks": "error", "react-hooks/exhaustive-deps": "error" },
  },
);
