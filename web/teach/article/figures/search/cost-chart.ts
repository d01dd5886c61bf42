/** A chart of visits over the number of nodes, both by doubling. */

export interface CostChart {
  readonly nodes: readonly number[];
  readonly rows: readonly {
    readonly name: string;
    readonly counts: readonly number[];
    readonly present: number;
  }[];
  /** The present number of nodes. */
  readonly present: number;
  readonly ink: string;
  readonly soft: string;
  readonly rule: string;
  readonly active: string;
  readonly isLit: boolean;
}

const [left, right, top, bottom] = [46, 120, 24, 24] as const;
/** Lines of the scale: each is ten times the line below it. */
const decades = [10, 100, 1000] as const;
const nameHeight = 17;
const dashes: readonly (readonly number[])[] = [[], [9, 4], [2, 4]];

export function drawCostChart(canvas: HTMLCanvasElement, chart: CostChart): void {
  const { clientWidth: width, clientHeight: height } = canvas;
  const context = canvas.getContext("2d");
  if (!context || width === 0) return;
  const ratio = Math.max(2, devicePixelRatio);
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  context.scale(ratio, ratio);
  context.lineJoin = context.lineCap = "round";
  const [fewest, most] = [chart.nodes[0] ?? 1, chart.nodes.at(-1) ?? 2];
  const along = (value: number, from: number, to: number): number =>
    Math.log(value / from) / Math.log(to / from);
  const x = (count: number): number => left + along(count, fewest, most) * (width - left - right);
  const ground = height - bottom;
  const highest = Math.max(1000, most);
  const y = (visits: number): number => ground - along(Math.max(4, visits), 4, highest) * (ground - top);
  const line = (points: readonly (readonly [number, number])[], colour: string, lineWidth: number): void => {
    context.beginPath();
    for (const point of points) context.lineTo(...point);
    context.strokeStyle = colour;
    context.lineWidth = lineWidth;
    context.stroke();
  };
  context.font = `500 13px ${getComputedStyle(canvas).fontFamily}`;
  context.textBaseline = "alphabetic";
  line(
    [
      [x(fewest), ground],
      [x(most), ground],
    ],
    chart.rule,
    2,
  );
  context.fillStyle = chart.soft;
  context.textAlign = "right";
  for (const visits of decades) {
    line(
      [
        [left, y(visits)],
        [x(most), y(visits)],
      ],
      chart.rule,
      1,
    );
    context.fillText(String(visits), left - 8, y(visits) + 4.5);
  }
  context.textAlign = "center";
  for (const count of chart.nodes)
    if (Math.abs(x(count) - x(chart.present)) > 46)
      context.fillText(String(count), Math.max(12, x(count)), height - 7);
  chart.rows.forEach(({ counts }, row) => {
    context.setLineDash([...(dashes[row] ?? [])]);
    const points = counts.map((visits, i) => [x(chart.nodes[i] ?? 1), y(visits)] as const);
    line(points, chart.active, chart.isLit ? 4 : 2.25);
    context.setLineDash([]);
  });
  line(
    [
      [x(chart.present), top - 4],
      [x(chart.present), ground],
    ],
    chart.ink,
    1.5,
  );
  for (const { present } of chart.rows) {
    context.beginPath();
    context.arc(x(chart.present), y(present), 4.5, 0, 2 * Math.PI);
    context.fillStyle = chart.active;
    context.fill();
  }
  context.fillStyle = chart.ink;
  context.fillText(
    `${chart.present} nodes`,
    Math.min(width - right, Math.max(36, x(chart.present))),
    height - 7,
  );
  context.textAlign = "left";
  context.fillStyle = chart.soft;
  context.fillText("visits, each line ten times the one below", left - 32, 12);
  context.fillStyle = chart.ink;
  // Names at the ends of the lines, moved apart where they would overlap.
  const ends = chart.rows
    .map(({ name, counts }) => ({ text: `${name} ${counts.at(-1) ?? 0}`, at: y(counts.at(-1) ?? 1) }))
    .sort((a, b) => b.at - a.at);
  let below = ground + nameHeight - 4;
  context.textAlign = "left";
  context.textBaseline = "middle";
  for (const { text, at } of ends) {
    below = Math.min(at, below - nameHeight);
    context.fillText(text, x(most) + 9, Math.max(8, below));
  }
}
