/** Whether the start page is shown when there is nothing to continue with: a choice that the browser remembers. */
const key = "tetrafront-start-page";
const never = "never";

export const startPage = {
  isWanted: (): boolean => {
    try {
      return localStorage.getItem(key) !== never;
    } catch {
      return true;
    }
  },
  want: (isWanted: boolean): void => {
    try {
      if (isWanted) localStorage.removeItem(key);
      else localStorage.setItem(key, never);
    } catch {
      // Without storage, it is shown at every start.
    }
  },
} as const;
