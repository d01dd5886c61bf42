/** A label in the view: its middle and its size, in CSS pixels. */
export interface Label {
  readonly x: number;
  readonly y: number;
  readonly width: number;
  readonly height: number;
}

/** Places tried around the middle of a label, nearest first: rings of eight. */
const directions = 8;
const rings = 12;
/** Space between two labels, in CSS pixels. */
const gap = 2;

/**
 * Returns the middles of labels, moved as little as needed so that none lies on another one; earlier labels stay. If there is no
 * room within twelve heights, a label stays where it is. O(n²).
 */
export function placedApart(labels: readonly Label[]): readonly { readonly x: number; readonly y: number }[] {
  const placed: Label[] = [];
  for (const label of labels) {
    const free = placesAround(label).find((place) => placed.every((other) => !overlap(place, other)));
    placed.push(free ?? label);
  }
  return placed;
}

function placesAround(label: Label): readonly Label[] {
  const places = [label];
  for (let ring = 1; ring <= rings; ring++)
    for (let i = 0; i < directions; i++) {
      const angle = (2 * Math.PI * i) / directions;
      const far = (ring * label.height) / 2;
      places.push({ ...label, x: label.x + far * Math.cos(angle), y: label.y + far * Math.sin(angle) });
    }
  return places;
}

const overlap = (a: Label, b: Label): boolean =>
  Math.abs(a.x - b.x) < (a.width + b.width) / 2 + gap &&
  Math.abs(a.y - b.y) < (a.height + b.height) / 2 + gap;

/** Farthest that a label is from what it names, in CSS pixels. */
const maxReach = 64;
/** Space between a drawing and the labels around it. */
const reach = 14;

/**
 * Returns the middles of labels of a drawing, given by what they name: outside of the drawing if it is small, otherwise at some
 * distance from what they name, away from the middle of the drawing. None lies on another one if there is room, and they are moved into the view.
 */
export function placedAround(
  labels: readonly Label[],
  view: { readonly width: number; readonly height: number },
): readonly { readonly x: number; readonly y: number }[] {
  if (labels.length === 0) return [];
  const centre = {
    x: labels.reduce((sum, { x }) => sum + x, 0) / labels.length,
    y: labels.reduce((sum, { y }) => sum + y, 0) / labels.length,
  };
  const radius = Math.max(...labels.map(({ x, y }) => Math.hypot(x - centre.x, y - centre.y)));
  const outside = labels.map((label) => {
    const far = Math.hypot(label.x - centre.x, label.y - centre.y);
    const [dx, dy] = far === 0 ? [0, -1] : [(label.x - centre.x) / far, (label.y - centre.y) / far];
    const half = (Math.abs(dx) * label.width + Math.abs(dy) * label.height) / 2;
    const by = Math.min(radius - far + reach, maxReach) + half;
    return {
      ...label,
      x: within(label.x + by * dx, label.width / 2, view.width),
      y: within(label.y + by * dy, label.height / 2, view.height),
    };
  });
  return placedApart(outside);
}

/** Moves a coordinate so that the half extent around it lies in a view. */
const within = (at: number, half: number, extent: number): number =>
  Math.min(Math.max(at, half), Math.max(half, extent - half));
