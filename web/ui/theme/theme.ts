import { createTheme, Menu, type CSSVariablesResolver, type MantineColorsTuple } from "@mantine/core";
import { regionColors } from "./region-colors";
import { viridis } from "./viridis";

/**
 * Colours, sizes and fonts. Text has a contrast of at least 4.5 : 1 with its background in both schemes.
 */

const dark: MantineColorsTuple = [
  "#d3dae4",
  "#b3bdca",
  "#97a3b4",
  "#5f6b7c",
  "#3a4350",
  "#2f3641",
  "#272d36",
  "#20252d",
  "#1a1e25",
  "#14171c",
];

const fontFamily = '"Inter Variable", Inter, system-ui, sans-serif';

export const theme = createTheme({
  fontFamily,
  fontFamilyMonospace: "ui-monospace, SFMono-Regular, Menlo, Consolas, monospace",
  primaryColor: "blue",
  primaryShade: { light: 8, dark: 8 },
  defaultRadius: 4,
  cursorType: "pointer",
  respectReducedMotion: true,
  colors: { dark },
  fontSizes: { xs: "11.5px", sm: "12.5px", md: "13px", lg: "14px", xl: "16px" },
  headings: { fontWeight: "600" },
  components: {
    // ARIA does not allow the placeholder as a child of a menu. The first item gets the focus instead.
    Menu: Menu.extend({ defaultProps: { withInitialFocusPlaceholder: false } }),
  },
});

export const cssVariables: CSSVariablesResolver = () => ({
  variables: {},
  light: {
    "--mantine-color-dimmed": "#526071",
    "--mantine-color-placeholder": "#5f6c78",
    "--mantine-color-error": "#c92a2a",
    "--tf-panel": "#fbfcfd",
    "--tf-line": "#d5dbe3",
    "--tf-rise": "#eef1f5",
    "--tf-menu": "#ffffff",
    "--tf-shadow": "rgba(20, 30, 45, 0.28)",
    "--tf-selected": "#d6e8fa",
    "--tf-accent": "#1864ab",
    "--tf-chart": "#2a788e",
    "--tf-chart-off": "#e8890c",
    "--tf-view-near": "#ffffff",
    "--tf-view-far": "#dde3ea",
    "--tf-overlay": "#f6f8fb",
    "--tf-cube-face": "#ffffff",
    "--tf-cube-trim": "#d3dbe5",
    "--tf-cube-text": "#26323f",
    "--tf-error": "#c92a2a",
    "--tf-warning": "#8f5100",
    "--tf-success": "#1f7a33",
    "--tf-axis-x": "#c92a2a",
    "--tf-axis-y": "#1f7a33",
    "--tf-axis-z": "#1864ab",
  },
  dark: {
    "--mantine-color-dimmed": dark[2],
    "--mantine-color-placeholder": "#8894a5",
    "--mantine-color-error": "#ff8787",
    "--tf-panel": dark[7],
    "--tf-line": "#343c48",
    "--tf-rise": dark[6],
    "--tf-menu": dark[6],
    "--tf-shadow": "rgba(0, 0, 0, 0.65)",
    "--tf-selected": "#24425f",
    "--tf-accent": "#74c0fc",
    "--tf-chart": "#22a884",
    "--tf-chart-off": "#ffa94d",
    "--tf-view-near": "#343b47",
    "--tf-view-far": "#1a1d23",
    "--tf-overlay": "#20252d",
    "--tf-cube-face": "#3a424f",
    "--tf-cube-trim": "#2c333d",
    "--tf-cube-text": "#e6ebf2",
    "--tf-error": "#ff8787",
    "--tf-warning": "#ffc078",
    "--tf-success": "#69db7c",
    "--tf-axis-x": "#ff8787",
    "--tf-axis-y": "#69db7c",
    "--tf-axis-z": "#74c0fc",
  },
});

/** Colours of the three-dimensional view, which cannot use CSS variables. */
export const viewerColors = {
  dark: {
    point: "#e9edf3",
    line: "#aebccd",
    patch: "#7f93ad",
    backgroundGrid: "#c39bf5",
    source: "#5ce0c0",
    selection: "#4dabf7",
    hover: "#ffd43b",
    front: "#f59f00",
    failing: "#ff8787",
    meshEdge: "#10141a",
    meshPlain: "#9fb0c4",
    faded: "#262b33",
    emptyRim: "#8fb0e2",
    emptyHollow: "#1b3b76",
    filled: "#c9b895",
    fresh: "#f2b73d",
    ground: "#566274",
    ramp: viridis,
    regions: regionColors,
  },
  light: {
    point: "#1f2a37",
    line: "#3a4a5e",
    patch: "#8fa3bb",
    backgroundGrid: "#7048c0",
    source: "#087f6b",
    selection: "#1c7ed6",
    hover: "#e8590c",
    front: "#f08c00",
    failing: "#c92a2a",
    meshEdge: "#1b232d",
    meshPlain: "#b9c6d6",
    faded: "#e9edf2",
    emptyRim: "#cfdff5",
    emptyHollow: "#2d5dae",
    filled: "#efe4cf",
    fresh: "#e8a317",
    ground: "#a4b0bf",
    ramp: viridis,
    regions: regionColors,
  },
} as const;

/** Widths in pixels below which the layout changes. */
export const breakpoints = { sidePanels: 1100, phone: 700 } as const;
