// Key numbers, tables, charts over the epochs.

const gap = (m) => (m.upper_bound > 0 ? 1 - m.detection_utility / m.upper_bound : NaN);
const percent = (value, decimals = 1) => withUnit(100 * value, decimals, "%");
function badge(feasible) {
  return element("span", feasible ? "feasible" : "infeasible", `badge ${feasible ? "good" : "bad"}`);
}
function symbol(letter, subscript) {
  const node = document.createDocumentFragment();
  node.append(element("i", letter), element("sub", subscript));
  return node;
}

function withWords(node, words) {
  node.append(words);
  return node;
}

function drawTiles() {
  const { metrics: m, routes, duration_h } = now();
  const tile = (name, value, note, extra) => {
    const node = element("div", undefined, "tile");
    const title = element("div", undefined, "name");
    title.append(...name);
    const figure = element("div", value, "value");
    if (extra) figure.append(" ", extra);
    node.append(title, figure, element("div", note, "note"));
    return node;
  };
  const loss = m.transmission_loss;
  byId("tiles").replaceChildren(
    tile(["Detection utility ", symbol("J", "d")], number(m.detection_utility, 2), `random layout ${number(m.random_detection_utility, 2)}`),
    tile(["Connectivity λ₂"], number(m.algebraic_connectivity, 3), `required τ = ${run.connectivity_threshold}`, badge(m.feasible)),
    tile(["Gap to the upper bound"], percent(gap(m)), `bound ${number(m.upper_bound, 2)}`),
    tile(["On post at the end"], `${m.arrived} of ${routes.length}`, m.unreachable ? `${m.unreachable} cannot reach theirs` : `after ${hours(duration_h)}`),
    tile(["Mean travel time"], withUnit(m.mean_travel_time_h, 1, "h"), `longest ${withUnit(m.largest_travel_time_h, 1, "h")}`),
    tile(["Transmission loss"], `${number(loss.median_error_db, 2)} / ${number(loss.p90_error_db, 2)}`, "dB from fine settings, median / 90 %"),
  );
}

// How a transmission-loss table was made.
function lossRows(name, table) {
  return [
    ["group", name],
    ["Model", (m) => table(m).model],
    ["Frequency", (m) => withUnit(table(m).frequency_hz, 0, "Hz")],
    ["Directions", (m) => (table(m).both_directions ? "mean of both" : "one")],
    ["Beams × bearings", (m) => `${table(m).beams} × ${table(m).bearings}`],
    ["Largest range", (m) => withUnit(table(m).range_m / 1000, 1, "km")],
    ["Median difference from fine settings", (m) => withUnit(table(m).median_error_db, 2, "dB")],
    ["90th percentile of the difference", (m) => withUnit(table(m).p90_error_db, 2, "dB")],
    ["Sources compared", (m) => String(table(m).sampled_sources)],
  ];
}

// Parts of the placement method in any epoch, in the order of their work; the last
// part's layout is the method's.
function parts() {
  const names = run.epochs.flatMap((e) => e.metrics.placement_parts.slice(0, -1).map((p) => p.by));
  return [...new Set(names)];
}

function partOf(m, by) {
  const part = m.placement_parts.find((p) => p.by === by);
  if (!part) return "–";
  return number(part.detection_utility, 3) + (part.feasible ? "" : " (infeasible)");
}

function drawNumbers() {
  const rows = [
    ["group", "Layout"],
    ["Detection utility of the target layout", (m) => number(m.detection_utility, 3)],
    ["Algebraic connectivity λ₂", (m) => number(m.algebraic_connectivity, 4)],
    ["λ₂ ≥ τ", (m) => badge(m.feasible)],
    ["Upper bound on the detection utility", (m) => number(m.upper_bound, 3)],
    ["Gap to the bound", (m) => percent(gap(m), 2)],
    ["Detection utility of a random layout", (m) => number(m.random_detection_utility, 3)],
    ["λ₂ of the random layout", (m) => number(m.random_algebraic_connectivity, 4)],
    ...parts().map((by) => [`Detection utility of ${by} alone`, (m) => partOf(m, by)]),
    ["Proposals evaluated", (m) => m.evaluations.toLocaleString("en")],
    ["group", "Vehicles"],
    ["Detection utility where they start", (m) => number(m.detection_utility_at_start, 3)],
    ["Detection utility where they end", (m) => number(m.detection_utility_at_end, 3)],
    ["λ₂ where they end", (m) => number(m.algebraic_connectivity_at_end, 4)],
    ["On post at the end", (m, e) => `${m.arrived} of ${e.routes.length}`],
    ["Post unreachable", (m) => String(m.unreachable)],
    ["Mean travel time expected", (m) => withUnit(m.mean_travel_time_h, 2, "h")],
    ["Largest travel time expected", (m) => withUnit(m.largest_travel_time_h, 2, "h")],
    ...lossRows("Transmission-loss table", (m) => m.transmission_loss),
    ...(run.epochs.some((e) => e.metrics.communication_loss)
      ? lossRows("Transmission-loss table of the links", (m) => m.communication_loss ?? m.transmission_loss)
      : []),
    ["group", "Wall-clock seconds"],
  ];
  const stages = [...new Set(run.epochs.flatMap((e) => e.seconds.map(([stage]) => stage)))];
  const seconds = (e, stage) => e.seconds.find(([name]) => name === stage)?.[1];
  for (const stage of stages) rows.push([stage, (m, e) => number(seconds(e, stage), 2)]);
  rows.push(["all stages", (m, e) => number(e.seconds.reduce((sum, [, s]) => sum + s, 0), 2)]);

  const table = byId("numbers");
  const head = element("tr");
  head.append(element("th", ""));
  run.epochs.forEach((epoch, k) => {
    const cell = element("th", `Epoch ${epoch.index}`, k === state.epoch ? "now" : "");
    cell.scope = "col";
    cell.append(element("br"), element("span", epoch.time.replace(/^\d{4}-/, ""), "hint"));
    head.append(cell);
  });
  const body = element("tbody");
  for (const [name, value] of rows) {
    const row = element("tr");
    if (name === "group") {
      const title = element("th", value);
      title.scope = "rowgroup";
      row.className = "group";
      row.append(title);
      run.epochs.forEach(() => row.append(element("td")));
    } else {
      const title = element("th", name);
      title.scope = "row";
      row.append(title);
      run.epochs.forEach((epoch, k) => {
        const cell = element("td", undefined, k === state.epoch ? "now" : "");
        cell.append(value(epoch.metrics, epoch));
        row.append(cell);
      });
    }
    body.append(row);
  }
  const top = element("thead");
  top.append(head);
  table.replaceChildren(top, body);
}

const fate = (route) => (route.failure ? "unreachable" : route.arrived ? "on post" : "under way");
const spot = (cell) => `${number(run.longitude_deg[cell], 3)}° E, ${number(run.latitude_deg[cell], 3)}° N`;

function drawVehicleTable(choose) {
  const head = element("tr");
  for (const name of ["Vehicle", "At the end", "Expected", "Post", "Why not"]) head.append(element("th", name));
  head.lastChild.style.textAlign = "left";
  const body = element("tbody");
  for (const route of now().routes) {
    const row = element("tr", undefined, `pick${route.vehicle === state.vehicle ? " now" : ""}`);
    row.append(element("td", String(route.vehicle)), element("td", fate(route)), element("td", withUnit(route.expected_h, 1, "h")), element("td", spot(route.post)), element("td", route.failure || "", "words"));
    row.addEventListener("click", () => choose(route.vehicle));
    body.append(row);
  }
  const top = element("thead");
  top.append(head);
  byId("vehicles").replaceChildren(top, body);
}

function pairs(list, entries) {
  list.replaceChildren(...entries.flatMap(([name, value, words]) => {
    const title = element("dt");
    title.append(name);
    return words ? [element("dd", value, "words")] : [title, element("dd", value)];
  }));
}

function drawRoute() {
  const route = now().routes.find(({ vehicle }) => vehicle === state.vehicle);
  if (!route) {
    const count = (name) => String(now().routes.filter((r) => fate(r) === name).length);
    pairs(byId("route"), ["on post", "under way", "unreachable"].map((name) => [name, count(name)]));
    return;
  }
  const end = route.line.at(-1);
  const entries = [
    ["At the end of the epoch", fate(route)],
    ["Expected travel time", withUnit(route.expected_h, 1, "h")],
    ["Post", spot(route.post)],
  ];
  if (end && !route.failure) entries.push(["At the post after", withUnit(end[0] - now().start_h, 1, "h")]);
  if (route.failure) entries.push(["", route.failure, true]);
  pairs(byId("route"), entries);
}

function drawCell() {
  const cell = state.cell ?? state.kept ?? sectionCell();
  const epoch = now(), { current, sound } = epoch;
  const [east, north] = centre(cell);
  const entries = [
    ["Longitude, latitude", spot(cell)],
    ["East, north", `${number(east / 1000, 1)}, ${number(north / 1000, 1)} km`],
    ["Water depth", withUnit(run.depth_m[cell], 0, "m")],
    [symbol("P", "T"), number(epoch.prior[cell], 4)],
    [symbol("P", "net"), number(epoch.detection[cell], 4)],
    [withWords(symbol("P", "net"), ", random layout"), number(epoch.random_detection[cell], 4)],
    ["Loss from ◇", withUnit(epoch.loss_db[cell], 1, "dB")],
  ];
  if (current.east_m.length && current.north_m.length) {
    const k = nearest(current.north_m, north) * current.east_m.length + nearest(current.east_m, east);
    const towards = (Math.atan2(current.u_m_s[k], current.v_m_s[k]) * 180 / Math.PI + 360) % 360;
    const speed = Math.hypot(current.u_m_s[k], current.v_m_s[k]);
    entries.push(["Current", Number.isFinite(speed) ? `${number(speed, 2)} m/s to ${number(towards, 0)}°` : "–"]);
  }
  if (sound.east_m.length && sound.north_m.length && sound.depth_m.length) {
    const level = nearest(sound.depth_m, run.fleet_depth_m);
    entries.push([`Sound speed, ${number(sound.depth_m[level], 0)} m`, withUnit(soundAt(epoch, level, nearest(sound.east_m, east), nearest(sound.north_m, north)), 1, "m/s")]);
  }
  if (run.blocked_cells.includes(cell)) entries.push(["", "No vehicle may be placed here.", true]);
  pairs(byId("cell"), entries);
}

function drawUtility() {
  const series = [
    ["upper bound", (m) => m.upper_bound, theme.muted, [5, 4]],
    ["target layout", (m) => m.detection_utility, theme.accent, []],
    ["vehicles at the end", (m) => m.detection_utility_at_end, theme.post, []],
    ["vehicles at the start", (m) => m.detection_utility_at_start, theme.post, [2, 4]],
    ["random layout", (m) => m.random_detection_utility, theme.muted, [2, 3]],
  ];
  const all = series.flatMap(([, of]) => run.epochs.map((e) => of(e.metrics))).filter(Number.isFinite);
  const [g, width] = prepared(byId("utility"), 276);
  const top = roundRange([0, Math.max(...all, 0) || 1], 5)[1];
  const last = run.epochs.length - 1;
  const axes = new Axes(44, 10, Math.max(60, width - 44 - 12), 160, [-0.15, last + 0.15], [0, top]);
  axes.whole = true;
  axes.draw(g, "Epoch", "", true);
  const [x] = axes.at(state.epoch, 0);
  mark(g, [[x, axes.top], [x, axes.top + axes.height]], theme.muted, 1, [2, 2]);
  series.forEach(([name, of, colour, dash], k) => {
    const points = run.epochs.map((e, n) => [n, of(e.metrics)]).filter(([, v]) => Number.isFinite(v)).map(([n, v]) => axes.at(n, v));
    mark(g, points, colour, 1.8, dash);
    points.forEach((point) => disc(g, point, 3, colour));
    const left = 8 + (k % 2) * (width / 2), y = 222 + Math.floor(k / 2) * 18;
    mark(g, [[left, y], [left + 22, y]], colour, 1.8, dash);
    g.fillStyle = theme.ink;
    g.textAlign = "left";
    g.textBaseline = "middle";
    g.fillText(name, left + 28, y);
  });
}

function drawHistory() {
  const { placement_history: history, upper_bound: bound } = now().metrics;
  const points = history.filter(([, v]) => Number.isFinite(v));
  const [g, width] = prepared(byId("history"), 180);
  const most = Math.max(1, ...points.map(([n]) => n));
  const unit = most >= 1e6 ? [1e6, "million"] : most >= 1e4 ? [1e3, "thousand"] : [1, ""];
  const range = roundRange(extent(points.map(([, v]) => v).concat(Number.isFinite(bound) ? [bound] : [])), 5, [0, 1]);
  const axes = new Axes(44, 8, Math.max(60, width - 44 - 12), 126, [0, most / unit[0]], range);
  axes.draw(g, `Proposals evaluated${unit[1] ? ` (${unit[1]}s)` : ""}`, "", true);
  const line = [];
  points.forEach(([n, v], k) => {
    if (k) line.push(axes.at(n / unit[0], points[k - 1][1]));
    line.push(axes.at(n / unit[0], v));
  });
  if (Number.isFinite(bound)) mark(g, [axes.at(0, bound), axes.at(most / unit[0], bound)], theme.muted, 1.6, [5, 4]);
  mark(g, line, theme.accent, 1.8);
  if (line.length === 1) disc(g, line[0], 3, theme.accent);
}
