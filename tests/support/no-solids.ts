import type { SolidMaker } from "../../web/document/operations/operation";

const refuse = (): Promise<never> => Promise.reject(new Error("These tests make no solids"));

/** For operations of tests without solids. */
export const noSolids: SolidMaker = { bodyOf: refuse, edgesOf: refuse };
