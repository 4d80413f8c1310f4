// The map: a layer, and over it posts, routes, current, contours of depth.

// The region, and what of the transit margin the vehicles use.
const view = (() => {
  const margin = run.transit_margin_m;
  let [west, east, south, north] = [0, widthM, 0, heightM];
  for (const epoch of run.epochs) {
    for (const route of epoch.routes) {
      for (const [, x, y] of route.line) {
        west = Math.min(west, Math.max(x, -margin));
        east = Math.max(east, Math.min(x, widthM + margin));
        south = Math.min(south, Math.max(y, -margin));
        north = Math.max(north, Math.min(y, heightM + margin));
      }
    }
  }
  const pad = 0.02 * Math.max(widthM, heightM);
  return { x: [(west - pad) / 1000, (east + pad) / 1000], y: [(south - pad) / 1000, (north + pad) / 1000] };
})();

let mapAxes = null;
const place = ([east, north]) => mapAxes.at(east / 1000, north / 1000);
const timeNow = () => now().start_h + state.fraction * now().duration_h;

function drawMap() {
  const canvas = byId("map");
  const [left, right, top, bottom] = [52, 76, 8, 42];
  const room = (canvas.clientWidth || 600) - left - right;
  const aspect = (view.y[1] - view.y[0]) / (view.x[1] - view.x[0]);
  const width = Math.min(room, 760 / aspect);
  const height = width * aspect;
  const [g] = prepared(canvas, height + top + bottom);
  mapAxes = new Axes(left + (room - width) / 2, top, width, height, view.x, view.y);
  const epoch = now(), layer = layers[state.layer], source = layer.of(epoch);

  field(g, mapAxes, source.x, source.y, source.columns, source.rows, source.value, layer.scale);
  g.save();
  mapAxes.clip(g);
  for (const cell of run.blocked_cells) {
    const [x, y] = centre(cell);
    const [l, b] = place([x - grid.cell_width_m / 2, y - grid.cell_height_m / 2]);
    const [r, t] = place([x + grid.cell_width_m / 2, y + grid.cell_height_m / 2]);
    hatched(g, l, t, r - l, b - t, false);
  }
  if (state.show.depth) drawContours(g);
  if (state.show.current) drawCurrent(g, epoch);
  const [l, b] = place([0, 0]), [r, t] = place([widthM, heightM]);
  g.strokeStyle = theme.ink;
  g.lineWidth = 1.4;
  g.strokeRect(l, t, r - l, b - t);
  if (state.show.routes) drawRoutes(g, epoch);
  if (state.show.posts) drawPosts(g, epoch);
  if (state.layer === "loss") diamond(g, place(centre(epoch.loss_source)));
  for (const cell of run.fixed_sensors) diamond(g, place(centre(cell)));
  if (state.show.routes) drawVehicles(g, epoch);
  drawCursor(g);
  g.restore();
  mapAxes.draw(g, "East (km)", "North (km)");
  colourBar(g, mapAxes.left + width + 12, top, 12, height, layer.scale, layer.label);
  canvas.setAttribute("aria-label", `Map of the region in epoch ${epoch.index}: ${layer.name}`);
}

function drawContours(g) {
  const at = (column, row) => run.depth_m[row * grid.columns + column];
  const range = extent(run.depth_m);
  if (!range) return;
  for (const level of ticksOf(range[0], range[1], 6)) {
    for (let row = 0; row + 1 < grid.rows; row++) {
      for (let column = 0; column + 1 < grid.columns; column++) {
        const corners = [[0, 0], [1, 0], [1, 1], [0, 1]].map(([dx, dy]) => [column + dx, row + dy, at(column + dx, row + dy) - level]);
        const crossings = [];
        corners.forEach(([x, y, v], k) => {
          const [X, Y, V] = corners[(k + 1) % 4];
          if ((v < 0) !== (V < 0) && Number.isFinite(v + V)) {
            const t = v / (v - V);
            crossings.push(place([(x + t * (X - x) + 0.5) * grid.cell_width_m, (y + t * (Y - y) + 0.5) * grid.cell_height_m]));
          }
        });
        for (let k = 0; k + 1 < crossings.length; k += 2) {
          mark(g, [crossings[k], crossings[k + 1]], "rgb(255 255 255 / 75%)", 1.6);
          mark(g, [crossings[k], crossings[k + 1]], "rgb(70 80 90 / 80%)", 0.8);
        }
      }
    }
  }
}

function drawCurrent(g, epoch) {
  const { east_m, north_m, u_m_s, v_m_s } = epoch.current;
  const scale = mapAxes.width / (view.x[1] - view.x[0]) / 1000;
  const stride = (points) => (points.length > 1 ? Math.max(1, Math.ceil(24 / (Math.abs(points[1] - points[0]) * scale))) : 1);
  const [skipX, skipY] = [stride(east_m), stride(north_m)];
  for (let row = 0; row < north_m.length; row += skipY) {
    for (let column = 0; column < east_m.length; column += skipX) {
      const k = row * east_m.length + column;
      const speed = Math.hypot(u_m_s[k], v_m_s[k]);
      if (speed > 0) arrow(g, place([east_m[column], north_m[row]]), [u_m_s[k] / speed, -v_m_s[k] / speed], (speed / fastest) * 26);
    }
  }
}
function arrow(g, [x, y], [dx, dy], length) {
  if (length < 1.5) return;
  const tip = [x + (dx * length) / 2, y + (dy * length) / 2];
  const head = Math.min(6, length * 0.6);
  const neck = [tip[0] - dx * head, tip[1] - dy * head];
  for (const [colour, extra] of [["rgb(255 255 255 / 80%)", 1.6], ["#3b4754", 0]]) {
    mark(g, [[x - (dx * length) / 2, y - (dy * length) / 2], neck], colour, 1.2 + extra);
    g.beginPath();
    g.moveTo(...tip);
    g.lineTo(neck[0] - dy * head * 0.38, neck[1] + dx * head * 0.38);
    g.lineTo(neck[0] + dy * head * 0.38, neck[1] - dx * head * 0.38);
    g.closePath();
    g.fillStyle = g.strokeStyle = colour;
    g.lineWidth = extra;
    if (extra) g.stroke();
    g.fill();
  }
}

function drawRoutes(g, epoch) {
  const time = timeNow();
  const chosen = (route) => route.vehicle === state.vehicle;
  const ordered = [...epoch.routes].sort((a, b) => chosen(a) - chosen(b));
  for (const route of ordered) {
    const here = along(route.line, time);
    if (!here) continue;
    const dim = state.vehicle !== null && !chosen(route);
    g.globalAlpha = dim ? 0.35 : 1;
    const points = (line) => line.map(([, x, y]) => place([x, y]));
    const past = points(route.line.filter(([t]) => t < time).concat([here]));
    const ahead = points([here].concat(route.line.filter(([t]) => t > time)));
    const colour = chosen(route) ? "#d95f0e" : "#145da0";
    mark(g, ahead, "rgb(255 255 255 / 70%)", 2.6);
    mark(g, ahead, chosen(route) ? "#d95f0e" : "#4a8fd0", 1.2, [5, 4]);
    mark(g, past, "rgb(255 255 255 / 85%)", chosen(route) ? 5 : 3.4);
    mark(g, past, colour, chosen(route) ? 2.8 : 1.7);
  }
  g.globalAlpha = 1;
}

function drawPosts(g, epoch) {
  if (state.layer === "random") {
    for (const cell of epoch.random_layout) ring(g, place(centre(cell)));
    return;
  }
  const failed = new Set(epoch.routes.filter((route) => route.failure).map((route) => route.post));
  for (const cell of epoch.layout) {
    const at = place(centre(cell));
    if (failed.has(cell)) cross(g, at); else ring(g, at);
  }
}
function ring(g, at) {
  disc(g, at, 4.6, null, "#1f2933", 3.4);
  disc(g, at, 4.6, null, "#ffffff", 1.8);
}
function cross(g, [x, y]) {
  for (const [colour, width] of [["#ffffff", 5], ["#c2183c", 2.6]]) {
    mark(g, [[x - 5, y - 5], [x + 5, y + 5]], colour, width);
    mark(g, [[x - 5, y + 5], [x + 5, y - 5]], colour, width);
  }
}
function diamond(g, [x, y]) {
  g.beginPath();
  [[0, -7], [7, 0], [0, 7], [-7, 0]].forEach(([dx, dy], k) => (k ? g.lineTo(x + dx, y + dy) : g.moveTo(x + dx, y + dy)));
  g.closePath();
  g.fillStyle = "#ffffff";
  g.fill();
  g.strokeStyle = "#1f2933";
  g.lineWidth = 1.6;
  g.stroke();
}
function drawVehicles(g, epoch) {
  for (const route of epoch.routes) {
    const here = along(route.track, timeNow());
    if (here) disc(g, place(here.slice(1)), route.vehicle === state.vehicle ? 5.5 : 3.6, route.vehicle === state.vehicle ? "#d95f0e" : "#145da0", "#ffffff", 1.3);
  }
}
function drawCursor(g) {
  const cell = state.cell ?? state.kept;
  if (cell === null) return;
  const [x, y] = centre(cell);
  const [l, b] = place([x - grid.cell_width_m / 2, y - grid.cell_height_m / 2]);
  const [r, t] = place([x + grid.cell_width_m / 2, y + grid.cell_height_m / 2]);
  g.strokeStyle = "#ffffff";
  g.lineWidth = 3.5;
  g.strokeRect(l, t, r - l, b - t);
  g.strokeStyle = "#1f2933";
  g.lineWidth = 1.5;
  g.strokeRect(l, t, r - l, b - t);
}

// The cell under a point of the canvas, null outside the region.
function cellAt(px, py) {
  const [east, north] = mapAxes.back(px, py).map((km) => km * 1000);
  if (east < 0 || north < 0 || east >= widthM || north >= heightM) return null;
  return Math.floor(north / grid.cell_height_m) * grid.columns + Math.floor(east / grid.cell_width_m);
}
// The vehicle nearest to a point of the canvas, null beyond 14 pixels.
function vehicleAt(px, py) {
  let best = null, distance = 14;
  for (const route of now().routes) {
    const here = along(route.track, timeNow());
    if (!here) continue;
    const [x, y] = place(here.slice(1));
    const own = Math.hypot(x - px, y - py);
    if (own < distance) [best, distance] = [route.vehicle, own];
  }
  return best;
}
