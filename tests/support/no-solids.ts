import type { SolidSource } from "../../web/session/operations";

const refuse = (): Promise<never> => Promise.reject(new Error("These tests make no solids"));

/** For operations of tests without solids. */
export const noSolids: SolidSource = {
  until: () => ({ bodyOf: refuse, edgesOf: refuse, drawn: refuse, samplesOf: refuse }),
};
