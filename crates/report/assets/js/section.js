// Sound speed: a section from west to east through the chosen cell, and profiles.

const soundRange = roundRange(over(run.epochs, (epoch) => epoch.sound.speed_m_s), 5, [1480, 1540]);
const deepest = Math.max(1, ...run.epochs.map(({ sound }) => {
  const points = sound.east_m.length * sound.north_m.length;
  for (let level = sound.depth_m.length - 1; level >= 0; level--) {
    for (let k = 0; k < points; k++) {
      if (Number.isFinite(sound.speed_m_s[level * points + k])) return sound.depth_m[level];
    }
  }
  return 0;
}));
let sectionAxes = null;

// The cell whose section and profile are shown: the kept one, else the middle.
const sectionCell = () => state.kept ?? Math.floor(grid.rows / 2) * grid.columns + Math.floor(grid.columns / 2);

function drawSection() {
  const { sound } = now();
  const cell = sectionCell();
  const [east, north] = centre(cell);
  byId("section-title").textContent = `Sound speed from west to east, ${number(north / 1000, 1)} km north`;
  const canvas = byId("section");
  const height = 250;
  const [g, width] = prepared(canvas, height + 50);
  sectionAxes = new Axes(58, 8, Math.max(60, width - 58 - 80), height, [0, widthM / 1000], [deepest, 0]);
  if (sound.east_m.length && sound.north_m.length) {
    const row = nearest(sound.north_m, north);
    g.save();
    sectionAxes.clip(g);
    g.fillStyle = theme["no-data"];
    g.fillRect(sectionAxes.left, sectionAxes.top, sectionAxes.width, sectionAxes.height);
    const middles = (points) => points.slice(1).map((p, k) => (p + points[k]) / 2);
    const xs = [sound.east_m[0], ...middles(sound.east_m), sound.east_m.at(-1)];
    const ys = [0, ...middles(sound.depth_m), sound.depth_m.at(-1) + 500];
    sound.depth_m.forEach((_, level) => sound.east_m.forEach((__, column) => {
      const c = soundAt(now(), level, column, row);
      if (!Number.isFinite(c)) return;
      const [l, t] = sectionAxes.at(xs[column] / 1000, ys[level]), [r, b] = sectionAxes.at(xs[column + 1] / 1000, ys[level + 1]);
      g.fillStyle = css(colourAt("thermal", (c - soundRange[0]) / (soundRange[1] - soundRange[0])));
      g.fillRect(l, t, r - l + 0.6, b - t + 0.6);
    }));
    drawBottom(g, Math.floor(cell / grid.columns));
    mark(g, [sectionAxes.at(0, run.fleet_depth_m), sectionAxes.at(widthM / 1000, run.fleet_depth_m)], "#ffffff", 1.4, [6, 4]);
    mark(g, [sectionAxes.at(east / 1000, 0), sectionAxes.at(east / 1000, deepest)], "rgb(255 255 255 / 55%)", 1.2);
    g.restore();
  }
  sectionAxes.draw(g, "East (km)", "Depth (m)");
  colourBar(g, sectionAxes.left + sectionAxes.width + 12, 8, 12, height, { table: "thermal", range: soundRange }, "Sound speed (m/s)");
  drawProfile(height);
}

function drawBottom(g, row) {
  const depth = (column) => run.depth_m[row * grid.columns + column];
  const points = [];
  for (let column = 0; column < grid.columns; column++) {
    if (Number.isFinite(depth(column))) points.push(sectionAxes.at(((column + 0.5) * grid.cell_width_m) / 1000, depth(column)));
  }
  if (!points.length) return;
  const floor = sectionAxes.top + sectionAxes.height + 2;
  points.unshift([sectionAxes.left, points[0][1]]);
  points.push([sectionAxes.left + sectionAxes.width, points.at(-1)[1]]);
  g.beginPath();
  g.moveTo(points[0][0], floor);
  points.forEach(([x, y]) => g.lineTo(x, y));
  g.lineTo(points.at(-1)[0], floor);
  g.closePath();
  g.fillStyle = theme.seabed;
  g.fill();
  mark(g, points, "#1f2933", 1.2);
}

function drawProfile(height) {
  const { sound } = now();
  const [g, width] = prepared(byId("profile"), height + 50);
  const axes = new Axes(52, 8, Math.max(60, width - 52 - 14), height, soundRange, [deepest, 0]);
  axes.draw(g, "Sound speed (m/s)", width > 330 ? "Depth (m)" : "", true);
  const points = sound.east_m.length * sound.north_m.length;
  if (!points) return;
  const [east, north] = centre(sectionCell());
  const column = nearest(sound.east_m, east), row = nearest(sound.north_m, north);
  const slowest = [], quickest = [], mean = [], here = [];
  sound.depth_m.forEach((depth, level) => {
    const values = sound.speed_m_s.subarray(level * points, (level + 1) * points).filter(Number.isFinite);
    const range = extent(values);
    if (!range) return;
    slowest.push(axes.at(range[0], depth));
    quickest.push(axes.at(range[1], depth));
    mean.push(axes.at(values.reduce((sum, c) => sum + c, 0) / values.length, depth));
    const c = soundAt(now(), level, column, row);
    if (Number.isFinite(c)) here.push(axes.at(c, depth));
  });
  g.save();
  axes.clip(g);
  g.beginPath();
  slowest.concat(quickest.reverse()).forEach(([x, y], k) => (k ? g.lineTo(x, y) : g.moveTo(x, y)));
  g.globalAlpha = 0.25;
  g.fillStyle = theme.muted;
  g.fill();
  g.globalAlpha = 1;
  mark(g, mean, theme.ink, 1.8);
  mark(g, here, theme.post, 1.6);
  mark(g, [axes.at(soundRange[0], run.fleet_depth_m), axes.at(soundRange[1], run.fleet_depth_m)], theme.muted, 1.2, [6, 4]);
  g.restore();
  g.textAlign = "right";
  g.textBaseline = "bottom";
  [["range", theme.muted], ["mean", theme.ink], ["at the cell", theme.post]].forEach(([text, colour], k) => {
    g.fillStyle = colour;
    g.fillText(text, axes.left + axes.width - 8, axes.top + axes.height - 8 - 16 * (2 - k));
  });
}

function sectionValue(px, py) {
  const { sound } = now();
  if (!sectionAxes || !sectionAxes.holds(px, py) || !sound.east_m.length || !sound.depth_m.length) {
    return "Dashed: the fleet's depth. A click on the map moves the section and the profile.";
  }
  const [east, depth] = sectionAxes.back(px, py);
  const c = soundAt(now(), nearest(sound.depth_m, depth), nearest(sound.east_m, east * 1000), nearest(sound.north_m, centre(sectionCell())[1]));
  return `${number(east, 1)} km east, ${number(depth, 0)} m deep: ${Number.isFinite(c) ? `${number(c, 1)} m/s` : "below the bottom"}`;
}
