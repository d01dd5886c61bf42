/**
 * Stands for the package react-style-singleton, by which dialogs lock the scroll bars behind them: the same component, with
 * style sheets that the policy of the page permits.
 */
import { useEffect } from "react";
import { adoptStyles } from "./adopted-styles";

interface StylesProps {
  readonly styles: string;
}

function Styles({ styles }: StylesProps): null {
  useEffect(() => adoptStyles(styles), [styles]);
  return null;
}

/** Returns a component that puts styles on the page while it is mounted. */
export const styleSingleton = () => Styles;
