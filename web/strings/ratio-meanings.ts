/** What the radius ratios of triangles and tetrahedra mean. */
export const ratioMeanings = {
  triangle:
    "Radius ratio 2r/R of a triangle: twice the radius of its inscribed circle, divided by that of its circumscribed circle. 1: equilateral. 0: without area.",
  tetrahedron:
    "Radius ratio 3r/R of a tetrahedron: three times the radius of its inscribed sphere, divided by that of its circumscribed sphere. 1: regular. 0: without volume.",
} as const;
