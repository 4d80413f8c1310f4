// The record, unpacked: fields of numbers become arrays, NaN where a value is missing.

const byId = (id) => document.getElementById(id);
const parsed = (id) => JSON.parse(byId(id).textContent);
const MISSING = 65535;

function unpacked({ low, high, codes }) {
  const bytes = atob(codes);
  const values = new Float32Array(bytes.length / 2);
  for (let k = 0; k < values.length; k++) {
    const code = bytes.charCodeAt(2 * k) | (bytes.charCodeAt(2 * k + 1) << 8);
    values[k] = code === MISSING ? NaN : low + ((high - low) * code) / (MISSING - 1);
  }
  return values;
}

const run = parsed("record");
run.depth_m = unpacked(run.depth_m);
for (const epoch of run.epochs) {
  for (const name of ["prior", "detection", "random_detection", "loss_db"]) {
    epoch[name] = unpacked(epoch[name]);
  }
  epoch.sound.speed_m_s = unpacked(epoch.sound.speed_m_s);
  epoch.current.u_m_s = unpacked(epoch.current.u_m_s);
  epoch.current.v_m_s = unpacked(epoch.current.v_m_s);
  // The track, then what is planned beyond the epoch, as one line.
  for (const route of epoch.routes) {
    route.line = route.track.concat(route.planned);
  }
}

const grid = run.grid;
const widthM = grid.columns * grid.cell_width_m;
const heightM = grid.rows * grid.cell_height_m;
const centre = (cell) => [
  ((cell % grid.columns) + 0.5) * grid.cell_width_m,
  (Math.floor(cell / grid.columns) + 0.5) * grid.cell_height_m,
];

// What the reader has chosen.
const state = {
  epoch: 0,
  layer: "detection",
  level: 0,
  fraction: 1,
  vehicle: null,
  cell: null,
  kept: null,
  show: { posts: true, routes: true, current: false, depth: false },
};
const now = () => run.epochs[state.epoch];

// Numbers as text: a true minus sign, a dash where there is none.
function number(value, decimals) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  const text = value.toFixed(decimals);
  if (/^-[0.]+$/.test(text)) return text.slice(1);
  return text.replace("-", "−");
}
const withUnit = (value, decimals, unit) => {
  const text = number(value, decimals);
  return text === "–" ? text : `${text} ${unit}`;
};

const hours = (value) => withUnit(value, Number.isInteger(value) ? 0 : 1, "h");

function extent(values) {
  let low = Infinity, high = -Infinity;
  for (const value of values) {
    if (value < low) low = value;
    if (value > high) high = value;
  }
  return low <= high ? [low, high] : null;
}

function nearest(points, value) {
  let best = 0;
  points.forEach((point, k) => {
    if (Math.abs(point - value) < Math.abs(points[best] - value)) best = k;
  });
  return best;
}

// Where a line of [time, east, north] is at a time; its ends beyond them.
function along(line, time) {
  if (line.length === 0) return null;
  if (time <= line[0][0]) return line[0];
  for (let k = 1; k < line.length; k++) {
    const [from, to] = [line[k - 1], line[k]];
    if (time <= to[0]) {
      const t = to[0] > from[0] ? (time - from[0]) / (to[0] - from[0]) : 1;
      return from.map((value, axis) => value + t * (to[axis] - value));
    }
  }
  return line[line.length - 1];
}

function element(tag, text, className) {
  const node = document.createElement(tag);
  if (text !== undefined) node.textContent = text;
  if (className) node.className = className;
  return node;
}
