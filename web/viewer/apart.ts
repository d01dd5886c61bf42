/** A label in the view: its middle and its size, in CSS pixels. */
export interface Label {
  readonly x: number;
  readonly y: number;
  readonly width: number;
  readonly height: number;
}

/** Positions tried around the middle of a label, nearest first: rings of eight. */
const directions = 8;
const rings = 12;
/** Space between two labels, in CSS pixels. */
const gap = 2;

/**
 * Returns the middles of labels, moved as little as needed so that none lies on another one; earlier labels stay. If there is no
 * room within twelve heights, a label may leave the view, and then stays where it is. `fits`: whether a label is in view at a
 * position. `covers`: what lies over the view, which labels avoid too. O(n (n + covers)).
 */
export function placedApart(
  labels: readonly Label[],
  fits: (label: Label) => boolean = () => true,
  covers: readonly Label[] = [],
): readonly { readonly x: number; readonly y: number }[] {
  const placed: Label[] = [];
  for (const label of labels) {
    placed.push(freePosition(label, [...covers, ...placed], fits));
  }
  return placed;
}

/**
 * Returns a label at its nearest position in view where it lies on none of others; if there is none, at the nearest one out
 * of view; if there is none either, where it is.
 */
function freePosition(label: Label, others: readonly Label[], fits: (label: Label) => boolean): Label {
  let outOfView: Label | null = null;
  for (const moved of positionsAround(label)) {
    if (others.some((other) => overlap(moved, other))) continue;
    if (fits(moved)) return moved;
    outOfView ??= moved;
  }
  return outOfView ?? label;
}

/** Returns a label at the positions that are tried for it, nearest first. */
function* positionsAround(label: Label): Generator<Label> {
  yield label;
  for (let ring = 1; ring <= rings; ring++)
    for (let i = 0; i < directions; i++) {
      const angle = (2 * Math.PI * i) / directions;
      const far = (ring * label.height) / 2;
      yield { ...label, x: label.x + far * Math.cos(angle), y: label.y + far * Math.sin(angle) };
    }
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
 * distance from what they name, away from the middle of the drawing. None lies on another one if there is room. They are
 * moved into the view, and out from under what covers its left side or is in `covers`. The position of a label is null if what
 * it names is out of view; the others are placed without it.
 */
export function placedAround(
  labels: readonly Label[],
  view: { readonly width: number; readonly height: number; readonly coveredLeft?: number },
  covers: readonly Label[] = [],
): readonly ({ readonly x: number; readonly y: number } | null)[] {
  const shown = labels.filter(({ x, y }) => x >= 0 && y >= 0 && x <= view.width && y <= view.height);
  if (shown.length === 0) return labels.map(() => null);
  const left = view.coveredLeft ?? 0;
  const centre = {
    x: shown.reduce((sum, { x }) => sum + x, 0) / shown.length,
    y: shown.reduce((sum, { y }) => sum + y, 0) / shown.length,
  };
  const radius = Math.max(...shown.map(({ x, y }) => Math.hypot(x - centre.x, y - centre.y)));
  const outside = shown.map((label) => {
    const far = Math.hypot(label.x - centre.x, label.y - centre.y);
    const [dx, dy] = far === 0 ? [0, -1] : [(label.x - centre.x) / far, (label.y - centre.y) / far];
    const half = (Math.abs(dx) * label.width + Math.abs(dy) * label.height) / 2;
    const by = Math.min(radius - far + reach, maxReach) + half;
    return {
      ...label,
      x: within(label.x + by * dx, label.width / 2, left, view.width),
      y: within(label.y + by * dy, label.height / 2, 0, view.height),
    };
  });
  const fits = ({ x, y, width, height }: Label): boolean =>
    x - width / 2 >= left &&
    x + width / 2 <= view.width &&
    y - height / 2 >= 0 &&
    y + height / 2 <= view.height;
  const placed = placedApart(outside, fits, covers);
  const positions = new Map(shown.map((label, i) => [label, placed[i]]));
  return labels.map((label) => positions.get(label) ?? null);
}

/** Moves a coordinate so that the half extent around it lies between two others, if there is room. */
const within = (at: number, half: number, low: number, high: number): number =>
  Math.min(Math.max(at, low + half), Math.max(low + half, high - half));
