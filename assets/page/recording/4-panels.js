// What stands beside the picture: ring, tables, chords, algorithm, calls.

const four = (quality) => quality.toFixed(4);
const three = (quality) => quality.toFixed(3);

// --- the ring ---

const TEXT_OF_RING = 0.078;  // of its numbers, in halves of the drawing, where there is room
let textOfRing = TEXT_OF_RING;

/** Places of the ring in the unit circle, the first on top, counterclockwise; SVG has y downwards. Large numbers take room from it. */
function ringPlace(shell, i, radius = 0.74 - 2 * Math.max(textOfRing - TEXT_OF_RING, 0) - Math.max(widthOfCorner(shell) - 0.25, 0)) {
  const angle = 2 * Math.PI * i / shell.ring.length;
  return [-radius * Math.sin(angle), -radius * Math.cos(angle)];
}

/** Of the longest number at a corner. */
function widthOfCorner(shell) {
  return 0.65 * 1.25 * textOfRing * Math.max(...shell.ring.map((vertex) => `${vertex}`.length));
}

/** What the ring of a call shows at a position of the trace, and of which shell. */
function stageOfRing(call, position) {
  let [, name, caption, number, covering] = call.shell.stages[0];
  for (const stage of call.shell.stages) if (stage[0] <= position) [, name, caption, number, covering] = stage;
  return {name, caption, shell: {...recording.shells[number], covering}};
}

const qualityFill = (quality) => inCss(colourOfQuality(quality));

/** In a small drawing numbers are larger, as long as there is room for all: on a phone they can be read. */
function chooseTextOfRing(svg, shell) {
  const m = shell.ring.length;
  if (m > 10) return 0.058;
  const readable = 11.5;  // pixels
  const largest = m > 7 ? 0.09 : 0.135;
  const half = Math.min(svg.clientWidth, svg.clientHeight) / 2;
  return half > 0 ? Math.min(Math.max(TEXT_OF_RING, readable / half), largest) : TEXT_OF_RING;
}

class RingDrawing {
  constructor(svg, shell) {
    this.svg = svg;
    this.shell = shell;
    this.parts = [];
    this.labels = [];
    this.kinds = new Set();  // of lines
    textOfRing = this.text = chooseTextOfRing(svg, shell);
  }

  at(i) { return ringPlace(this.shell, i); }

  stroke(from, to, kind, width, {dashed = false, opacity = 1, tip = ""} = {}) {
    this.kinds.add(kind);
    const line = svgElement("line", {x1: from[0], y1: from[1], x2: to[0], y2: to[1], stroke: inCss(colourOf(kind)), "stroke-width": width * 0.006, "stroke-opacity": opacity,
      "stroke-linecap": "round", "stroke-dasharray": dashed ? "0.03 0.03" : "none", "data-kind": kind});
    if (tip) line.append(svgElement("title", {}, tip));
    this.parts.push(line);
  }

  area(corners, fill, opacity) {
    this.parts.push(svgElement("polygon", {points: corners.map((p) => p.join()).join(" "), fill, "fill-opacity": opacity}));
  }

  label([x, y], text, strong, kind = "number") {
    this.labels.push(svgElement("text", {x, y, "text-anchor": "middle", "dominant-baseline": "central", "font-size": strong ? 1.25 * this.text : kind === "number" ? Math.min(this.text, this.shell.ring.length > 6 ? 0.098 : this.shell.ring.length > 5 ? 0.107 : 0.12) : this.text,
      "font-weight": strong ? 700 : 600, fill: inCss(colourOf("ink")), stroke: inCss(colourOf("card")), "stroke-width": 0.022, "paint-order": "stroke", "data-kind": kind}, text));
  }

  /** The number of the vertex, and below it p_i as the paper has it. */
  corner([x, y], vertex, i) {
    const inside = 1 - 0.5 * widthOfCorner(this.shell);
    const at = [Math.max(Math.min(x, inside), -inside), Math.max(Math.min(y, 1 - 1.45 * this.text), 1.25 * this.text - 1)];
    this.label([at[0], at[1] - 0.5 * this.text], `${vertex}`, true, "corner");
    this.label([at[0], at[1] + 0.65 * this.text], "", false, "place");
    this.labels.at(-1).append(svgElement("tspan", {"font-style": "italic"}, "p"), svgElement("tspan", {"font-size": "90%", dy: "0.2em"}, `${i + 1}`));
  }

  outline() {
    this.shell.ring.forEach((vertex, i) => {
      this.stroke(this.at(i), this.at((i + 1) % this.shell.ring.length), "skirt", 3);
      this.corner(ringPlace(this.shell, i, 0.9 - 1.5 * Math.max(this.text - TEXT_OF_RING, 0)), vertex, i);
    });
  }

  chords() {
    for (const [i, j, on, back] of [...this.shell.chords].reverse()) {  // the best on top
      const usable = Math.max(on, back) > this.shell.floor;
      this.stroke(this.at(i), this.at(j), "chord", 1.6, {dashed: !usable, opacity: usable ? 0.9 : 0.45,
        tip: `chord ${this.shell.ring[i]} - ${this.shell.ring[j]}: worst quality of its pockets ${four(on)} and ${four(back)}${usable ? "" : "; not better than the old tets"}`});
    }
  }

  covering({triangles, core}, dashed) {
    if (core.length >= 3) this.core(core);
    for (const [i, k, j, quality] of triangles) {
      const corners = [i, k, j].map((n) => this.at(n));
      this.area(corners, qualityFill(quality), dashed ? 0.35 : 0.7);
      corners.forEach((p, n) => this.stroke(p, corners[(n + 1) % 3], "chord", 2.2, {dashed}));
      this.label(scale(corners.map((p) => [...p, 0]).reduce(add), 1 / 3), three(quality));
    }
    if (triangles.length === 0) return;
    for (const [i, j, quality] of core) {
      this.stroke(this.at(i), this.at(j), "core", 4.5, {dashed, tip: `side of the core ${this.shell.ring[i]} - ${this.shell.ring[j]}: ${four(quality)}`});
    }
  }

  /** Each side of the core with the edge ab, a tet, is a slice from its middle. */
  core(core) {
    const middle = scale(core.map(([i]) => [...this.at(i), 0]).reduce(add), 1 / core.length).slice(0, 2);
    for (const [i, j, quality] of core) {
      this.area([middle, this.at(i), this.at(j)], qualityFill(quality), 0.7);
      this.stroke(middle, this.at(i), "edge", 1, {opacity: 0.6});
      const side = mix([...this.at(i), 0], [...this.at(j), 0], 0.5);
      this.label(mix([...middle, 0], side, 0.7), three(quality));
    }
    this.label(middle, "ab", true, "edge");
  }

  cell(cell) {
    const k = tableApex(this.shell, cell.i, cell.j);
    if (k < this.shell.ring.length) {
      this.area([cell.i, k, cell.j].map((n) => this.at(n)), inCss(colourOf("cell")), 0.28);
      this.stroke(this.at(cell.i), this.at(k), "cell", 2);
      this.stroke(this.at(k), this.at(cell.j), "cell", 2);
    }
    this.stroke(this.at(cell.i), this.at(cell.j), "cell", 4);
  }

  finish() { this.svg.replaceChildren(...this.parts, ...this.labels); }
}

/** Gives the kinds of its lines. */
function showRing(call, position, cell) {
  byId("ring-card").hidden = !call?.shell;
  if (!call?.shell) return new Set();
  const {name, caption, shell} = stageOfRing(call, position);
  byId("caption").textContent = caption;
  const drawing = new RingDrawing(byId("ring"), shell);
  drawing.outline();
  if (name === "made") {
    drawing.covering(shell.covering, false);
  } else if (name === "found") {
    drawing.kinds.add("planned");
    drawing.covering(shell.covering, true);
  } else if (name === "full") {
    drawing.chords();
    drawing.covering(shell.full, true);
  } else {
    drawing.covering(shell.before, false);
    if (name !== "earlier") drawing.chords();
  }
  if (cell) drawing.cell(cell);
  drawing.finish();
  return drawing.kinds;
}

// --- chords and tables ---

function showChords(call, position) {
  byId("chords-card").hidden = !call?.shell;
  if (!call?.shell) return;
  const {shell} = stageOfRing(call, position);
  byId("locks").textContent = shell.locks;
  const body = [];
  const none = !shell.searched ? "too many corners to be searched" : shell.chords.length === 0 ? "no chord has a pocket" : "";
  if (none) {
    body.push(make("tr", {}, make("td", {class: "quiet"}, none)));
  } else {
    body.push(make("thead", {}, make("tr", {}, make("th", {}, "chord, best first"), make("th", {}, "worst q, one side"), make("th", {}, "other side"))));
    for (const [i, j, on, back] of shell.chords) {
      const quality = (q) => q <= 0 ? make("td", {class: "quiet"}, "none")
        : q > shell.floor ? make("td", {class: "better"}, `${four(q)}, better`) : make("td", {class: "quiet"}, four(q));
      body.push(make("tr", {}, make("td", {}, `${shell.ring[i]} - ${shell.ring[j]}`), quality(on), quality(back)));
    }
  }
  byId("chords").replaceChildren(...body);
}

/** The tables up to a cell; `filled` is the number of cells that are. */
function showTables(call, filled, isFilling) {
  const shell = call?.shell?.tables && call.name !== "recursion" ? call.shell : null;
  byId("tables-card").hidden = !shell;
  if (!shell) return;
  const cells = cellsOf(shell);
  const here = isFilling && filled > 0 ? cells[filled - 1] : null;
  const number = new Map(cells.map((cell, n) => [`${cell.i} ${cell.j}`, n]));
  const used = new Set();
  if (here) for (const {k} of choicesOf(shell, here)) used.add(`${here.i} ${k}`).add(`${k} ${here.j}`);
  const table = (caption, entry) => {
    const m = shell.ring.length;
    const head = make("tr", {}, make("th", {}, "i \\ j"), ...shell.ring.map((v) => make("th", {scope: "col"}, `${v}`)));
    const rows = shell.ring.map((v, i) => make("tr", {}, make("th", {scope: "row"}, `${v}`), ...shell.ring.map((w, j) => {
      if (i === j) return make("td", {class: "none"}, "\u00b7");
      const isSide = j === (i + 1) % m;
      const key = `${i} ${j}`;
      const isFilled = isSide || number.get(key) < filled;
      const classes = [isSide ? "side" : isFilled ? "" : "open", here && key === `${here.i} ${here.j}` ? "here" : "", used.has(key) ? "used" : ""];
      const cell = make("td", {"data-cell": `${i},${j}`}, isFilled ? entry(i, j, classes) : "");
      cell.className = classes.filter(Boolean).join(" ");
      return cell;
    })));
    return [make("caption", {}, ...withIndices(caption)), make("thead", {}, head), make("tbody", {}, ...rows)];
  };
  byId("table-q").replaceChildren(...table("M_q: quality of the pocket", (i, j, classes) => {
    const q = tableQuality(shell, i, j);
    if (q === Infinity) return "\u221e";
    classes.push(q <= 0 ? "none" : q > shell.floor ? "better" : "");
    return q <= 0 ? "none" : three(q);
  }));
  byId("table-k").replaceChildren(...table("M_k: its third corner", (i, j) => {
    const k = tableApex(shell, i, j);
    return k < shell.ring.length ? `${shell.ring[k]}` : "\u2013";
  }));
  byId("cell-text").replaceChildren(...withIndices(tableText(shell, filled, here, isFilling)));
  const code = recording.codes[TABLE_CODE];
  byId("fill-code").hidden = !isFilling;
  if (isFilling) listLines(byId("fill-code"), code.lines, here ? [12, 13, 14] : [1]);
}

function tableText(shell, filled, here, isFilling) {
  const name = (i) => shell.ring[i];
  if (!isFilling) return `Filled. Bold: better than the old tets, whose worst quality is ${four(shell.floor)}.`;
  const total = cellsOf(shell).length;
  if (!here) return `A row and a column for each corner of the ring. The pocket from i on to j is triangulated in the best way. ${isOnStage() ? "" : "Step into the table, or over it: "}${total} cells.`;
  const choices = choicesOf(shell, here).map(({k, quality}) => `k = ${name(k)} gives ${quality > 0 ? four(quality) : "none"}`);
  const best = tableApex(shell, here.i, here.j);
  const result = best < shell.ring.length ? `M_q = ${four(tableQuality(shell, here.i, here.j))}, M_k = ${name(best)}.`
    : shell.locks && choices.some((choice) => !choice.endsWith("none")) ? "Locked: none." : "No triangulation.";
  return `Cell ${filled} of ${total}, pocket from ${name(here.i)} to ${name(here.j)}: ${choices.join("; ")}. ${result}`;
}

// --- the algorithm ---

function listLines(list, lines, here) {
  list.replaceChildren(...lines.map((text, n) => {
    const line = make("span", {}, ...withIndices(text));  // as one: parts would stand beside each other
    line.style.setProperty("--hang", text.search(/\S/) + 2);  // where it goes on below, in letters
    return make("li", here.includes(n + 1) ? {class: "here", "aria-current": "step"} : {}, line);
  }));
}

function showCode(step) {
  const stack = stackOf(step);
  const codeOf = (n) => {
    const call = stack[n];
    const line = step.lines[n];
    return call && call.code >= 0 ? {...recording.codes[call.code], line} : null;
  };
  const pass = step.passLine > 0 ? {...recording.codes[PASS_CODE], line: step.passLine} : null;
  const here = stack.length > 0 ? codeOf(stack.length - 1) : pass;
  const caller = stack.length > 1 ? codeOf(stack.length - 2) : stack.length === 1 ? pass : null;
  byId("code-title").replaceChildren(...withIndices(here ? here.title : stack.length > 0 ? "An operator that is not described" : "No call here"));
  document.querySelector(".code").hidden = isOnStage() && !here;
  listLines(byId("code"), here ? here.lines : [], here ? [here.line] : []);
  byId("caller").replaceChildren();
  if (!caller || caller.line === 0) return;
  byId("caller").append(`called from line ${caller.line} of ${caller.title.split(":")[0]}: `, make("b", {}, ...withIndices(caller.lines[caller.line - 1].trim())),
    step.goesOn > 0 ? `; goes on at line ${step.goesOn}` : "");
}

// --- the calls ---

const nameOf = (outcome) => outcome === "unfinished" ? "under way" : recording.outcomes[outcome].name;

/** The mark of a way to end, which tells it apart without its colour; for the ear, too, where nothing beside it says the same. */
function markOf(outcome, isNamed = false) {
  const heard = isNamed ? {role: "img", "aria-label": nameOf(outcome)} : {"aria-hidden": "true"};
  const svg = svgElement("svg", {viewBox: "0 0 1 1", class: "mark", style: `color: var(--${outcome})`, ...heard});
  for (const line of recording.outcomes[outcome].mark) svg.append(svgElement("polyline", {points: line.join(" ")}));
  return svg;
}

const folds = new Map();  // by number: open or not, as the reader wants it

/** Rows of the tree: those of the stack are open, and those that the reader opened. */
function rowsOfTree(step) {
  const stack = new Set(stackOf(step).map((call) => call.number));
  const rows = [];
  for (const call of [...calls.values()].sort((x, y) => x.number - y.number)) {
    if (call.begin >= steps[steps.length - 1].position) continue;
    let isHidden = false;
    for (let up = call.parent === null ? null : calls.get(call.parent); up; up = up.parent === null ? null : calls.get(up.parent)) {
      if (!(folds.get(up.number) ?? stack.has(up.number))) isHidden = true;
    }
    if (!isHidden) rows.push({call, hasCalls: call.last > call.number + 1, isOpen: folds.get(call.number) ?? stack.has(call.number)});
  }
  return rows;
}

/** Rows, which are higher for fingers. */
const mostOnStage = () => matchMedia("(pointer: coarse), (max-width: 40rem)").matches ? 5 : 9;

/** All, or on the stage of a lesson those around the call at hand. */
function rowsInSight(step) {
  const rows = rowsOfTree(step);
  const most = mostOnStage();
  if (!isOnStage() || rows.length <= most) return rows;
  // Outside of all calls, around the one that ended last.
  const at = rows.findIndex(({call}) => call.number === step.call);
  const here = Math.max(at >= 0 ? at : rows.findLastIndex(({call}) => isDone(call, step.position)), 0);
  const first = Math.min(Math.max(here - (most >> 1), 0), rows.length - most);
  return rows.slice(first, first + most);
}

function showTree(step, enter, redraw) {
  const least = Math.min(...[...calls.values()].map((call) => call.depth));
  const here = step.call;
  const rows = rowsInSight(step).map(({call, hasCalls, isOpen}) => {
    const outcome = outcomeOf(call, step.position);
    const fold = hasCalls ? make("button", {type: "button", class: "fold", "aria-expanded": String(isOpen), "aria-label": `calls in call ${call.number}`,
      onclick: () => { folds.set(call.number, !isOpen); redraw(); }}, isOpen ? "\u25be" : "\u25b8") : make("span", {class: "fold", style: "display: inline-block; min-width: 1.5rem"});
    const row = make("button", {type: "button", class: "row", title: `call ${call.number}, ${call.operator}${call.settings ? ` {${call.settings}}` : ""}: ${hasBegun(call, step.position) ? verdictOf(call, step.position) : "to come"}`,
      onclick: () => enter(call)}, hasBegun(call, step.position) ? markOf(outcome, true) : make("span", {class: "mark"}), `${call.level} ${call.name} ${call.target.join("-")}`);
    const first = make("td", {}, fold, row);
    first.style.paddingLeft = `${0.8 * (call.depth - least)}rem`;
    return make("tr", {class: call.number === here ? "here" : "", "data-call": call.number, ...(call.number === here ? {"aria-current": "true"} : {})},
      first, ...[call.degrees, call.qualities].map((text) => make("td", {}, isDone(call, step.position) ? text : text.split(" -> ")[0])));
  });
  byId("tree").replaceChildren(make("thead", {}, make("tr", {}, make("th", {}, "level, operator, target"), make("th", {}, "degree"), make("th", {}, "worst q"))), make("tbody", {}, ...rows));
  const seen = new Set(rowsInSight(step).filter(({call}) => hasBegun(call, step.position)).map(({call}) => outcomeOf(call, step.position)));
  byId("marks").replaceChildren(...Object.keys(recording.outcomes).filter((outcome) => seen.has(outcome)).map((outcome) =>
    make("li", {}, markOf(outcome), nameOf(outcome))));
  const box = byId("tree-scroll");
  const row = byId("tree").querySelector("tr.here");
  if (row && (row.offsetTop < box.scrollTop + row.offsetHeight || row.offsetTop + row.offsetHeight > box.scrollTop + box.clientHeight)) {
    box.scrollTop = row.offsetTop - box.clientHeight / 3;
  }
}

function showTold(step, enter) {
  const stack = stackOf(step);
  const call = stack[stack.length - 1];
  byId("crumbs").replaceChildren(...stack.flatMap((c, n) => {
    const button = make("button", {type: "button", onclick: () => enter(c)}, `${c.name} ${c.place}`);
    if (n === stack.length - 1) button.setAttribute("aria-current", "true");
    return n === 0 ? [button] : ["\u203a", button];
  }));
  if (stack.length === 0) byId("crumbs").textContent = "outside of all calls";
  byId("removal").textContent = call?.removal ?? "";
  const verdict = call ? verdictOf(call, step.position) : "";
  const ending = `: ${verdict}`;  // which stands beside it
  byId("event").textContent = call && step.event.endsWith(ending) ? step.event.slice(0, -ending.length) : step.event;
  byId("verdict").replaceChildren(...(call ? [markOf(outcomeOf(call, step.position)), verdict] : []));
  byId("verdict").style.color = call ? `var(--${outcomeOf(call, step.position)})` : "";
  byId("reason").textContent = call && isDone(call, step.position) ? call.reason ?? "" : "";
}

const LEGEND = [["visited", "tet t that the pass turns to", 3.5, ""], ["tet", "tet of the call", 3.5, ""], ["vertex", "vertex v of the call", 9, ""], ["target", "face of the call", 4, ""],
  ["edge", "edge ab", 4.5, ""], ["skirt", "skirt polygon", 2.5, ""], ["chord", "chord of the covering", 3, ""], ["core", "side of the core", 5, ""],
  ["planned", "found, not made yet", 3, "4 3"], ["ancestor", "edges that the callers remove", 4, "5 4"], ["cell", "the cell of the tables", 4, ""], ["ghost", "tets around", 1.2, ""]];

// Short: for the stage of a lesson, below the ring.
const RING_LEGEND = [["edge", "edge ab", 1.5, ""], ["skirt", "skirt polygon", 2.5, ""], ["chord", "chord", 3, ""], ["core", "side of the core", 5, ""], ["planned", "not made yet", 3, "4 3"], ["cell", "cell of the tables", 4, ""]];
const LESS = ["ghost"];  // what a small window has no room for

function legendLine([kind, text, width, dashes]) {
  const svg = svgElement("svg", {viewBox: "0 0 22 9", "aria-hidden": "true"});
  if (kind === "visited" || kind === "tet") svg.append(svgElement("line", {x1: 0, y1: 4.5, x2: 22, y2: 4.5, stroke: inCss(colourOf("wire")), "stroke-width": 2 * width}));
  if (kind === "face") for (let x = -6; x < 22; x += 4) svg.append(svgElement("line", {x1: x, y1: 9, x2: x + 8, y2: 0, stroke: inCss(colourOf(kind)), "stroke-width": 1.4}));
  const [x1, x2] = kind === "vertex" ? [11, 11.01] : [1, 21];
  svg.append(svgElement(kind === "face" ? "g" : "line", {x1, y1: 4.5, x2, y2: 4.5, "stroke-linecap": kind === "vertex" ? "round" : "butt", stroke: inCss(colourOf(kind)), "stroke-width": width, "stroke-dasharray": dashes}));
  return make("li", {"data-kind": kind, class: LESS.includes(kind) ? "less" : ""}, svg, text);
}

function swatch(colours) {
  const svg = svgElement("svg", {viewBox: "0 0 22 9", "aria-hidden": "true"});
  colours.forEach((colour, n) => svg.append(svgElement("rect", {x: n * 22 / colours.length, y: 0, width: 22 / colours.length + 0.2, height: 9, fill: inCss(colour)})));
  return svg;
}

/** What the colours of tets and of slices of the ring mean. */
function fills() {
  const wide = make("span", {class: "wide"}, ", from 1, which just meets the goal, to 2");
  return [make("li", {class: "fill"}, swatch([BAD]), "bad tet, q < 1"), make("li", {class: "fill"}, swatch(EMBER.slice(3)), make("span", {}, "quality q", wide))];
}

function showLegend(scene, ringKinds) {
  const items = LEGEND.filter(([kind]) => scene.kinds.has(kind)).map(legendLine);
  if (scene.kinds.has("caller")) items.push(make("li", {class: "less"}, swatch([colourOf("caller")]), `shell of the caller, ${scene.caller.join(" ")}`));
  if (scene.kinds.has("face")) items.push(legendLine(["face", `face f to remove, ${scene.faceToRemove.join(" ")}`, 0, ""]));
  if (scene.faces.length > 0) items.push(...fills());
  byId("legend").replaceChildren(...items);
  byId("ring-legend").replaceChildren(...RING_LEGEND.filter(([kind]) => ringKinds.has(kind)).map(legendLine), ...(ringKinds.size > 0 ? fills() : []));
}
