// What the picture has to show at a step: faces, lines and names. Both renderers draw it.

const FACES = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];
const EDGES = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];

/** Places of vertices by number: as in these tets, the later ones first. */
function placesIn(...sets) {
  const places = new Map();
  for (const set of sets) {
    for (const tet of set) {
      for (const corner of tets[tet].corners) {
        const {vertex, place} = points[corner];
        if (!places.has(vertex)) places.set(vertex, place);
      }
    }
  }
  return places;
}

/** The tets in full and those around them. */
function tetsShown(step, when) {
  const call = callOf(step);
  const visited = tetVisited(step);
  if (visited) {
    const shared = (tet) => tets[tet].corners.filter((corner) => visited.includes(points[corner].vertex)).length;
    const isThere = [...present.tets].some((tet) => shared(tet) === 4);
    if (isThere) return {full: [...present.tets].filter((tet) => shared(tet) >= 3), around: [...present.tets].filter((tet) => shared(tet) < 3)};
  }
  if (!call || !call.before) return {full: [...present.tets], around: []};
  if (when === "before") return {full: call.before, around: []};
  if (when === "after") return {full: call.after, around: []};
  const own = tetsOf(call);
  const full = [...present.tets].filter((tet) => own.has(tet));
  return {full, around: [...present.tets].filter((tet) => !own.has(tet))};
}

/** The edges that calls around this one are to remove, innermost first. */
function ancestorsOf(step) {
  const stack = stackOf(step);
  const call = stack.pop();
  if (!call || call.level === 0) return [];
  let level = call.level;
  const edges = [];
  for (const caller of stack.reverse()) {
    if (caller.name !== "recursion" || caller.level >= level) continue;
    edges.push(caller.target);
    level = caller.level;
  }
  return edges;
}

/** The tets around the edge of the caller, as they are now: the shell that the call is to make smaller. */
function shellOfCaller(call) {
  if (!call?.caller) return [];
  const hasVertex = (tet, vertex) => tets[tet].corners.some((corner) => points[corner].vertex === vertex);
  return [...present.tets].filter((tet) => call.caller.every((vertex) => hasVertex(tet, vertex)));
}

/** Lines of the polygon of the call: the ring, and what the covering makes of it once it is there. */
function ringLines(call, position, line, kinds) {
  const {name, shell} = stageOfRing(call, position);
  const m = shell.ring.length;
  shell.ring.forEach((vertex, i) => line(vertex, shell.ring[(i + 1) % m], "skirt", 2.5));
  if (name !== "made" && name !== "found") return;
  const isPlanned = name === "found";
  if (isPlanned) kinds.add("planned");
  for (const [i, k, j] of shell.covering.triangles) {
    for (const [from, to] of [[i, k], [k, j], [j, i]]) line(shell.ring[from], shell.ring[to], "chord", 3, isPlanned);
  }
  if (shell.covering.triangles.length > 0) {
    for (const [from, to] of shell.covering.core) line(shell.ring[from], shell.ring[to], "core", 5, isPlanned);
  }
}

function makeScene(step, cell, when, apart, showAround) {
  const scene = {faces: [], lines: [], names: [], shown: 0, kinds: new Set(), places: [], shellOfCaller: [], visited: null};
  const call = callOf(step);
  const {full, around} = tetsShown(step, when);
  const places = placesIn(full, call?.before ?? [], present.tets);
  scene.shown = full.length;
  for (const tet of full) {
    const {corners, quality} = tets[tet];
    const at = corners.map((corner) => points[corner].place);
    scene.places.push(...at);
    const centre = scale(at.reduce(add), 1 / 4);
    const shrunk = at.map((p) => mix(p, centre, apart));
    const colour = colourOfQuality(quality);
    for (const face of FACES) scene.faces.push({corners: face.map((i) => shrunk[i]), colour, opacity: full.length > 60 ? 0.85 : 0.5});
    for (const [i, j] of EDGES) scene.lines.push({from: shrunk[i], to: shrunk[j], colour: colourOf("wire"), width: 1.1, opacity: 0.55});
    if (quality < 1) scene.kinds.add("bad");
  }
  if (showAround && around.length > 0) {
    const seen = new Set();
    for (const tet of around) {
      const {corners} = tets[tet];
      for (const [i, j] of EDGES) {
        const key = [corners[i], corners[j]].sort().join();
        if (seen.has(key) || seen.size > 4000) continue;
        seen.add(key);
        scene.lines.push({from: points[corners[i]].place, to: points[corners[j]].place, colour: colourOf("ghost"), width: 1, opacity: 0.45});
      }
    }
    scene.kinds.add("ghost");
  }
  const line = (a, b, kind, width, dashed = false) => {
    if (!places.has(a) || !places.has(b)) return;
    scene.lines.push({from: places.get(a), to: places.get(b), colour: colourOf(kind), width, opacity: 1, dashed, top: true});
    scene.kinds.add(kind);
  };
  const named = new Map();
  if (call) {
    const [a, b] = call.shell ? [call.shell.a, call.shell.b] : call.target;
    if (call.shell) ringLines(call, when === "before" ? call.begin : step.position, line, scene.kinds);
    if (when === "now") markCaller(scene, call, places);
    for (const [from, to] of ancestorsOf(step)) line(from, to, "ancestor", 4, true);
    if (cell && call.shell) markCell(scene, call.shell, cell, places);
    const edgeIsThere = full.some((tet) => [a, b].every((v) => tets[tet].corners.some((corner) => points[corner].vertex === v)));
    if (call.target.length === 2 || call.shell) line(a, b, "edge", 4.5, !edgeIsThere);
    const isThere = full.some((tet) => call.target.every((v) => tets[tet].corners.some((corner) => points[corner].vertex === v)));
    if (!call.shell) markTarget(call.target, line, !isThere);
    const isVertex = call.target.length === 1;
    call.target.forEach((vertex) => named.set(vertex, {text: isVertex ? `${vertex} = v` : `${vertex}`, end: call.target.length < 3}));
    if (call.shell) {
      named.set(a, {text: `${a} = a`, end: true});
      named.set(b, {text: `${b} = b`, end: true});
      const {ring} = stageOfRing(call, when === "before" ? call.begin : step.position).shell;
      ring.forEach((vertex, i) => named.set(vertex, {text: `${vertex}`, ...named.get(vertex), corner: i + 1}));
    }
  }
  const visited = tetVisited(step);
  if (visited) scene.visited = full.find((tet) => tets[tet].corners.every((corner) => visited.includes(points[corner].vertex))) ?? null;
  if (scene.visited !== null) {
    outlineTet(visited, "visited", line);
    visited.forEach((vertex) => named.set(vertex, {text: `${vertex}`}));
  }
  const nameAll = full.length <= 60 ? [...full, ...scene.shellOfCaller] : scene.shellOfCaller;
  for (const tet of nameAll) {
    for (const corner of tets[tet].corners) {
      const {vertex} = points[corner];
      if (!named.has(vertex)) named.set(vertex, {text: `${vertex}`, quiet: Boolean(call?.shell)});
    }
  }
  for (const [vertex, name] of named) {
    if (places.has(vertex)) scene.names.push({...name, vertex, place: places.get(vertex)});
  }
  return scene;
}

/** Yellow on a light ground is seen by its dark rim, which no other line has. */
function outlineTet(corners, kind, line, isGone = false) {
  for (const [shade, width] of [["wire", 6.5], [kind, 3.5]]) corners.forEach((v, i) => corners.slice(i + 1).forEach((w) => line(v, w, shade, width, isGone)));
}

/** A vertex, face or tet that a call is for, as windows have it, dashed once it is gone; an edge comes with its shell. */
function markTarget(target, line, isGone) {
  if (target.length === 1) line(target[0], target[0], "vertex", 12);
  if (target.length === 3) target.forEach((v, i) => line(v, target[(i + 1) % 3], "target", 4, isGone));
  if (target.length === 4) outlineTet(target, "tet", line, isGone);
}

/** The shell of the caller as a ghost, and the face f of it that the call is to remove. */
function markCaller(scene, call, places) {
  scene.shellOfCaller = shellOfCaller(call);
  if (scene.shellOfCaller.length === 0) return;
  scene.kinds.add("caller");
  scene.caller = call.caller;
  for (const tet of scene.shellOfCaller) {
    const at = tets[tet].corners.map((corner) => points[corner].place);
    for (const face of FACES) scene.faces.push({corners: face.map((i) => at[i]), colour: colourOf("caller"), opacity: 0.1, flat: true});
    for (const [i, j] of EDGES) scene.lines.push({from: at[i], to: at[j], colour: colourOf("caller"), width: 1.5, opacity: 0.8});
  }
  const isThere = (vertex) => scene.shellOfCaller.some((tet) => tets[tet].corners.some((corner) => points[corner].vertex === vertex));
  if (!call.face || !isThere(call.face[2])) return;
  const corners = call.face.map((v) => places.get(v));
  // Hatched: a veil would change its colour over red tets.
  const line = (from, to, width) => scene.lines.push({from, to, colour: colourOf("face"), width, opacity: 1, top: true});
  corners.forEach((from, i) => line(from, corners[(i + 1) % 3], 2.5));
  const stripes = 9;
  for (let n = 1; n < stripes; ++n) line(mix(corners[0], corners[1], n / stripes), mix(corners[0], corners[2], n / stripes), 1.4);
  scene.kinds.add("face");
  scene.faceToRemove = call.face;
}

/** The pocket of a cell, and the triangle that its M_k chooses with the tets on both sides of it. */
function markCell(scene, shell, cell, places) {
  const k = tableApex(shell, cell.i, cell.j);
  const at = (i) => places.get(shell.ring[i]);
  const line = (from, to, width) => {
    if (from && to) scene.lines.push({from, to, colour: colourOf("cell"), width, opacity: 1, top: true});
  };
  scene.kinds.add("cell");
  line(at(cell.i), at(cell.j), 4.5);
  if (k >= shell.ring.length) return;
  for (const apex of [shell.a, shell.b]) {
    const corners = [at(cell.i), at(k), at(cell.j), places.get(apex)];
    if (corners.some((p) => !p)) return;
    for (const face of FACES) scene.faces.push({corners: face.map((i) => corners[i]), colour: colourOf("cell"), opacity: 0.22, flat: true});
    for (const [i, j] of EDGES) line(corners[i], corners[j], 2);
  }
}
