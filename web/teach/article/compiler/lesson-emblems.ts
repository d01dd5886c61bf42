/**
 * Small pictures for the list of lessons, in the colours and lines of the figures: cool where it is empty, warm where it is filled,
 * blue for what is active, gold for what is new, red and dashed for what is refused.
 */

type Shape = "void" | "stone" | "new" | "hole" | "base" | "bad";
type Line = "front" | "mesh" | "active" | "refused" | "thin" | "soft";

const fill = (kind: Shape, ...polygons: readonly string[]): string =>
  `<path class="${kind}" d="${polygons.map((points) => `M${points}Z`).join("")}"/>`;
const line = (kind: Line, ...paths: readonly string[]): string =>
  `<path class="${kind}" d="${paths.map((points) => `M${points}`).join("")}"/>`;
const dots = (kind: "node" | "gold", ...centres: readonly (readonly [number, number])[]): string =>
  centres.map(([x, y]) => `<circle class="${kind}" cx="${x}" cy="${y}" r="3.5"/>`).join("");
const ring = (x: number, y: number, across: number, down = across, turn = 0): string =>
  `<ellipse class="ring" cx="${x}" cy="${y}" rx="${across}" ry="${down}" transform="rotate(${turn} ${x} ${y})"/>`;
const cross = (x: number, y: number): string =>
  line("refused", `${x - 5} ${y - 5}L${x + 5} ${y + 5}`, `${x - 5} ${y + 5}L${x + 5} ${y - 5}`);

const prism = [
  "42 92L124 76",
  "42 92L106 102",
  "106 102L124 76",
  "56 22L118 16",
  "56 22L98 36",
  "98 36L118 16",
];

const pictures: Readonly<Record<string, string>> = {
  0: [
    fill("stone", "8 14H152V96H8"),
    fill("new", "80 14L62 24L70 37L80 34", "80 96L62 86L70 73L80 76"),
    line(
      "mesh",
      "8 14L36 40L8 66L36 96L8 96",
      "36 14V96",
      "36 14L62 24L36 40L60 55L36 66L62 86L36 96",
      "36 66H8",
      "36 40H8",
    ),
    line("mesh", "62 24L80 14L70 37L62 24L60 55L70 73L62 86L80 96", "60 55L70 37"),
    line("thin", "80 30C104 30 112 46 152 46", "80 25C106 25 116 34 152 34", "80 19C108 19 118 23 152 23"),
    line("thin", "80 80C104 80 112 64 152 64", "80 85C106 85 116 76 152 76", "80 91C108 91 118 87 152 87"),
    '<circle class="hole" cx="80" cy="55" r="21"/>',
    line("front", "80 8V34", "80 76V102"),
  ].join(""),
  1: [
    fill("void", "30 15L72 10L82 48L104 38L140 58L128 92L66 100L14 92L38 50"),
    fill("stone", "14 92L31 94.7L24 79", "31 94.7L49 97.3L41 82", "49 97.3L66 100L59 84"),
    fill("new", "66 100L87 97.3L78 83"),
    line("mesh", "14 92L66 100L87 97.3"),
    line(
      "front",
      "30 15L72 10L82 48L104 38L140 58L128 92L107.7 94.7L87 97.3L78 83L66 100L59 84L49 97.3L41 82L31 94.7L24 79L14 92L38 50Z",
    ),
    line("active", "87 97.3L107.7 94.7"),
  ].join(""),
  2: [
    fill("void", "12 25L50 60L75 68L105 40L148 22V95H12"),
    fill("stone", "12 95H52L32 43.4", "52 95H78L65 64.8", "78 95H106L92 52"),
    fill("new", "106 95H146L126 31.2"),
    line("mesh", "12 95L32 43.4L52 95L65 64.8L78 95L92 52L106 95L126 31.2L146 95"),
    line("front", "12 25L50 60L75 68L105 40L148 22", "8 95H152"),
    dots("node", [12, 25], [50, 60], [75, 68], [105, 40], [148, 22]),
  ].join(""),
  3: [
    fill(
      "void",
      "10 36H54V80H10",
      "84 42C100 18 130 18 146 36C152 54 152 68 150 88C134 68 110 68 96 88C90 68 86 54 84 42",
    ),
    line(
      "mesh",
      "24.7 36V80",
      "39.3 36V80",
      "10 50.7H54",
      "10 65.3H54",
      "88 64C104 42 134 42 150 62",
      "104 26C110 42 114 56 113 74",
      "126 24C133 40 136 56 133 73",
    ),
    line(
      "front",
      "10 36H54V80H10Z",
      "84 42C100 18 130 18 146 36C152 54 152 68 150 88C134 68 110 68 96 88C90 68 86 54 84 42Z",
    ),
    fill("base", "27 70H37L32 44", "112 58L128 56L118 42"),
    line("active", "27 70H37L32 44Z", "112 58L128 56L118 42Z"),
  ].join(""),
  4: [
    fill("stone", "30 84L80 12L74 100"),
    fill("base", "30 84L128 70L74 100"),
    fill("new", "80 12V84L128 70"),
    line("mesh", "80 12V84L128 70"),
    line("front", "80 12L30 84", "80 12L74 100", "80 12L128 70"),
    line("active", "30 84L128 70L74 100Z"),
    dots("gold", [80, 12]),
  ].join(""),
  5: [
    ring(80, 42, 27),
    line("soft", "50 94L20 52L110 94", "50 94L58 14L110 94", "50 94L80 42L110 94", "50 94L142 56L110 94"),
    fill("new", "50 94H110L104 32"),
    line("front", "50 94L104 32L110 94"),
    line("active", "50 94H110"),
    dots("node", [20, 52], [58, 14], [104, 32], [142, 56]),
    dots("gold", [80, 42]),
  ].join(""),
  6: [
    fill("new", "30 90H102L60 22"),
    line("mesh", "30 90L60 22L102 90"),
    line("active", "30 90H102"),
    line("front", "22 36L138 62"),
    cross(52.5, 43),
    cross(76.3, 48.3),
  ].join(""),
  7: [
    fill("void", "8 12H152V98H8"),
    fill("stone", "8 12H62L36 44", "152 98H98L128 72"),
    fill(
      "new",
      "40 62L34 50L48 52L52 40L62 47L72 37L80 47L92 40L98 51L112 50L112 62L100 62L94 72L82 65L72 75L62 66L52 72L50 62",
    ),
    line("mesh", "8 12L36 44L62 12", "152 98L128 72L98 98"),
    line("front", "8 12H152V98H8Z"),
    line(
      "front",
      "40 62L34 50L48 52L52 40L62 47L72 37L80 47L92 40L98 51L112 50L112 62L100 62L94 72L82 65L72 75L62 66L52 72L50 62Z",
    ),
    '<path class="wing" d="M46 57C56 49 80 50 106 57C80 61 56 63 46 57Z"/>',
    cross(138, 30),
  ].join(""),
  8: [
    fill("void", "30 6H130V104H30"),
    fill("base", "80 6H130V55H80"),
    line(
      "mesh",
      "80 6V104",
      "30 55H130",
      "105 6V55",
      "80 30.5H130",
      "92.5 6V30.5",
      "80 18H105",
      "55 55V104",
      "30 79.5H80",
    ),
    line(
      "front",
      "38 92C30 70 66 74 68 50C70 22 96 8 106 28C112 42 128 54 120 70C110 88 84 68 72 82C62 94 44 104 38 92Z",
    ),
    '<circle class="query" cx="104" cy="27" r="12"/>',
    dots("gold", [100, 21], [108, 32]),
  ].join(""),
  9: [
    fill("stone", "6 74L40 88L96 40L62 22"),
    line("mesh", "6 74L62 22", "40 88L96 40L6 74", "18 79L74 27", "29 84L85 34", "40 88L62 22", "6 74L51 78"),
    ring(51, 55, 33, 10, -38),
    fill("base", "36 64L66 54L60 42"),
    fill("stone", "126 34L150 48V76L126 90L102 76V48"),
    line("mesh", "126 34L150 48V76L126 90L102 76V48Z", "126 34V90", "102 48L150 76", "150 48L102 76"),
    ring(126, 62, 20),
    fill("base", "126 62L150 76L150 48"),
  ].join(""),
  10: [
    fill("void", "56 22L118 16L124 76L106 102L42 92"),
    line(
      "soft",
      "78 60L42 92",
      "78 60L124 76",
      "78 60L106 102",
      "78 60L56 22",
      "78 60L118 16",
      "78 60L98 36",
    ),
    line("front", ...prism, "56 22L42 92", "118 16L124 76", "98 36L106 102"),
    line("active", "42 92L98 36", "106 102L118 16", "124 76L56 22"),
    dots("gold", [78, 60]),
  ].join(""),
  11: [
    ring(80, 60, 62, 34),
    fill("bad", "20 66L70 92L140 54L92 28"),
    line("front", "20 66L70 92L140 54L92 28Z", "20 66L140 54"),
    line("refused", "70 92L92 28"),
    dots("node", [20, 66], [70, 92], [140, 54], [92, 28]),
  ].join(""),
  mesher: [
    fill("void", "80 8L136 48L114 100H46L24 48"),
    fill("stone", "46 100H114L80 56"),
    line("front", "80 8L136 48L114 100L80 56L46 100L24 48Z"),
    line("mesh", "46 100H114"),
    line("soft", "80 8L80 56L136 48"),
    line("active", "80 8L136 48"),
    dots("node", [24, 48], [46, 100], [114, 100]),
    dots("gold", [80, 56]),
  ].join(""),
};

/** Returns the picture of a lesson, by its number or name; empty if it has none. */
export function emblemOf(lesson: number | string): string {
  const picture = pictures[lesson];
  return picture === undefined
    ? ""
    : `<svg class="emblem" viewBox="0 0 160 110" aria-hidden="true">${picture}</svg>`;
}
