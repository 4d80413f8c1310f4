// What the map can show: where its values come from, and in which colours.

const soundAt = (epoch, level, column, row) => {
  const { north_m, east_m, speed_m_s } = epoch.sound;
  return speed_m_s[(level * north_m.length + row) * east_m.length + column];
};
const speedAt = (epoch, column, row) => {
  const k = row * epoch.current.east_m.length + column;
  return Math.hypot(epoch.current.u_m_s[k], epoch.current.v_m_s[k]);
};
// Half a step beyond the outermost points.
const span = (points) => {
  const last = points.length - 1;
  const half = last > 0 ? (points[last] - points[0]) / last / 2 : 500;
  return [(points[0] - half) / 1000, (points[last] + half) / 1000];
};
const over = (epochs, values) => {
  let range = null;
  for (const epoch of epochs) {
    const own = extent(values(epoch));
    if (own) range = range ? [Math.min(range[0], own[0]), Math.max(range[1], own[1])] : own;
  }
  return range;
};
const onCells = (values) => ({
  columns: grid.columns, rows: grid.rows, x: [0, widthM / 1000], y: [0, heightM / 1000],
  value: (column, row) => values[row * grid.columns + column],
});
function percentiles(values, low, high) {
  const sorted = Array.from(values).filter(Number.isFinite).sort((a, b) => a - b);
  return sorted.length ? [sorted[Math.floor(low * (sorted.length - 1))], sorted[Math.ceil(high * (sorted.length - 1))]] : null;
}
const currentSpeeds = (epoch) => epoch.current.u_m_s.map((u, k) => Math.hypot(u, epoch.current.v_m_s[k]));
const fastest = (over(run.epochs, currentSpeeds) || [0, 0])[1] || 1;
const priorTop = (over(run.epochs, (epoch) => epoch.prior) || [0, 0])[1];

// Ranges are the same for all epochs, so that colours can be compared.
const layers = {
  detection: {
    name: "Detection, target layout", label: "Detection probability",
    scale: { table: "dense", range: [0, 1] }, of: (epoch) => onCells(epoch.detection),
  },
  random: {
    name: "Detection, random layout", label: "Detection probability",
    scale: { table: "dense", range: [0, 1] }, of: (epoch) => onCells(epoch.random_detection),
  },
  difference: {
    name: "Detection, target − random", label: "Difference of detection probability",
    scale: { table: "balance", range: [-1, 1] },
    of: (epoch) => onCells(epoch.detection.map((p, k) => p - epoch.random_detection[k])),
  },
  prior: {
    name: "Target prior", label: "Target prior",
    scale: { table: "amp", range: priorTop > 0 ? roundRange([0, priorTop], 8) : [0, 1] }, of: (epoch) => onCells(epoch.prior),
  },
  loss: {
    name: "Transmission loss from ◇", label: "Transmission loss (dB)",
    scale: { table: "loss", range: roundRange(over(run.epochs, (e) => (percentiles(e.loss_db, 0.02, 0.98) || []).map((db) => Math.min(db, 120))), 5, [40, 120]) },
    of: (epoch) => onCells(epoch.loss_db),
  },
  current: {
    name: "Speed of the current", label: "Current (m/s)",
    scale: { table: "speed", range: [0, roundRange([0, fastest], 6)[1]] },
    of: (epoch) => ({
      columns: epoch.current.east_m.length, rows: epoch.current.north_m.length,
      x: span(epoch.current.east_m), y: span(epoch.current.north_m),
      value: (column, row) => speedAt(epoch, column, row),
    }),
  },
  sound: {
    name: "Sound speed", label: "Sound speed (m/s)",
    scale: { table: "thermal", range: [1480, 1540] },
    of: (epoch) => ({
      columns: epoch.sound.east_m.length, rows: epoch.sound.north_m.length,
      x: span(epoch.sound.east_m), y: span(epoch.sound.north_m),
      value: (column, row) => soundAt(epoch, state.level, column, row),
    }),
  },
  depth: {
    name: "Water depth", label: "Depth (m)",
    scale: { table: "deep", range: roundRange(extent(run.depth_m), 5, [0, 1000]) }, of: () => onCells(run.depth_m),
  },
};
// The range of sound speed is that of the chosen depth.
function scaleSound() {
  const values = (epoch) => {
    const points = epoch.sound.east_m.length * epoch.sound.north_m.length;
    return epoch.sound.speed_m_s.subarray(state.level * points, (state.level + 1) * points);
  };
  layers.sound.scale.range = roundRange(over(run.epochs, values), 5, [1480, 1540]);
}
