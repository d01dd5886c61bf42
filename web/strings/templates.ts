/** Texts of the templates of new projects. */
export const templateStrings = {
  title: "New from template",
  hint: "The present project stays under File ▸ Open recent if it was changed or has a file.",
  templates: {
    empty: { title: "Empty", blurb: "Nothing but the axes." },
    box: { title: "Box", blurb: "A cube with a uniform size." },
    "sphere-in-box": {
      title: "Sphere in a box",
      blurb: "The volume around a sphere; a source makes its elements smaller.",
    },
    "cylinder-in-box": {
      title: "Cylinder in a box",
      blurb: "A channel with a cylinder across the flow, and a source around it.",
    },
    "wing-in-box": {
      title: "Wing in a box",
      blurb: "The flow around a swept NACA 0012 wing, with sources at both of its edges.",
    },
  },
  parts: { box: "box", channel: "channel", sphere: "sphere", cylinder: "cylinder", wing: "wing" },
} as const;
