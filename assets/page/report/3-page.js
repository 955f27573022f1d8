// The page: picture, tips, scales, buttons.

const stage = byId("stage");
const canvas = byId("canvas");
const camera = new Camera();
const look = {view: "after", isSolid: false, byLabel: false, across: "view", normal: [0, 0, 1], cutAway: 0, cut: [0, 0, 1, 1e9], target: null};
let shape = null;
let painter = null;

// --- the picture ---

const isPrinting = () => matchMedia("print").matches;
const viewsIn = (width) => (width >= 640 ? ["before", "after"] : [look.view]);

/** Where the plane is: its normal, and how far along it what is nearer to the eye begins. */
function planeOfCut() {
  const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((n) => [0, 1, 2].map((axis) => (n >> axis & 1 ? shape.high : shape.low)[axis]));
  const along = corners.map((corner) => dot(corner, look.normal));
  const [low, high] = [Math.min(...along), Math.max(...along)];
  return [...look.normal, look.cutAway > 0 ? high - look.cutAway * (high - low) : 1e9];
}

function drawPicture(size = {width: stage.clientWidth, height: stage.clientHeight}, ratio = Math.min(window.devicePixelRatio, 3)) {
  if (!shape || size.width === 0 || size.height === 0) return;
  look.cut = planeOfCut();
  const views = viewsIn(size.width);
  if (painter && !painter.gl.isContextLost()) painter.draw(views, look, camera, size, ratio);
  else drawFlatShape(byId("flat"), shape, views, look, camera, size);
  for (const when of ["before", "after"]) {
    const n = views.indexOf(when);
    const part = {width: size.width / views.length, height: size.height};
    byId(`name-${when}`).hidden = n < 0;
    byId(`name-${when}`).style.left = `${100 * Math.max(n, 0) / views.length}%`;
    byId(`target-${when}`).hidden = n < 0 || !look.target;
    if (n < 0 || !look.target) continue;
    const [x, y] = camera.project(look.target, part);
    byId(`target-${when}`).style.left = `${x + n * part.width}px`;
    byId(`target-${when}`).style.top = `${y}px`;
  }
  byId("choose-view").hidden = views.length > 1;
}

let frame = 0;
function redrawPicture() {
  if (frame) return;
  frame = requestAnimationFrame(() => { frame = 0; drawPicture(); });
}

function showWhole() {
  look.target = null;
  Object.assign(camera, shape.ball, {zoom: 1});
  camera.look([0.5, -0.8, 0.35], [0, 0, 1]);
  redrawPicture();
}

/** One of the worst tets from nearby. */
function showTet(n) {
  const [x, y, z, radius] = about.worst[n].map((value) => value / GRID);
  look.target = [x, y, z];
  look.view = "after";
  setCut(0);
  Object.assign(camera, {centre: look.target, radius: Math.max(6 * radius, 2e-4), zoom: 1});
  stage.scrollIntoView({block: "center"});
  press();
  redrawPicture();
}

const AXES = {x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1]};
function cutAcross(across) {
  look.across = across;
  look.normal = AXES[across] ?? camera.towards;
  if (look.cutAway === 0) setCut(0.5);
  press();
  redrawPicture();
}

function setCut(share) {
  if (look.cutAway === 0 && look.across === "view") look.normal = camera.towards;
  look.cutAway = Math.min(Math.max(share, 0), 1);
  byId("cut").value = Math.round(1000 * look.cutAway);
}

function setSurface(name) {
  look.isSolid = name === "solid";
  press();
  redrawPicture();
}

function setColour(name) {
  look.byLabel = name === "label" && shape !== null && shape.regions.length > 0;
  byId("labels").hidden = !look.byLabel;
  press();
  redrawPicture();
}

/** A choice only where there is more than one label. */
function listLabels() {
  byId("choose-colour").hidden = shape.regions.length === 0;
  const most = 12;
  const items = shape.regions.slice(0, most).map(({label, colour}) => {
    const svg = svgElement("svg", {viewBox: "0 0 22 9", "aria-hidden": "true"});
    svg.append(svgElement("rect", {width: 22, height: 9, fill: inCss(colour)}));
    return make("li", {}, svg, `region ${label}`);
  });
  if (shape.regions.length > most) items.push(make("li", {}, `and ${shape.regions.length - most} more; colours repeat`));
  byId("labels").replaceChildren(...items);
}

function setView(when) {
  look.view = when;
  press();
  redrawPicture();
}

function setScale(scale) {
  document.documentElement.dataset.scale = scale;
  press();
}

/** Shows which of each choice is chosen. */
function press() {
  const chosen = {view: look.view, surface: look.isSolid ? "solid" : "clear", colour: look.byLabel ? "label" : "plain", across: look.across, scale: document.documentElement.dataset.scale};
  for (const [name, value] of Object.entries(chosen)) {
    for (const button of document.querySelectorAll(`button[data-${name}]`)) button.setAttribute("aria-pressed", String(button.dataset[name] === value));
  }
}

// --- tips ---

function watchTips() {
  const tip = byId("tip");
  // A title of the browser would come late, and beside this one.
  for (const title of document.querySelectorAll(".bin > title")) {
    title.parentElement.dataset.tip = title.textContent;
    title.remove();
  }
  const show = (event) => {
    const text = event.target.closest?.(".bin")?.dataset.tip;
    for (const other of document.querySelectorAll(".bin.here")) if (other !== event.target) other.classList.remove("here");
    tip.hidden = !text;
    if (!text) return;
    event.target.classList.add("here");
    tip.textContent = text;
    tip.style.left = `${Math.max(4, Math.min(event.clientX + 14, innerWidth - tip.offsetWidth - 8))}px`;
    tip.style.top = `${Math.max(4, event.clientY - tip.offsetHeight - 12)}px`;
  };
  document.addEventListener("pointermove", show);
  document.addEventListener("pointerdown", show);
}

// --- keys and buttons ---

const KEYS = {
  t: () => toggleTheme(redrawPicture),
  l: () => setScale(document.documentElement.dataset.scale === "log" ? "even" : "log"),
  1: () => setView("before"),
  2: () => setView("after"),
  s: () => setSurface(look.isSolid ? "clear" : "solid"),
  r: () => setColour(look.byLabel ? "plain" : "label"),
  c: () => cutAcross("view"),
  h: () => { setCut(0); showWhole(); },
};

function watchKeys() {
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    if (event.target === canvas && turnByKey(event, camera)) return redrawPicture();
    if (KEYS[event.key] && !event.target.matches("input")) KEYS[event.key]();
  });
  const all = {view: setView, surface: setSurface, colour: setColour, across: cutAcross, scale: setScale};
  for (const [name, act] of Object.entries(all)) {
    for (const button of document.querySelectorAll(`button[data-${name}]`)) button.addEventListener("click", () => act(button.dataset[name]));
  }
  for (const button of document.querySelectorAll("button.show")) button.addEventListener("click", () => showTet(Number(button.dataset.tet)));
  byId("theme").addEventListener("click", KEYS.t);
  byId("whole").addEventListener("click", KEYS.h);
  byId("cut").addEventListener("input", () => { setCut(byId("cut").value / 1000); redrawPicture(); });
  byId("copy").addEventListener("click", () => {
    const text = byId("command").textContent;
    const select = () => getSelection().selectAllChildren(byId("command"));
    if (navigator.clipboard) navigator.clipboard.writeText(text).then(() => say("copied"), select); else select();
  });
}

function drawForPrint() {
  for (const part of document.querySelectorAll("details")) part.open = true;
  drawPicture({width: 1400, height: 640}, 1);
}

async function begin() {
  setTheme(wantedTheme());
  watchTips();
  watchKeys();
  press();
  for (const when of ["before", "after"]) {
    const count = about[`all_bad_${when}`];
    byId(`name-${when}`).textContent = `${when}: ${count.toLocaleString("en")} bad tet${count === 1 ? "" : "s"}`;
  }
  shape = await readShape();
  painter = ShapePainter.on(canvas, shape);
  listLabels();
  canvas.hidden = !painter;
  byId("flat").toggleAttribute("hidden", Boolean(painter));
  watchHands(stage, camera, redrawPicture, {farthest: 400, takeOver: (event, by) => {
    if (event.shiftKey) setCut(look.cutAway + by[1] / Math.max(stage.clientHeight, 200));
    return event.shiftKey;
  }});
  canvas.addEventListener("webglcontextlost", (event) => {
    event.preventDefault();
    canvas.hidden = true;
    byId("flat").removeAttribute("hidden");
    redrawPicture();
  });
  watchLooks(() => { if (!isPrinting()) drawPicture(); }, drawForPrint);
  new ResizeObserver(() => { if (!isPrinting()) redrawPicture(); }).observe(stage);
  showWhole();
  drawPicture();
  document.body.dataset.ready = "yes";
}

begin().catch((error) => {
  byId("left-out").textContent = `This browser cannot show the picture: ${error.message}`;
  document.body.dataset.ready = "no";
});
