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
