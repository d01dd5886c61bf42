import { useMantineColorScheme } from "@mantine/core";
import { useEffect } from "react";
import type { App } from "../../app/app";

/** Gives the page the colours that the shell asks for, and tells it those that the page has remembered. */
export function useScheme({ shell }: App): void {
  const { colorScheme, setColorScheme } = useMantineColorScheme({ keepTransitions: true });
  useEffect(() => {
    shell.setState({ scheme: colorScheme });
    return shell.subscribe(({ scheme }, before) => {
      if (scheme !== before.scheme && scheme !== colorScheme) setColorScheme(scheme);
    });
  }, [shell, colorScheme, setColorScheme]);
}
