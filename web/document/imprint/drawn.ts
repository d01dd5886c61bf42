import type { Project } from "tetrafront";

/** The lists of a project that imprinting changes. */
export type Drawn = Pick<Project, "points" | "lines" | "patches">;
