/** Stands in for the workers of the page, which are not there in tests: it never answers. */
export class SilentWorker {
  postMessage(): void {
    // Never answers.
  }

  terminate(): void {
    // There is no worker to end.
  }
}
