/** Factor of the widths of lines and the diameters of dots, for an audience. All views of a page share it, as its large type. */
export const enlarging = { value: 1 };
