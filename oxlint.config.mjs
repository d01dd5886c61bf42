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

/** Each of these rules is an error. */
const errors = (...names) => Object.fromEntries(names.map((name) => [name, "error"]));

/** Rules of oxlint, which reads types by the compiler that the builds use. */
export default {
  plugins: ["typescript", "oxc", "react"],
  categories: { correctness: "error" },
  options: { typeAware: true, reportUnusedDisableDirectives: "error", denyWarnings: true },
  env: { builtin: true },
  ignorePatterns: [
    "**/node_modules/**",
    "**/dist/**",
    "build/**",
    ".toolchain/**",
    "coverage/**",
    "test-results/**",
    "playwright-report/**",
  ],
  rules: {
    ...errors(
      "no-array-constructor",
      "no-case-declarations",
      "no-console",
      "no-empty",
      "no-fallthrough",
      "no-prototype-builtins",
      "no-regex-spaces",
      "no-unexpected-multiline",
      "no-useless-assignment",
      "no-var",
      "object-shorthand",
      "prefer-const",
      "prefer-rest-params",
      "prefer-spread",
      "preserve-caught-error",
    ),
    eqeqeq: ["error", "always", { null: "ignore" }],
    "max-lines": ["error", { max: 600 }],
    "no-unused-vars": [
      "error",
      { argsIgnorePattern: "^_", destructuredArrayIgnorePattern: "^_", ignoreRestSiblings: true },
    ],
    // Rules of a compiler of React that the app does not use.
    "react/immutability": "off",
    "react/purity": "off",
    "react/set-state-in-effect": "off",
    // Names and keys are spread into their characters on purpose.
    "typescript/no-misused-spread": "off",
    // The holes of an array have the type of its values.
    "typescript/no-useless-default-assignment": "off",
    // What a rule finds is mended, not silenced.
    "no-warning-comments": [
      "error",
      { terms: ["todo", "fixme", "xxx", "eslint-disable", "oxlint-disable", "@ts-nocheck"] },
    ],
  },
  overrides: [
    {
      files: ["**/*.ts", "**/*.tsx"],
      rules: {
        ...errors(
          "typescript/ban-ts-comment",
          "typescript/consistent-type-imports",
          "typescript/no-empty-object-type",
          "typescript/no-explicit-any",
          "typescript/no-misused-promises",
          "typescript/no-namespace",
          "typescript/no-non-null-assertion",
          "typescript/no-require-imports",
          "typescript/no-unnecessary-type-assertion",
          "typescript/no-unnecessary-type-constraint",
          "typescript/no-unsafe-argument",
          "typescript/no-unsafe-assignment",
          "typescript/no-unsafe-call",
          "typescript/no-unsafe-enum-comparison",
          "typescript/no-unsafe-function-type",
          "typescript/no-unsafe-member-access",
          "typescript/no-unsafe-return",
          "typescript/only-throw-error",
          "typescript/prefer-promise-reject-errors",
          "typescript/require-await",
          "typescript/restrict-plus-operands",
        ),
        "typescript/no-unnecessary-condition": ["error", { allowConstantLoopConditions: true }],
        "typescript/restrict-template-expressions": ["error", { allowNumber: true, allowBoolean: true }],
        "typescript/switch-exhaustiveness-check": ["error", { considerDefaultExhaustiveForUnions: true }],
      },
    },
    {
      files: ["**/*.mjs", "**/*.js", "**/*.jsx"],
      env: { node: true },
      rules: {
        ...errors("no-redeclare", "no-undef"),
        // Types of plain scripts are guesses.
        "typescript/require-array-sort-compare": "off",
        "typescript/restrict-template-expressions": "off",
        "typescript/unbound-method": "off",
      },
    },
    // Tests compare sets by sorting both as text.
    { files: ["tests/**/*.ts"], rules: { "typescript/require-array-sort-compare": "off" } },
    // A benchmark is a program whose output is its result.
    { files: ["tests/bench/**/*.mjs", "examples/**"], rules: { "no-console": "off" } },
    {
      files: ["examples/**/*.{js,jsx}"],
      env: { browser: true },
      // React's names are used in JSX alone.
      rules: { "no-unused-vars": ["error", { varsIgnorePattern: "^[A-Z]" }] },
    },
    { files: ["wasm/**/*.ts"], rules: restrict(noApp, noThree, noReact, noEngine) },
    { files: ["wasm/src/engine/loader.ts"], rules: restrict(noApp, noThree, noReact) },
    { files: ["web/**/*.{ts,tsx}"], rules: restrict(onlyPublicEntry, noThree, noReact) },
    { files: ["web/{viewer,tools,teach/player}/**/*.ts"], rules: restrict(onlyPublicEntry, noReact) },
    {
      files: ["web/{panels,ui,teach/panels,teach/embed}/**/*.{ts,tsx}", "web/main.tsx"],
      rules: restrict(onlyPublicEntry, noThree),
    },
  ],
};
