// The recording: steps, calls and tets, and what they make of each other.

const recording = JSON.parse(document.getElementById("recording").textContent);

const points = recording.points.map(([vertex, ...place]) => ({vertex, place}));
const tets = recording.tets.map(([a, b, c, d, quality]) => ({corners: [a, b, c, d], quality}));
const calls = new Map(Object.entries(recording.calls).map(([number, call]) => [Number(number), {number: Number(number), ...call}]));
const steps = recording.steps.map(([position, event, call, lines, passLine, ways, gone, come, goesOn]) =>
  ({position, event, call, lines, passLine, ways, gone, come, goesOn}));
for (const call of calls.values()) {
  if (call.shell !== undefined) call.shell = {...recording.shells[call.shell], ...call.made};
}
const visits = recording.visits.map(([begin, end, tet]) => ({begin, end, tet}));
const TABLE_CODE = 0;  // places in recording.codes
const PASS_CODE = 1;

/** Number of the last step at or before a position of the trace. */
function stepBefore(position) {
  let low = 0;
  let high = steps.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (steps[middle].position <= position) low = middle; else high = middle - 1;
  }
  return low;
}

/** Number of the first step at or after a position. */
function stepAfter(position) {
  const before = stepBefore(position);
  return steps[before].position >= position ? before : Math.min(before + 1, steps.length - 1);
}

function callOf(step) { return step.call === null ? null : calls.get(step.call) ?? null; }

/** The tet that a pass has turned to, outside of all calls; null where there is none. */
function tetVisited(step) {
  if (step.call !== null) return null;
  return visits.find((visit) => visit.begin <= step.position && step.position <= visit.end)?.tet ?? null;
}

/** The calls around a step, outermost first. */
function stackOf(step) {
  const stack = [];
  for (let call = callOf(step); call; call = call.parent === null ? null : calls.get(call.parent)) stack.unshift(call);
  return stack;
}

function isDone(call, position) { return position >= call.end; }
function verdictOf(call, position) { return isDone(call, position) ? call.verdict : "under way"; }
function outcomeOf(call, position) { return isDone(call, position) ? call.outcome : "unfinished"; }
function hasBegun(call, position) { return position > call.begin; }

/** The tets that are there, step by step. Going to a step costs the changes on the way. */
const present = {
  at: 0,
  tets: new Set(recording.start),
  goTo(number) {
    while (this.at < number) {
      const step = steps[++this.at];
      for (const tet of step.gone) this.tets.delete(tet);
      for (const tet of step.come) this.tets.add(tet);
    }
    while (this.at > number) {
      const step = steps[this.at--];
      for (const tet of step.come) this.tets.delete(tet);
      for (const tet of step.gone) this.tets.add(tet);
    }
  },
};

/** All tets that a call found, made or tried. */
function tetsOf(call) {
  if (!call.own) {
    call.own = new Set([...(call.before ?? []), ...(call.after ?? [])]);
    for (let number = stepAfter(call.begin + 1); number < steps.length && steps[number].position <= call.end; ++number) {
      for (const tet of steps[number].come) call.own.add(tet);
      for (const tet of steps[number].gone) call.own.add(tet);
    }
  }
  return call.own;
}

/** The cells of the tables in the order of Algorithm 2, diagonal by diagonal. */
function cellsOf(shell) {
  if (!shell.cells) {
    shell.cells = [];
    const m = shell.ring.length;
    for (let d = 2; d < m; ++d) {
      for (let i = 0; i < m; ++i) shell.cells.push({i, j: (i + d) % m, d});
    }
  }
  return shell.cells;
}

/** The shell whose tables are filled at this step, or null. */
function shellBeingFilled(step) {
  const call = callOf(step);
  const searches = call && call.shell && call.shell.tables && (call.name !== "recursion");
  return searches && step.position === call.begin + 1 ? call.shell : null;
}

/** The worse of the two tets at a triangle of the ring. */
function triangleQuality(shell, x, y, z) {
  if (!shell.triangleAt) {
    shell.triangleAt = new Map();
    const m = shell.ring.length;
    let next = 0;
    for (let i = 0; i < m; ++i)
      for (let k = i + 1; k < m; ++k)
        for (let j = k + 1; j < m; ++j) shell.triangleAt.set((i * m + k) * m + j, shell.tables.triangles[next++]);
  }
  const m = shell.ring.length;
  const [i, k, j] = [x, y, z].sort((p, q) => p - q);
  return shell.triangleAt.get((i * m + k) * m + j);
}

/** Entry of M_q: Infinity for a side of the ring, 0 for no triangulation. */
function tableQuality(shell, i, j) { return shell.tables.q[i * shell.ring.length + j] ?? Infinity; }
function tableApex(shell, i, j) { return shell.tables.k[i * shell.ring.length + j]; }

/** What Algorithm 2 looks at for a cell: each k with its three terms and the least of them. */
function choicesOf(shell, cell) {
  const m = shell.ring.length;
  const choices = [];
  for (let n = 1; n < cell.d; ++n) {
    const k = (cell.i + n) % m;
    const terms = [triangleQuality(shell, cell.i, k, cell.j), tableQuality(shell, cell.i, k), tableQuality(shell, k, cell.j)];
    choices.push({k, quality: Math.min(...terms)});
  }
  return choices;
}
