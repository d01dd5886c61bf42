import { MesherError } from "tetrafront";
import { remedyInApp } from "../strings";

/** Returns what a user reads about the failure of a call: the message, and what to do about it in the app. */
export function failureText(failure: unknown): string {
  if (failure instanceof MesherError && failure.code === "invalid-input") {
    const [first] = failure.data.diagnostics;
    if (first !== undefined) return `${first.message}. ${remedyInApp(first)}`.trimEnd();
  }
  return failure instanceof Error ? failure.message : String(failure);
}
