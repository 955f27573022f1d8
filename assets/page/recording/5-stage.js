// The stage of a lesson: the text of a step, the panels that it speaks of, and its question.

const lesson = recording.lesson ?? null;
const PANELS = {picture: ".picture", algorithm: ".code", ring: ".ring", tables: ".tables", tree: ".tree"};  // as they follow each other
const DRAWN = ["picture", "ring"];  // as large as there is room; the others have the size of their text
const answers = new Map();  // by step of the lesson: {isRight, given}

const questionAt = (n) => lesson?.steps[n]?.ask ?? null;
const isOnStage = () => document.body.dataset.mode === "lesson";

function score() {
  const questions = lesson.steps.filter((step) => step.ask).length;
  return {questions, answered: answers.size, right: [...answers.values()].filter(({isRight}) => isRight).length};
}

/** A page around this one, of a course or a notebook, learns how far its reader is. */
function tellParent(n) {
  if (window.parent === window || !lesson) return;
  window.parent.postMessage({from: "tetmend", lesson: lesson.title, step: n + 1, steps: lesson.steps.length, ...score()}, "*");
}

const isNarrow = matchMedia("(max-width: 40rem)");

function setMode(mode) {
  document.body.dataset.mode = mode;
  byId("explore").setAttribute("aria-pressed", String(mode === "explore"));
  settleBars();
}

/** A phone has room for one bar: that of the events has the way back to the lesson then. */
function settleBars() {
  const button = byId("explore");
  const isOne = !isOnStage() && isNarrow.matches;
  byId("bar").hidden = !lesson || isOne;
  document.body.dataset.bars = lesson && !isOne ? 2 : 1;
  const place = document.querySelector(lesson && isOne ? ".events .place" : "#bar");
  if (button.parentElement === place) return;
  const hadFocus = document.activeElement === button;
  place.insertBefore(button, place.querySelector("#lesson-next"));
  if (hadFocus) button.focus();
}

/** Marks the panels of a step; a panel that has nothing to show there is left out. */
function chooseFocus(n) {
  const isShown = (name) => !document.querySelector(PANELS[name]).hidden;
  const wanted = lesson.steps[Math.max(n, 0)].focus.filter(isShown);
  const focus = wanted.length > 0 ? wanted : ["picture"];
  for (const [name, selector] of Object.entries(PANELS)) document.querySelector(selector).classList.toggle("focused", focus.includes(name));
  const inOrder = Object.keys(PANELS).filter((name) => focus.includes(name));
  document.body.dataset.panels = inOrder.length;
  document.body.dataset.drawn = DRAWN.filter((name) => focus.includes(name)).join(" ");
  const rows = inOrder.map((name) => (DRAWN.includes(name) ? "minmax(var(--least), 1fr)" : "auto"));
  const {style} = document.querySelector("main");
  style.setProperty("--rows", rows.join(" "));
  style.setProperty("--columns", `repeat(${Math.min(inOrder.length, 2)}, minmax(0, 1fr))`);
}

const overflows = (element) => element.scrollHeight > element.clientHeight + 1 || element.scrollWidth > element.clientWidth + 1;

/** Sets the sizes of a variable one after the other, up to the first with which nothing is cut. */
function fit(name, sizes, isCut) {
  return sizes.some((size) => {
    document.body.style.setProperty(name, size);
    return !isCut();
  });
}

/** Text as large as fits: first that of the lesson, then that of the panels. */
function fitStage() {
  if (!isOnStage()) return;
  const sizes = [1, 0.94, 0.88, 0.82, 0.76, 0.7, 0.64, 0.58];
  const text = byId("lesson");
  const isColumn = text.getBoundingClientRect().bottom > byId("bar").getBoundingClientRect().top - 2;
  const isLarge = document.documentElement.dataset.size === "large";
  const isTextCut = () => overflows(text) || overflows(byId("lesson-text")) || (!isColumn && text.offsetHeight > 0.42 * innerHeight);
  fit("--text", [...(isColumn && !isLarge ? [1.3, 1.15] : []), ...sizes], isTextCut);
  const main = document.querySelector("main");
  const cards = [...main.querySelectorAll(".focused")];
  const isWide = (card) => [...card.querySelectorAll("table")].some((table) => table.getBoundingClientRect().right > card.getBoundingClientRect().right - 6);
  const isSmall = (card) => [...card.querySelectorAll("#stage, #ring")].some((drawing) => drawing.clientHeight < 100);
  const isCut = () => overflows(main) || cards.some((card) => overflows(card) || isWide(card) || isSmall(card));
  const more = cards.some((card) => card.id === "tables-card") ? [2.2, 1.9, 1.6, 1.4, 1.2] : isColumn ? [1.3, 1.15] : [];
  // Lines to be pressed are for fingers, if that leaves their text as it is; drawings give way where they have no column
  // of their own; then names in tables are broken.
  const hasLines = questionAt(place.lesson)?.kind === "line" && !answers.has(place.lesson);
  for (const finger of hasLines ? ["44px", "38px", "32px", "28px", "24px"] : ["24px"]) {
    document.body.style.setProperty("--finger", finger);
    const all = finger === "24px" ? [...more, ...sizes] : sizes.slice(0, 6);
    const readable = all.filter((size) => size > 0.69);  // nine pixels on a phone
    const rooms = [["max(10rem, 28vh)", "no"], ["max(10rem, 26vh)", "no"], ["10rem", "no"], ["8rem", "no"], ["8rem", "yes"]];
    const fitIn = ([least, wrap], text) => {
      document.body.style.setProperty("--least", least);
      document.body.dataset.wrap = wrap;
      return fit("--fit", text, isCut);
    };
    const before = document.body.style.getPropertyValue("--text");
    for (const room of rooms.slice(0, 3)) {  // the text gives way first, as long as it is easy to read
      if (fitIn(room, readable)) return;
      if (!isColumn && fit("--text", [0.94, 0.88, 0.82, 0.76].filter((size) => size < before), () => !fitIn(room, readable))) return;
      document.body.style.setProperty("--text", before);
    }
    if (rooms.some((room) => fitIn(room, all))) return;
  }
}

// --- questions ---

/** The first answer counts. */
function giveAnswer(n, isRight, given) {
  if (answers.has(n)) return;
  answers.set(n, {isRight, given});
  show();
}

/** Parts of a text: "M_q" and "p_i" as print has them. The underscore stays, for whoever copies or hears it. */
function withIndices(text) {
  return text.split(/\b([A-Za-z]_[a-z0-9])\b/).map((part, n) => n % 2 === 0 ? part : make("span", {class: "index"}, part[0], make("sub", {}, make("i", {}, "_"), part.slice(2))));
}

function showQuestion(n) {
  const ask = isOnStage() ? questionAt(n) : null;
  byId("ask").hidden = !ask;
  if (!ask) return;
  byId("ask-text").replaceChildren(...withIndices(ask.text));
  const answer = answers.get(n);
  byId("choices").replaceChildren(...CHOICES[ask.kind](n, ask, answer));
  const mark = answer?.isRight ? make("b", {class: "yes"}, "\u2713 Right. ") : make("b", {class: "no"}, "\u2717 Not so. ");
  byId("answered").replaceChildren(...(answer ? [mark, ...withIndices(ask.why)] : []));
}

/** What there is to press, by kind of question; of some it is in the panels. */
const CHOICES = {
  accepted: (n, ask, answer) => [["Accepted", true], ["Refused", false]].map(([text, value]) => {
    const button = make("button", {type: "button", onclick: () => giveAnswer(n, value === ask.answer, value)}, text);
    button.disabled = Boolean(answer);
    if (answer && value === ask.answer) button.className = "right";
    else if (answer && value === answer.given) button.className = "wrong";
    return button;
  }),
  number: (n, ask, answer) => {
    const input = make("input", {type: "text", inputmode: "decimal", autocomplete: "off", "aria-labelledby": "ask-text", id: "number"});
    input.value = answer?.given ?? "";
    input.disabled = Boolean(answer);
    const check = make("button", {type: "submit"}, "Check");
    check.disabled = Boolean(answer);
    return [input, check];
  },
  line: (n, ask, answer) => answer ? [] : ["Press a line of the algorithm."],
  chord: (n, ask, answer) => answer ? [] : ["Press the two corners that it joins."],
};

/** The number that is written there. */
function checkNumber(event) {
  event.preventDefault();
  const n = place.lesson;
  const ask = questionAt(n);
  if (ask?.kind !== "number") return;
  const text = byId("number").value.trim().replace(",", ".");
  if (text === "" || !Number.isFinite(Number(text))) return say("A number, such as 5 or 0.25");
  giveAnswer(n, Math.abs(Number(text) - ask.answer) <= ask.within + 1e-9, text);
}

/** Lines of the algorithm become buttons. */
function askForLine(n, ask) {
  const answer = answers.get(n);
  [...byId("code").children].forEach((item, index) => {
    const button = make("button", {type: "button", onclick: () => giveAnswer(n, index + 1 === ask.answer, index + 1)}, ...item.childNodes);
    button.disabled = Boolean(answer);
    if (answer && index + 1 === ask.answer) button.className = "right";
    else if (answer && index + 1 === answer.given) button.className = "wrong";
    item.replaceChildren(button);
  });
}

/** A number of four digits, with p_i below it, within the circle that is pressed. */
function fitIntoSpots(svg, shell) {
  const fit = (kind, size, down) => svg.querySelectorAll(`text[data-kind=${kind}]`).forEach((text, i) => {
    const [x, y] = ringPlace(shell, i, 0.9);
    text.setAttribute("x", x);
    text.setAttribute("y", y + down);
    text.setAttribute("font-size", Math.min(size, 0.2 / text.textContent.length));
    text.setAttribute("stroke", "none");
  });
  fit("corner", 0.076, -0.024);
  fit("place", 0.05, 0.04);
}

let firstCorner = null;  // of the chord that is being picked

/** Corners of the ring become buttons; two of them make a chord. */
function askForChord(n, ask, shell) {
  const svg = byId("ring");
  const answer = answers.get(n);
  const at = (vertex) => ringPlace(shell, shell.ring.indexOf(vertex));
  const draw = ([from, to], kind, width, dashes) => {
    const [[x1, y1], [x2, y2]] = [at(from), at(to)];
    svg.append(svgElement("line", {x1, y1, x2, y2, stroke: `var(--${kind})`, "stroke-width": width, "stroke-dasharray": dashes, "stroke-linecap": "round", "data-kind": "answer"}));
  };
  if (answer) {
    for (const chord of ask.answer) draw(chord, "accepted", 0.03, "none");
    if (!answer.isRight) draw(answer.given, "rejected", 0.03, "0.05 0.05");
    return;
  }
  const press = (vertex) => {
    if (firstCorner === null || firstCorner === vertex) {
      firstCorner = firstCorner === vertex ? null : vertex;
      return show();
    }
    const chord = [firstCorner, vertex];
    firstCorner = null;
    const isSame = ([a, b]) => chord.includes(a) && chord.includes(b);
    giveAnswer(n, ask.answer.some(isSame), chord);
  };
  svg.setAttribute("role", "group");  // a picture has nothing to press
  const reach = Math.min(0.22, 0.45 * 2 * Math.PI * 0.9 / shell.ring.length);  // of fingers
  shell.ring.forEach((vertex, i) => {
    const [cx, cy] = ringPlace(shell, i, 0.9);
    const spot = svgElement("circle", {cx, cy, r: 0.08, class: "pick", tabindex: 0, role: "button", "aria-label": `corner ${vertex}`, "aria-pressed": String(vertex === firstCorner), "data-corner": vertex});
    spot.addEventListener("keydown", (event) => {
      if (!["Enter", " "].includes(event.key)) return;
      event.preventDefault();
      event.stopPropagation();
      press(vertex);
      svg.querySelector(`[data-corner="${vertex}"]`)?.focus();
    });
    const around = svgElement("circle", {cx, cy, r: reach, class: "reach", "aria-hidden": "true"});
    for (const circle of [spot, around]) circle.addEventListener("click", () => press(vertex));
    svg.querySelector("text[data-kind=corner]").before(spot, around);
  });
  fitIntoSpots(svg, shell);
}

/** Once more where there are corners to be pressed, as the ring was drawn anew. */
function askInRing(n, call, position) {
  const ask = isOnStage() ? questionAt(n) : null;
  byId("ring").setAttribute("role", "img");
  if (ask?.kind === "chord" && call?.shell) askForChord(n, ask, stageOfRing(call, position).shell);
}

// --- the bar ---

function showLesson(step, call, drawRing) {
  if (!lesson) return;
  if (!isOnStage()) place.lesson = lessonStep(step.position);
  const n = place.lesson;
  byId("lesson-text").replaceChildren(...withIndices(n < 0 ? lesson.title : lesson.steps[n].text));
  byId("lesson-count").textContent = `${n + 1} of ${lesson.steps.length}`;
  const {questions, answered, right} = score();
  byId("score").textContent = questions === 0 ? "" : answered === 0 ? `${questions} question${questions === 1 ? "" : "s"}` : `${right} right of ${answered}`;
  byId("lesson-back").disabled = n <= 0 && (isOnStage() || step.position <= lesson.steps[0].at);
  byId("lesson-next").disabled = n === lesson.steps.length - 1 && !(isOnStage() && byId("to-next"));
  showQuestion(n);
  if (isOnStage()) {
    if (questionAt(n)?.kind === "line") askForLine(n, questionAt(n));
    chooseFocus(n);
    fitStage();
    drawRing();  // its text has the size that the room asks for
  }
  askInRing(n, call, step.position);
  tellParent(n);
}

/** The last step of the lesson that is not after a position; -1 before the first. */
function lessonStep(position) {
  let found = -1;
  lesson.steps.forEach((step, n) => { if (step.at <= position) found = n; });
  return found;
}

function goToLesson(n) {
  setMode("lesson");
  place.lesson = Math.min(Math.max(n, 0), lesson.steps.length - 1);
  firstCorner = null;
  place.step = stepAfter(lesson.steps[place.lesson].at);
  place.cell = 0;
  view.when = "now";
  show();
}

function moveInLesson(by) {
  if (!lesson) return;
  if (isOnStage()) {
    if (lesson.steps[place.lesson + by]) goToLesson(place.lesson + by);
    else if (by > 0 && byId("to-next")) byId("to-next").click();  // the next lesson
    return;
  }
  const {position} = steps[place.step];
  const n = lessonStep(position);
  const next = by < 0 && n >= 0 && lesson.steps[n].at < position ? n : n + by;
  if (next >= 0 && next < lesson.steps.length) goTo(stepAfter(lesson.steps[next].at));
}

function toggleExplore() {
  if (!lesson) return;
  if (isOnStage()) goTo(place.step, place.cell); else goToLesson(lessonStep(steps[place.step].position));
}
