import {
  convertCssVariables,
  DEFAULT_THEME,
  deepMerge,
  defaultCssVariablesResolver,
  MantineProvider,
  mergeMantineTheme,
} from "@mantine/core";
import { useInsertionEffect, type ReactNode } from "react";
import { adoptStyles } from "./adopted-styles";
import { cssVariables, theme } from "./theme";

/** The CSS variables of the library and our own. */
function variablesCss(): string {
  const merged = mergeMantineTheme(DEFAULT_THEME, theme);
  return convertCssVariables(deepMerge(defaultCssVariablesResolver(merged), cssVariables(merged)));
}

export interface ThemeProviderProps {
  /** Without motion, for tests. */
  readonly still: boolean;
  readonly children: ReactNode;
}

/**
 * Gives a page its colours and components. The library would add its variables, and classes that are not used here, in style
 * elements, which the policy of the page forbids.
 */
export function ThemeProvider({ still, children }: ThemeProviderProps) {
  useInsertionEffect(() => adoptStyles(variablesCss()), []);
  return (
    <MantineProvider
      theme={theme}
      withCssVariables={false}
      withGlobalClasses={false}
      defaultColorScheme="auto"
      env={still ? "test" : "default"}
    >
      {children}
    </MantineProvider>
  );
}
