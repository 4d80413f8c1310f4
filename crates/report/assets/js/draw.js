// Canvases: sharp on every screen, axes, colour tables, colour bars.

const tables = Object.fromEntries(
  Object.entries(parsed("tables")).map(([name, hex]) => [
    name,
    Array.from({ length: hex.length / 6 }, (_, k) =>
      [0, 2, 4].map((at) => parseInt(hex.slice(6 * k + at, 6 * k + at + 2), 16))),
  ]),
);
const colourAt = (table, fraction) => {
  const colours = tables[table];
  const k = Math.round(Math.min(1, Math.max(0, fraction)) * (colours.length - 1));
  return colours[k];
};
const css = ([r, g, b]) => `rgb(${r} ${g} ${b})`;
const variable = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
let theme = {};
function readTheme() {
  for (const name of ["paper", "card", "ink", "muted", "line", "faint", "accent", "bad", "post", "no-data", "hatch", "seabed"]) {
    theme[name] = variable(name);
  }
}
const FONT = '12px system-ui, -apple-system, "Segoe UI", Roboto, Arial, "DejaVu Sans", sans-serif';

// A context in CSS pixels, cleared, `height` pixels high.
function prepared(canvas, height) {
  const width = canvas.clientWidth || 600;
  const ratio = Math.max(window.devicePixelRatio || 1, document.documentElement.classList.contains("printing") ? 3 : 1);
  canvas.style.height = `${height}px`;
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  const g = canvas.getContext("2d");
  g.setTransform(ratio, 0, 0, ratio, 0, 0);
  g.clearRect(0, 0, width, height);
  g.font = FONT;
  g.lineJoin = "round";
  return [g, width];
}

function roundStep(step) {
  const power = 10 ** Math.floor(Math.log10(step));
  const factor = [1, 2, 2.5, 5].find((m) => step / power <= m * 1.000001) || 10;
  return factor * power;
}
function ticksOf(low, high, count) {
  if (!(low < high)) return [];
  const step = roundStep((high - low) / Math.max(1, count));
  const first = Math.ceil(low / step - 1e-6), last = Math.floor(high / step + 1e-6);
  return Array.from({ length: last - first + 1 }, (_, k) => (first + k) * step);
}
function labelsOf(ticks) {
  const step = ticks.length > 1 ? ticks[1] - ticks[0] : 1;
  let decimals = 0;
  while (decimals < 6 && Math.abs(step * 10 ** decimals - Math.round(step * 10 ** decimals)) > 1e-6 * step * 10 ** decimals) decimals++;
  return ticks.map((tick) => number(tick, decimals));
}
function roundRange(range, count, fallback) {
  if (!range) return fallback;
  let [low, high] = range;
  if (high - low <= 1e-9 * Math.max(Math.abs(high), 1e-9)) [low, high] = [low - 0.5 * Math.max(1, Math.abs(low)), high + 0.5 * Math.max(1, Math.abs(high))];
  const step = roundStep((high - low) / count);
  return [Math.floor(low / step + 1e-6) * step, Math.ceil(high / step - 1e-6) * step];
}

// A frame with linear axes; `y` runs from its lower to its upper edge.
class Axes {
  constructor(left, top, width, height, x, y) {
    Object.assign(this, { left, top, width, height, x, y });
  }
  at(x, y) {
    return [
      this.left + ((x - this.x[0]) / (this.x[1] - this.x[0])) * this.width,
      this.top + this.height - ((y - this.y[0]) / (this.y[1] - this.y[0])) * this.height,
    ];
  }
  back(px, py) {
    return [
      this.x[0] + ((px - this.left) / this.width) * (this.x[1] - this.x[0]),
      this.y[0] + ((this.top + this.height - py) / this.height) * (this.y[1] - this.y[0]),
    ];
  }
  holds(px, py) {
    return px >= this.left && px <= this.left + this.width && py >= this.top && py <= this.top + this.height;
  }
  clip(g) {
    g.beginPath();
    g.rect(this.left, this.top, this.width, this.height);
    g.clip();
  }
  draw(g, xLabel, yLabel, gridLines) {
    const bottom = this.top + this.height;
    g.save();
    g.lineWidth = 1;
    g.font = FONT;
    g.textAlign = "center";
    g.textBaseline = "top";
    const every = ticksOf(Math.min(...this.x), Math.max(...this.x), Math.min(7, this.width / 62));
    const xs = this.whole ? every.filter(Number.isInteger) : every;
    labelsOf(xs).forEach((text, k) => {
      const [px] = this.at(xs[k], this.y[0]);
      mark(g, [[px, bottom], [px, bottom + 4]], theme.muted);
      if (gridLines) mark(g, [[px, this.top], [px, bottom]], theme.line);
      g.fillStyle = theme.muted;
      g.fillText(text, px, bottom + 6);
    });
    g.fillStyle = theme.ink;
    g.fillText(xLabel, this.left + this.width / 2, bottom + 22);
    g.textAlign = "right";
    g.textBaseline = "middle";
    const ys = ticksOf(Math.min(...this.y), Math.max(...this.y), Math.min(7, this.height / 34));
    let widest = 0;
    labelsOf(ys).forEach((text, k) => {
      const [, py] = this.at(this.x[0], ys[k]);
      mark(g, [[this.left - 4, py], [this.left, py]], theme.muted);
      if (gridLines) mark(g, [[this.left, py], [this.left + this.width, py]], theme.line);
      g.fillStyle = theme.muted;
      g.fillText(text, this.left - 6, py);
      widest = Math.max(widest, g.measureText(text).width);
    });
    if (yLabel) upright(g, yLabel, this.left - 6 - widest - 11, this.top + this.height / 2);
    g.strokeStyle = theme.muted;
    g.strokeRect(this.left, this.top, this.width, this.height);
    g.restore();
  }
}

function mark(g, points, colour, width = 1, dash = []) {
  if (points.length < 2) return;
  g.save();
  g.strokeStyle = colour;
  g.lineWidth = width;
  g.setLineDash(dash);
  g.beginPath();
  points.forEach(([x, y], k) => (k ? g.lineTo(x, y) : g.moveTo(x, y)));
  g.stroke();
  g.restore();
}
function upright(g, text, x, y) {
  g.save();
  g.translate(x, y);
  g.rotate(-Math.PI / 2);
  g.textAlign = "center";
  g.textBaseline = "middle";
  g.fillStyle = theme.ink;
  g.fillText(text, 0, 0);
  g.restore();
}
function disc(g, [x, y], radius, fill, edge, width = 1.2) {
  g.beginPath();
  g.arc(x, y, radius, 0, 2 * Math.PI);
  if (fill) { g.fillStyle = fill; g.fill(); }
  if (edge) { g.strokeStyle = edge; g.lineWidth = width; g.stroke(); }
}

function hatched(g, left, top, width, height, ground) {
  g.save();
  g.beginPath();
  g.rect(left, top, width, height);
  g.clip();
  if (ground) { g.fillStyle = theme["no-data"]; g.fillRect(left, top, width, height); }
  g.strokeStyle = theme.hatch;
  g.lineWidth = 1;
  g.beginPath();
  for (let sum = Math.ceil((left + top) / 7) * 7; sum < left + width + top + height; sum += 7) {
    g.moveTo(left, sum - left);
    g.lineTo(left + width, sum - left - width);
  }
  g.stroke();
  g.restore();
}

// A field of columns × rows (rows northward) over a rectangle of the axes.
function field(g, axes, [x0, x1], [y0, y1], columns, rows, value, scale) {
  if (columns < 1 || rows < 1) return;
  const picture = document.createElement("canvas");
  [picture.width, picture.height] = [columns, rows];
  const p = picture.getContext("2d");
  const image = p.createImageData(columns, rows);
  for (let row = 0; row < rows; row++) {
    for (let column = 0; column < columns; column++) {
      const v = value(column, row);
      if (!Number.isFinite(v)) continue;
      const at = 4 * ((rows - 1 - row) * columns + column);
      image.data.set(colourAt(scale.table, (v - scale.range[0]) / (scale.range[1] - scale.range[0])), at);
      image.data[at + 3] = 255;
    }
  }
  p.putImageData(image, 0, 0);
  const [left, bottom] = axes.at(x0, y0), [right, top] = axes.at(x1, y1);
  g.save();
  axes.clip(g);
  hatched(g, left, top, right - left, bottom - top, true);
  g.imageSmoothingEnabled = false;
  g.drawImage(picture, left, top, right - left, bottom - top);
  g.restore();
}

function colourBar(g, left, top, width, height, scale, label) {
  for (let k = 0; k < height; k++) {
    g.fillStyle = css(colourAt(scale.table, 1 - k / (height - 1)));
    g.fillRect(left, top + k, width, 1.5);
  }
  g.strokeStyle = theme.muted;
  g.lineWidth = 1;
  g.strokeRect(left, top, width, height);
  const ticks = ticksOf(scale.range[0], scale.range[1], Math.min(6, height / 34));
  g.textAlign = "left";
  g.textBaseline = "middle";
  let widest = 0;
  labelsOf(ticks).forEach((text, k) => {
    const y = top + height - ((ticks[k] - scale.range[0]) / (scale.range[1] - scale.range[0])) * height;
    mark(g, [[left + width, y], [left + width + 4, y]], theme.muted);
    g.fillStyle = theme.muted;
    g.fillText(text, left + width + 6, y);
    widest = Math.max(widest, g.measureText(text).width);
  });
  upright(g, label, left + width + 6 + widest + 12, top + height / 2);
}
