/** Whether meshes are shown with second-order elements: a choice that the browser remembers for all documents. */
const key = "tetrafront-second-order";
const chosen = "on";

export const keptOrder = {
  isSecond: (): boolean => {
    try {
      return localStorage.getItem(key) === chosen;
    } catch {
      return false;
    }
  },
  keep: (isSecond: boolean): void => {
    try {
      if (isSecond) localStorage.setItem(key, chosen);
      else localStorage.removeItem(key);
    } catch {
      // Without storage, it is forgotten with the page.
    }
  },
} as const;
