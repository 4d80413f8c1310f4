// What the reader does, and what is drawn then.

function drawLegend() {
  const svg = (inner) => `<svg viewBox="0 0 26 14" aria-hidden="true">${inner}</svg>`;
  const items = [
    [svg('<circle cx="13" cy="7" r="4.6" fill="none" stroke="#1f2933" stroke-width="3.4"/><circle cx="13" cy="7" r="4.6" fill="none" stroke="#fff" stroke-width="1.8"/>'), state.layer === "random" ? "random layout" : "post"],
    [svg('<circle cx="13" cy="7" r="4" fill="#145da0" stroke="#fff"/>'), "vehicle"],
    [svg('<path d="M1 7h24" stroke="#145da0" stroke-width="2"/>'), "travelled"],
    [svg('<path d="M1 7h24" stroke="#4a8fd0" stroke-width="1.6" stroke-dasharray="5 4"/>'), "ahead"],
  ];
  if (now().routes.some((route) => route.failure)) {
    items.push([svg('<path d="M8 2l10 10M8 12L18 2" stroke="#c2183c" stroke-width="2.6"/>'), "unreachable post"]);
  }
  if (state.layer === "loss" || run.fixed_sensors.length) {
    items.push([svg('<path d="M13 1l6 6-6 6-6-6z" fill="#fff" stroke="#1f2933" stroke-width="1.4"/>'), state.layer === "loss" ? "source" : "fixed sensor"]);
  }
  if (state.show.current) items.push([svg('<path d="M2 7h16" stroke="currentColor" stroke-width="1.4"/><path d="M24 7l-7-3v6z" fill="currentColor"/>'), `current, longest ${number(fastest, 2)} m/s`]);
  byId("legend").replaceChildren(...items.map(([picture, text]) => {
    const item = element("li");
    item.innerHTML = picture;
    item.append(text);
    return item;
  }));
}

function drawTime() {
  byId("time").value = state.fraction;
  byId("time-name").textContent = `${number(state.fraction * now().duration_h, 1)} h of ${hours(now().duration_h)}`;
}

function drawEpochName() {
  const epoch = now();
  byId("epoch").value = state.epoch;
  byId("epoch").setAttribute("aria-valuetext", `epoch ${epoch.index}, ${epoch.time}`);
  byId("epoch-name").textContent = `Epoch ${epoch.index} · ${epoch.time}`;
  byId("previous").disabled = state.epoch === 0;
  byId("next").disabled = state.epoch === run.epochs.length - 1;
}

function drawVehicleChoice() {
  const all = element("option", "all vehicles");
  all.value = "";
  byId("vehicle").replaceChildren(all, ...now().routes.map((route) => {
    const option = element("option", `vehicle ${route.vehicle}, ${fate(route)}`);
    option.value = String(route.vehicle);
    return option;
  }));
  byId("vehicle").value = state.vehicle === null ? "" : String(state.vehicle);
}

function drawLevels() {
  byId("level-field").hidden = state.layer !== "sound";
  const { depth_m } = now().sound;
  state.level = Math.min(state.level, Math.max(0, depth_m.length - 1));
  byId("level").replaceChildren(...depth_m.map((depth, k) => {
    const option = element("option", `${number(depth, 0)} m`);
    option.value = String(k);
    return option;
  }));
  byId("level").value = String(state.level);
}

function drawAll() {
  readTheme();
  scaleSound();
  drawEpochName();
  drawTiles();
  drawLevels();
  drawMap();
  drawLegend();
  drawTime();
  drawCell();
  drawVehicleChoice();
  drawRoute();
  drawSection();
  drawUtility();
  drawHistory();
  drawNumbers();
  drawVehicleTable(chooseVehicle);
}

function chooseEpoch(index) {
  const epoch = Math.min(run.epochs.length - 1, Math.max(0, index));
  if (epoch === state.epoch) return;
  state.epoch = epoch;
  drawAll();
}
function chooseVehicle(vehicle) {
  state.vehicle = vehicle;
  byId("vehicle").value = vehicle === null ? "" : String(vehicle);
  drawMap();
  drawRoute();
  drawVehicleTable(chooseVehicle);
}
function pointAt(cell) {
  if (cell === state.cell) return;
  state.cell = cell;
  drawMap();
  drawCell();
}
function keep(cell) {
  state.kept = cell;
  drawMap();
  drawCell();
  drawSection();
}

let playing = null;
function play() {
  if (playing !== null) return stop();
  if (state.fraction >= 1) state.fraction = 0;
  byId("play").textContent = "❚❚";
  byId("play").setAttribute("aria-label", "Pause");
  let before = null;
  const step = (time) => {
    if (before !== null) state.fraction = Math.min(1, state.fraction + (time - before) / 6000);
    before = time;
    drawMap();
    drawTime();
    if (state.fraction < 1) playing = requestAnimationFrame(step); else stop();
  };
  playing = requestAnimationFrame(step);
}
function stop() {
  cancelAnimationFrame(playing);
  playing = null;
  byId("play").textContent = "▶";
  byId("play").setAttribute("aria-label", "Play the epoch");
}

function describeRun() {
  const [west, east, south, north] = run.region_deg;
  const fleet = run.epochs[0].routes.length;
  byId("ocean").textContent = `Ocean: ${run.ocean_source}`;
  byId("facts").textContent = [
    `${number(west, 2)}–${number(east, 2)}° E, ${number(south, 2)}–${number(north, 2)}° N`,
    `${grid.columns} × ${grid.rows} cells`,
    `${fleet} vehicles at ${number(run.fleet_depth_m, 0)} m, ${run.vehicle_speed_m_s} m/s`,
    `${run.epochs.length} ${run.epochs.length === 1 ? "epoch" : "epochs"} from ${run.epochs[0].time}`,
    `sonarfleet ${run.version}`,
    `seed ${run.seed}`,
  ].join(" · ");
}

function listen() {
  byId("epoch").max = String(run.epochs.length - 1);
  byId("epoch-ticks").replaceChildren(...run.epochs.map((e) => element("span", String(e.index))));
  byId("epoch").addEventListener("input", (event) => chooseEpoch(Number(event.target.value)));
  byId("previous").addEventListener("click", () => chooseEpoch(state.epoch - 1));
  byId("next").addEventListener("click", () => chooseEpoch(state.epoch + 1));
  document.addEventListener("keydown", (event) => {
    if (event.altKey || event.ctrlKey || event.metaKey || event.target.closest("input, select, canvas, summary")) return;
    if (event.key === "ArrowLeft") chooseEpoch(state.epoch - 1);
    else if (event.key === "ArrowRight") chooseEpoch(state.epoch + 1);
    else return;
    event.preventDefault();
  });

  byId("layer").replaceChildren(...Object.entries(layers).map(([key, layer]) => {
    const option = element("option", layer.name);
    option.value = key;
    return option;
  }));
  byId("layer").value = state.layer;
  byId("layer").addEventListener("change", (event) => {
    state.layer = event.target.value;
    drawLevels();
    drawMap();
    drawLegend();
  });
  byId("level").addEventListener("change", (event) => {
    state.level = Number(event.target.value);
    scaleSound();
    drawMap();
  });
  for (const name of Object.keys(state.show)) {
    byId(`show-${name}`).addEventListener("change", (event) => {
      state.show[name] = event.target.checked;
      drawMap();
      drawLegend();
    });
  }
  byId("time").addEventListener("input", (event) => {
    stop();
    state.fraction = Number(event.target.value);
    drawMap();
    drawTime();
  });
  byId("play").addEventListener("click", play);
  byId("vehicle").addEventListener("change", (event) => chooseVehicle(event.target.value === "" ? null : Number(event.target.value)));

  const map = byId("map");
  map.addEventListener("pointermove", (event) => pointAt(cellAt(event.offsetX, event.offsetY)));
  map.addEventListener("pointerleave", () => pointAt(null));
  map.addEventListener("click", (event) => {
    const vehicle = state.show.routes ? vehicleAt(event.offsetX, event.offsetY) : null;
    if (vehicle !== null) return chooseVehicle(vehicle);
    const cell = cellAt(event.offsetX, event.offsetY);
    if (cell !== null) keep(cell);
  });
  map.addEventListener("keydown", (event) => {
    const move = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    if (!move) return;
    event.preventDefault();
    const from = sectionCell();
    const column = Math.min(grid.columns - 1, Math.max(0, (from % grid.columns) + move[0]));
    const row = Math.min(grid.rows - 1, Math.max(0, Math.floor(from / grid.columns) + move[1]));
    keep(row * grid.columns + column);
  });
  const section = byId("section");
  const tell = (event) => (byId("section-value").textContent = sectionValue(event.offsetX, event.offsetY));
  section.addEventListener("pointermove", tell);
  section.addEventListener("pointerleave", () => (byId("section-value").textContent = sectionValue(-1, -1)));

  let width = window.innerWidth;
  window.addEventListener("resize", () => {
    if (window.innerWidth !== width) {
      width = window.innerWidth;
      drawAll();
    }
  });
  window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", drawAll);
  const printing = (on) => {
    document.documentElement.classList.toggle("printing", on);
    drawAll();
  };
  window.addEventListener("beforeprint", () => printing(true));
  window.addEventListener("afterprint", () => printing(false));
}

if (run.epochs.length === 0) {
  byId("ocean").textContent = "This run has no epochs yet.";
  document.querySelector("main").hidden = true;
  document.querySelector(".epochs").hidden = true;
} else {
  state.level = run.epochs[0].sound.depth_m.length ? nearest(run.epochs[0].sound.depth_m, run.fleet_depth_m) : 0;
  describeRun();
  listen();
  drawAll();
  byId("section-value").textContent = sectionValue(-1, -1);
}
