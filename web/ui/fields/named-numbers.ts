import { createContext } from "react";
import type { NamedNumbers } from "../../expressions/expression";

/** The named numbers that expressions in fields may use. */
export const NamedNumbersContext = createContext<NamedNumbers>(new Map());
