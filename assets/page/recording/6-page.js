// The page: where it is, and what leads on from there.

const place = {step: 0, cell: 0, lesson: 0};
const view = {when: "now", apart: 0.1, around: true};
const camera = new Camera();
const canvas = byId("canvas");
const flat = byId("flat");
const painter = WebGlPainter.on(canvas);
const stage = byId("stage");
let scene = makeScene(steps[0], null, "now", 0, true);

if (!painter) {
  canvas.hidden = true;
  flat.removeAttribute("hidden");
}

// --- the picture ---

function drawPicture() {
  const size = {width: stage.clientWidth, height: stage.clientHeight};
  if (size.width === 0 || size.height === 0) return;
  if (painter && !painter.gl.isContextLost()) painter.draw(scene, camera, size, Math.min(window.devicePixelRatio, 3));
  else drawFlat(flat, scene, camera, size);
  const em = parseFloat(getComputedStyle(document.documentElement).fontSize);
  const names = placeNames(scene, camera, size, em).sort((x, y) => x.depth - y.depth);
  const leaders = names.filter((name) => name.isLed).map(({from, at}) => {
    const leader = make("i", {class: "leader"});
    const by = [at[0] - from[0], at[1] - from[1]];
    Object.assign(leader.style, {left: `${from[0]}px`, top: `${from[1]}px`, width: `${Math.hypot(...by)}px`, transform: `rotate(${Math.atan2(by[1], by[0])}rad)`});
    return leader;
  });
  byId("names").replaceChildren(...leaders, ...names.map((name) => {
    const span = make("span", {"data-vertex": name.vertex, class: `${name.end ? "end" : ""} ${name.quiet || name.hidden ? "quiet" : ""}`}, name.text);
    if (name.corner) span.append(" = ", make("i", {}, "p"), make("sub", {}, `${name.corner}`));
    span.hidden = name.hidden;
    span.style.left = `${name.at[0]}px`;
    span.style.top = `${name.at[1]}px`;
    return span;
  }));
}

let frame = 0;
function redrawPicture() {
  if (frame) return;
  frame = requestAnimationFrame(() => { frame = 0; drawPicture(); });
}

/** For paper, and for a browser without WebGL. */
function drawForPrint() {
  const size = {width: 640, height: 440};
  const {centre, radius} = camera;
  Object.assign(camera, frameOf(inView.places, size));
  drawFlat(flat, scene, camera, size);
  Object.assign(camera, {centre, radius});
}

/** The axis of the picture: the edge of the call. */
function axisOf(call) {
  const ends = call?.shell ? [call.shell.a, call.shell.b] : call?.target ?? [];
  if (ends.length !== 2) return null;
  const places = placesIn(call.before ?? [], present.tets);
  const [a, b] = ends.map((vertex) => places.get(vertex));
  return a && b ? unit(subtract(b, a)) : null;
}

/** From the side and a little from above; the corner of the ring that is farthest out comes to the front. */
function lookFromSide(call) {
  const axis = axisOf(call);
  if (!axis) return camera.look([0.5, -0.8, 0.35], [0, 0, 1]);
  const across = unit(cross(axis, Math.abs(axis[2]) < 0.8 ? [0, 0, 1] : [0.35, 0.94, 0]));
  camera.look(add(scale(across, 0.9), scale(axis, 0.42)), axis);
}

function lookAlong(call) {
  const axis = axisOf(call);
  if (axis) camera.look(scale(axis, -1), camera.up);
}

/** Middle and size of the picture in which these places are as large as they go, as the camera looks now; turned, they stay in sight. */
function frameOf(places, size) {
  const ball = ballAround(places.length > 0 ? places : [[0, 0, 0]]);
  const least = 0.5 * ball.radius;  // nearer, the eye would be among the tets
  const fill = 0.41;  // of the picture, to both sides; names need the rest
  const room = [size.width, size.height].map((x) => fill / 0.42 * x / Math.min(size.width, size.height));
  const axes = [camera.right, camera.up];
  let {centre, radius} = ball;
  for (let round = 0; round < 6; ++round) {  // what is nearer is larger, the more so the smaller the radius
    const seen = places.map((place) => {
      const q = subtract(place, centre);
      const nearer = 4.2 * radius / Math.max(4.2 * radius - dot(q, camera.towards), 0.5 * radius);
      return axes.map((axis) => nearer * dot(q, axis));
    });
    if (seen.length === 0) break;
    const ends = axes.map((_, n) => [Math.min(...seen.map((at) => at[n])), Math.max(...seen.map((at) => at[n]))]);
    axes.forEach((axis, n) => { centre = add(centre, scale(axis, (ends[n][0] + ends[n][1]) / 2)); });
    radius = Math.max(least, ...ends.map(([low, high], n) => (high - low) / 2 / room[n]));
  }
  return {centre, radius};
}

let flight = 0;
function goToPlaces(places, isSudden) {
  cancelAnimationFrame(flight);
  const {centre, radius} = frameOf(places, {width: Math.max(stage.clientWidth, 1), height: Math.max(stage.clientHeight, 1)});
  const from = {centre: camera.centre, radius: camera.radius};
  const isStill = isSudden || matchMedia("(prefers-reduced-motion: reduce)").matches || document.hidden;
  const begin = performance.now();
  const fly = (now) => {
    const t = isStill ? 1 : Math.min((now - begin) / 320, 1);
    const s = t * t * (3 - 2 * t);
    camera.centre = mix(from.centre, centre, s);
    camera.radius = from.radius + (radius - from.radius) * s;
    drawPicture();
    if (t < 1) flight = requestAnimationFrame(fly);
  };
  fly(begin);
}

// --- steps ---

let inView = {aim: undefined, places: []};

// What does not fit into its card is reached by keys, too.
function letKeysScroll() {
  for (const region of document.querySelectorAll(".card, .scrolls")) {
    const canScroll = getComputedStyle(region).overflowY === "auto" && overflows(region);
    if (canScroll && !region.querySelector("a, button")) region.tabIndex = 0;
    else region.removeAttribute("tabindex");
  }
}

function show(isSudden = false) {
  const step = steps[place.step];
  present.goTo(place.step);
  const call = callOf(step);
  const filling = shellBeingFilled(step);
  const total = call?.shell?.tables ? cellsOf(call.shell).length : 0;
  place.cell = filling ? Math.min(place.cell, total) : 0;
  const cell = filling && place.cell > 0 ? cellsOf(filling)[place.cell - 1] : null;
  scene = makeScene(step, cell, view.when, view.apart, view.around);
  showTold(step, enter);
  showCode(step);
  const ringKinds = showRing(call, step.position, cell);
  showTables(call, filling ? place.cell : total, Boolean(filling));
  showChords(call, step.position);
  const main = document.querySelector("main");
  main.classList.toggle("no-shell", !call?.shell);
  main.classList.toggle("no-tables", Boolean(call?.shell) && byId("tables-card").hidden);
  showTree(step, enter, show);
  showLegend(scene, ringKinds);
  showLesson(step, call, () => showRing(call, step.position, cell));
  showPlace(step, filling ? total : 0);
  letKeysScroll();
  for (const button of document.querySelectorAll("[data-when]")) button.setAttribute("aria-pressed", String(button.dataset.when === view.when));
  byId("along").disabled = axisOf(call) === null;
  const after = document.querySelector("[data-when=after]");
  after.textContent = call?.undone ? "Tried" : "After";
  const isAsked = isOnStage() && questionAt(place.lesson) && !answers.has(place.lesson);  // it would be the answer
  after.disabled = !call?.after?.length || Boolean(isAsked);
  document.querySelector("[data-when=before]").disabled = !call?.before?.length;
  const words = call ? `${call.name} ${call.place}: ${scene.shown} tets` : `${scene.shown} tets`;
  canvas.setAttribute("aria-label", words);
  flat.setAttribute("aria-label", words);
  // The camera follows the call, or the tet that the pass turns to, and stays while that does.
  const aim = `${step.call} ${scene.visited} ${stage.clientWidth} ${stage.clientHeight}`;
  if (inView.aim !== aim) {
    const isFirst = inView.aim === undefined;
    if (isFirst) lookFromSide(call ?? calls.values().next().value);
    const places = [placesInView(call), scene.places, [...placesIn(present.tets).values()]].find((some) => some.length > 0);
    inView = {aim, places: places ?? []};
    goToPlaces(inView.places, isSudden || isFirst);
  } else {
    drawPicture();
  }
  Object.assign(document.body.dataset, {position: step.position, cell: place.cell, shown: scene.shown, call: step.call ?? ""});
}

/** Places that the camera is to have in the picture. A tet that the pass turns to comes with those beside it, unless they are much larger.
    A call comes with its caller where that is about as large: both shells are to be seen. */
function placesInView(call) {
  if (!call) {
    const {places, visited} = scene;
    if (visited === null) return places;
    const own = [...placesIn([visited]).values()];
    return ballAround(places).radius < 1.4 * ballAround(own).radius ? places : own;
  }
  const own = [...placesIn(tetsOf(call)).values()];
  const caller = call.parent === null ? null : calls.get(call.parent);
  if (own.length === 0 || !caller?.before) return own;
  const both = [...own, ...placesInView(caller)];
  return ballAround(both).radius < 2.2 * ballAround(own).radius ? both : own;
}

function showPlace(step, cells) {
  byId("slider").value = place.step;
  const first = steps[0].position;  // of a page of one call: far into the trace
  byId("count").textContent = `step ${step.position - first} of ${steps[steps.length - 1].position - first}${cells ? `, cell ${place.cell} of ${cells}` : ""}`;
  byId("count").title = `after ${step.position} events of the trace`;
  const isFirst = place.step === 0 && place.cell === 0;
  const isLast = place.step === steps.length - 1;
  for (const button of document.querySelectorAll(".events [data-step]")) button.disabled = button.dataset.step.startsWith("back") ? isFirst : isLast;
  const hash = isOnStage() ? `#lesson=${place.lesson + 1}` : `#step=${step.position}${place.cell ? `.${place.cell}` : ""}`;
  const hasAddress = location.protocol !== "about:";  // a page within a page may have none
  if (hasAddress && location.hash !== hash) history.replaceState(null, "", hash);
}

/** To any event: all panels are there then. */
function goTo(number, cell = 0) {
  setMode("explore");
  place.step = Math.min(Math.max(number, 0), steps.length - 1);
  place.cell = cell;
  view.when = "now";
  show();
}

function enter(call) { goTo(stepAfter(call.begin + 1)); }

/** As the debugger steps; into and over go through the tables as well, cell by cell and diagonal by diagonal. */
function move(way) {
  const step = steps[place.step];
  const filling = shellBeingFilled(step);
  const cells = filling ? cellsOf(filling) : [];
  const [over, out, backOver, backOut] = step.ways;
  switch (way) {
    case "into":
      if (place.cell < cells.length) return goTo(place.step, place.cell + 1);
      return goTo(place.step + 1);
    case "over": {
      if (place.cell === 0) return goTo(stepAfter(over));
      const next = cells.findIndex((cell, n) => n >= place.cell && cell.d > cells[place.cell - 1].d);
      return next < 0 ? goTo(place.step + 1) : goTo(place.step, next + 1);
    }
    case "out":
      return goTo(stepAfter(out));
    case "back-into":
      if (place.cell > 0) return goTo(place.step, place.cell - 1);
      return goTo(place.step - 1, placeOfLastCell(place.step - 1));
    case "back-over":
      return place.cell > 0 ? goTo(place.step, 0) : goTo(stepBefore(backOver));
    default:
      return goTo(stepBefore(backOut));
  }
}

/** Backwards, a table is full before it is emptied. */
function placeOfLastCell(number) {
  const filling = number >= 0 ? shellBeingFilled(steps[number]) : null;
  return filling ? cellsOf(filling).length : 0;
}

function goToCall(holds, by) {
  const {position} = steps[place.step];
  const ends = [...calls.values()].filter((call) => holds(call) && call.reason !== undefined).map((call) => call.end).sort((x, y) => x - y);
  const found = by > 0 ? ends.find((end) => end > position) : ends.filter((end) => end < position).pop();
  if (found !== undefined) goTo(stepBefore(found));
}

function isRefused(call) { return call.outcome !== "accepted" && call.outcome !== "undone"; }

function goToDeepest() {
  const all = [...calls.values()].filter((call) => call.reason !== undefined);
  if (all.length > 0) enter(all.reduce((x, y) => (y.depth > x.depth ? y : x)));
}

function goToHash() {
  const inLesson = /^#lesson=(\d+)$/.exec(location.hash);
  if (lesson && inLesson) {
    goToLesson(Number(inLesson[1]) - 1);
    return true;
  }
  const found = /^#step=(\d+)(?:\.(\d+))?$/.exec(location.hash);
  if (!found) return false;
  goTo(stepAfter(Number(found[1])), Number(found[2] ?? 0));
  return true;
}

let playing = 0;
function play() {
  if (playing) { clearInterval(playing); playing = 0; return say("stopped"); }
  say("plays; Space stops");
  playing = setInterval(() => {
    if (place.step === steps.length - 1) { clearInterval(playing); playing = 0; } else { move("into"); }
  }, 900);
}

// --- looks ---

function toggleSize() {
  const isLarge = document.documentElement.dataset.size !== "large";
  document.documentElement.dataset.size = isLarge ? "large" : "";
  byId("text-size").setAttribute("aria-pressed", String(isLarge));
  keepLook("size", isLarge ? "large" : "normal");
  show();
}

function chooseTheme() {
  toggleTheme(show);
  const {theme} = document.documentElement.dataset;
  keepLook("theme", theme === wantedTheme() ? "auto" : theme);
}

function copyLink() {
  const said = () => say("The link to this step is copied");
  const shown = () => say(location.hash);
  if (navigator.clipboard) navigator.clipboard.writeText(location.href).then(said, shown); else shown();
}

function showWhen(when) {
  if (document.querySelector(`[data-when=${when}]`).disabled) return;
  view.when = when;
  show();
}

// --- keys, mouse and touch ---

const KEYS = [
  [["ArrowRight"], "One step on, into a call and through the tables", () => move("into")],
  [["ArrowLeft"], "One step back", () => move("back-into")],
  [["ArrowDown"], "On, over a whole call or a diagonal of the tables", () => move("over")],
  [["ArrowUp"], "Back, over a whole call", () => move("back-over")],
  [["PageDown"], "To the end of the call", () => move("out")],
  [["PageUp"], "To before the call", () => move("back-out")],
  [["Home"], "To the first step", () => goTo(0)],
  [["End"], "To the last step", () => goTo(steps.length - 1)],
  [["e"], "All panels and every event, or the lesson again", toggleExplore],
  [["n", "L"], "Next step of the lesson", () => moveInLesson(1)],
  [["b", "K"], "Step of the lesson before", () => moveInLesson(-1)],
  [[" "], "Play, or stop playing", play],
  [["j"], "To the next call that was accepted for good", () => goToCall((call) => call.outcome === "accepted", 1)],
  [["J"], "To the call before that was accepted for good", () => goToCall((call) => call.outcome === "accepted", -1)],
  [["u"], "To the next refused call", () => goToCall(isRefused, 1)],
  [["U"], "To the refused call before", () => goToCall(isRefused, -1)],
  [["d"], "To the deepest call", goToDeepest],
  [["1"], "The tets now", () => showWhen("now")],
  [["2"], "The tets as the call found them", () => showWhen("before")],
  [["3"], "The tets as the call left or tried them", () => showWhen("after")],
  [["a"], "Look along the edge", () => { lookAlong(callOf(steps[place.step])); redrawPicture(); }],
  [["h"], "Look from the side", () => { camera.zoom = 1; lookFromSide(callOf(steps[place.step])); goToPlaces(inView.places, true); }],
  [["t"], "Light or dark", chooseTheme],
  [["g"], "Large text, for a projector", toggleSize],
  [["c"], "Copy a link to this step", copyLink],
  [["?"], "These keys", () => byId("keys").showModal()],
];
const KEY_NAMES = {ArrowRight: "Right", ArrowLeft: "Left", ArrowDown: "Down", ArrowUp: "Up", PageDown: "Page Down", PageUp: "Page Up", " ": "Space", L: "Shift+L", K: "Shift+K", J: "Shift+J", U: "Shift+U"};

document.addEventListener("keydown", (event) => {
  const isTyping = (event.target.matches("input[type=range]") && event.key.startsWith("Arrow")) || event.target.matches("input[type=text]");
  const isPressing = event.target.matches("button, input") && event.key === " ";
  if (isTyping || isPressing || event.ctrlKey || event.altKey || event.metaKey || byId("keys").open) return;
  if (event.target.matches(".card, .scrolls") && ["ArrowUp", "ArrowDown"].includes(event.key)) return;
  if (event.target === canvas && turnByKey(event, camera)) return redrawPicture();
  const found = KEYS.find(([keys]) => keys.includes(event.key));
  if (!found) return;
  event.preventDefault();
  found[2]();
});

watchHands(stage, camera, redrawPicture);
canvas.addEventListener("webglcontextlost", (event) => {
  event.preventDefault();
  canvas.hidden = true;
  flat.removeAttribute("hidden");
  redrawPicture();
});

// --- the beginning ---

function describeOrigin() {
  const {mesh, schedule, recorder, program, damage, filter, calls: count} = recording.origin;
  const parts = [];
  if (mesh) parts.push(`mesh ${mesh}`);
  if (schedule) parts.push(`schedule ${schedule}`);
  parts.push(`goal ${recording.goal}`, `${count} call${count === 1 ? "" : "s"}`);
  if (recorder) parts.push(`recorded by ${recorder}`);
  if (program && program !== recorder) parts.push(`page by ${program}`);
  if (filter) parts.push(`recorded without ${filter}`);
  if (damage) parts.push(damage);
  if (recording.deepest !== undefined) parts.push(`calls with more than ${recording.deepest} calls around them are one step each, to keep the page small`);
  byId("origin").textContent = parts.join(" \u00b7 ");
  // On a phone it would be three lines before the picture.
  const house = byId("origin").parentElement;
  const settle = () => (isNarrow.matches ? document.querySelector("main") : house).append(byId("origin"));
  isNarrow.addEventListener("change", settle);
  settle();
  const heading = document.querySelector("h1");
  heading.replaceChildren(...withIndices(heading.textContent));
}

function begin() {
  findLooks();
  setTheme(themeOf(wantedTheme()));
  byId("text-size").setAttribute("aria-pressed", String(kept.size === "large"));
  describeOrigin();
  byId("lesson").hidden = !lesson;
  isNarrow.addEventListener("change", settleBars);
  setMode(lesson ? "lesson" : "explore");
  if (lesson) place.step = stepAfter(lesson.steps[0].at);
  byId("slider").max = steps.length - 1;
  byId("slider").addEventListener("input", () => goTo(Number(byId("slider").value)));
  for (const button of document.querySelectorAll(".events [data-step]")) button.addEventListener("click", () => move(button.dataset.step));
  for (const button of document.querySelectorAll("[data-when]")) button.addEventListener("click", () => showWhen(button.dataset.when));
  byId("lesson-next").addEventListener("click", () => moveInLesson(1));
  byId("lesson-back").addEventListener("click", () => moveInLesson(-1));
  byId("explore").addEventListener("click", toggleExplore);
  byId("ask").addEventListener("submit", checkNumber);
  addEventListener("resize", fitStage);
  byId("apart").addEventListener("input", () => { view.apart = byId("apart").value / 100; show(); });
  byId("around").addEventListener("change", () => { view.around = byId("around").checked; show(); });
  const keyFor = (key) => KEYS.find(([keys]) => keys.includes(key))[2];
  byId("along").addEventListener("click", keyFor("a"));
  byId("home").addEventListener("click", keyFor("h"));
  byId("theme").addEventListener("click", chooseTheme);
  byId("text-size").addEventListener("click", toggleSize);
  byId("copy-link").addEventListener("click", copyLink);
  byId("show-keys").addEventListener("click", keyFor("?"));
  byId("key-list").replaceChildren(...KEYS.map(([keys, help]) => make("tr", {}, make("td", {}, ...keys.flatMap((key, n) => [n ? " " : "", make("kbd", {}, KEY_NAMES[key] ?? key)])), make("td", {}, help))),
    make("tr", {}, make("td", {}, "drag, pinch, wheel"), make("td", {}, "Turn and zoom the picture; Shift and arrows turn it when it has the focus")));
  watchLooks(show, drawForPrint);
  addEventListener("hashchange", goToHash);
  new ResizeObserver(() => goToPlaces(inView.places, true)).observe(stage);
  if (!goToHash()) show(true);
}

begin();
