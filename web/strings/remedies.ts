/** What to do in the app about problems: the package's remedies name options and calls in backquotes. */
import type { Diagnostic } from "tetrafront";

const remesh = "Select Remesh for the body, or export the surface with more uniform triangles.";

/** By code, for problems of drawings and of bodies. */
const remedies: Readonly<Partial<Record<Diagnostic["code"], string>>> = {
  "empty-background-grid":
    "Set a uniform size in the mesh settings, or create a background grid that covers the model.",
  "patches-intersect":
    "Combine the bodies (Edit, Combine bodies), move them apart, or split both patches along a common line. Remove parts that lie inside, unless they are interfaces between two regions.",
  "coarse-surface": "Select Remesh or Refine for the body, or use larger elements.",
  "needle-surface": remesh,
  "cracked-surface": "Repair the surface, and weld nodes within the width of the crack.",
  "changed-volume": "Use a smaller size or a smaller tolerance for the body.",
  "thin-body":
    "For fewer, set the number of elements in the mesh settings, or Layers to 0 for the body, which permits flat elements; or compute the part with shell elements.",
  "divided-surface": "Select Keep for the body to keep its triangles.",
  "replaced-surface": "Select Keep for the body to keep its triangles.",
  "surface-contact": "If what touches should be one body, let it overlap, and repair or combine the bodies.",
  "touching-solids": "Combine the bodies (Edit, Combine bodies), or move them apart.",
  stalled:
    "Use sizes that vary more gradually there, select Remesh for the body, or use sizes closer to its edge lengths.",
  "large-tetrahedra": "Select Remesh or Refine for the body, or permit a larger volume.",
  "unresolved-surface":
    "Weld nodes within a larger distance, or separate or close the parts there in the program that made them.",
  "near-nodes": "Repair the body, and weld nodes within the distance by which they are apart.",
  "inconsistent-regions": "Repair the surface, then open it again.",
};

/** By code, if the remedy of the package names an option or a call; otherwise that one fits the app too. */
const inPlaceOfOptions: Readonly<Partial<Record<Diagnostic["code"], string>>> = {
  "poor-elements":
    "Select Remesh for bodies with needles; otherwise use smaller elements there, or set Optimization to Thorough.",
};

/** By code, for problems of the given surface of a body. */
const ofBodies: Readonly<Partial<Record<Diagnostic["code"], string>>> = {
  "open-edge": "Repair the surface: the repair fills holes and welds nodes. Or close it in your CAD program.",
  "inconsistent-orientation": "Repair the surface: the repair flips triangles.",
  "flipped-triangle": "Repair the surface: the repair flips triangles.",
  "duplicate-triangle": "Repair the surface: the repair removes duplicate triangles.",
  "degenerate-triangle": "Repair the surface: the repair removes degenerate triangles.",
  "dangling-sheet": "Repair the surface: the repair removes sheets that enclose nothing.",
  "self-intersection":
    "Repair the surface: the repair cuts triangles where they intersect, and keeps the boundary of what they enclose.",
  "coincident-nodes": "Repair the surface: the repair welds nodes.",
};

/** For other problems whose remedy names an option or a call. */
const general = "Move or change the parts there, so that they neither touch nor intersect.";
const optionOrCall = /`[^`]+`/;

/** Returns what to do about a problem in the app. `isOfBody`: it is about the given surface of a body. */
export function remedyInApp(
  { code, remedy, body }: Pick<Diagnostic, "code" | "remedy" | "body">,
  isOfBody = body !== undefined,
): string {
  const inApp = (isOfBody ? ofBodies[code] : undefined) ?? remedies[code];
  return inApp ?? (optionOrCall.test(remedy) ? (inPlaceOfOptions[code] ?? general) : remedy);
}
