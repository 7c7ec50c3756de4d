// Figures whose values can be read off: a click on their button takes the drawing away and puts a chart in its place, with the values under the
// pointer below it; dragging enlarges a part, a double click shows all again. chart.min.js is made of this by build.sh.
import uPlot from "uplot";

// Those of the drawings (Okabe and Ito).
const COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00", "#000000"];
const DASHES = [[], [8, 4], [2, 3], [12, 3, 2, 3]];

function short(x) {
  if (x === null || x === undefined) return "-";
  const own = Number(x.toPrecision(4));
  return Math.abs(own) < 1e5 ? own.toString() : own.toExponential().replace("e+", "e");
}

// A tick of an axis as the drawings have it: 200, 0.05, 2\u00b710\u2077.
function tick(x) {
  const [digits, power] = Number(x.toPrecision(4)).toExponential().split("e");
  if (x === 0 || (Math.abs(x) >= 1e-3 && Math.abs(x) < 1e5)) return short(x);
  const ten = `10${[...String(Number(power))].map((digit) => "\u207b\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079"["-0123456789".indexOf(digit)]).join("")}`;
  return digits === "1" ? ten : `${digits}\u00b7${ten}`;
}

function table(line) {
  return line.low ? [line.x, line.y, line.low, line.high] : [line.x, line.y];
}

function options(chart, width) {
  const series = [{ label: chart.x.label, value: (_, x) => short(x) }];
  const bands = [];
  chart.lines.forEach((line, k) => {
    const stroke = COLOURS[(line.colour ?? k) % COLOURS.length], dash = DASHES[Math.floor(k / COLOURS.length) % DASHES.length];
    const paths = line.steps ? uPlot.paths.stepped({ align: 1 }) : undefined;
    const value = (_, y) => short(y);
    series.push({ label: line.name, stroke, dash, width: 2, spanGaps: true, paths, value, points: { show: !line.steps, size: 6 } });
    if (!line.low) return;
    const edge = { stroke: stroke + "66", width: 1, dash: [4, 4], spanGaps: true, paths, value, points: { show: false } };
    series.push({ ...edge, label: `${line.name}, low` }, { ...edge, label: `${line.name}, high` });
    bands.push({ series: [series.length - 1, series.length - 2], fill: stroke + "22" });
  });
  const axis = (own) => ({ label: own.label, values: (_, ticks) => ticks.map((x) => (x === null ? "" : tick(x))) });
  const scale = (own) => (own.log ? { time: false, distr: 3 } : { time: false });
  return {
    width, height: Math.round(width * 0.55), series, bands, axes: [axis(chart.x), axis(chart.y)],
    scales: { x: scale(chart.x), y: scale(chart.y) }, cursor: { drag: { x: true, y: true, uni: 20 } },
  };
}

function offer(figure) {
  const button = figure.querySelector("button.read");
  const place = figure.querySelector(".chart");
  const chart = JSON.parse(place.querySelector("script").textContent);
  let drawn;
  button.hidden = false;
  button.addEventListener("click", () => {
    place.hidden = !place.hidden;
    figure.classList.toggle("reading", !place.hidden);
    button.setAttribute("aria-pressed", String(!place.hidden));
    if (!drawn && !place.hidden) {
      drawn = new uPlot(options(chart, place.clientWidth), uPlot.join(chart.lines.map(table)), place);
    }
  });
  addEventListener("resize", () => {
    if (drawn && !place.hidden) drawn.setSize({ width: place.clientWidth, height: Math.round(place.clientWidth * 0.55) });
  });
}

document.querySelectorAll("figure.charted").forEach(offer);
