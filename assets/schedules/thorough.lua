-- The best mesh that the fixed surface allows, for the time it takes.
description "What the default does; then rounds of costly operators for the worst tets, and insertion by cavity for all bad ones, until nothing helps; at last a polish for the mean"

local max_rounds = parameter{"max_rounds", default = 20, low = 0, high = 10000,
                             help = "rounds of costly operators on the worst tets"}
local max_failed = parameter{"max_failed", default = 3, low = 1, high = 1000,
                             help = "such rounds in sequence without progress that end them"}
local time_limit = parameter{"time_limit", default = 0, low = 0, high = 1e9,
                             help = "seconds after which no further round begins; 0: none"}

local worst = {below = 1, worst = 100}
local very_worst = {below = 1, worst = 20}

-- Where inverted tets are many and neighbours, no operator finds a place for one of them.
untangle{}

local start = quality()

local function is_enough()
  return quality().n_bad == 0 or time_limit > 0 and quality().seconds >= time_limit
end

-- A small polyhedron without the tet but with a new vertex, smoothed.
local refill = {"polyhedron_reconnection", insert = true, remove = true, relax = true,
                max_vertices = 18, max_nodes = 50, desperate = 0.7}

-- Makes things worse at first, then mends them by nearly all that there is. It takes long, so a
-- smaller polyhedron must do.
local function open_by(operator)
  return sequence{operator, "recursive_shell_transformation", "smoothing", "joint_smoothing",
                  {"cavity_insertion", tries = 6},
                  {"polyhedron_reconnection", insert = true, remove = true, relax = true,
                   max_vertices = 10, max_nodes = 15},
                  "smoothing", "joint_smoothing", desperate = 0.7}
end

-- With a steep exponent, a new mild bad tet hardly counts against a worse one that vanishes.
local function rescue(exponent)
  local_reconnection{on = worst, reflex_only = false}
  apply({"cavity_insertion", exponent = exponent, tries = 6, desperate = exponent > 4 and 0.7 or 0}, {on = worst})
  apply(refill, {on = worst})
  smooth{on = worst, desperate = 0.7, steps = 30}
end

-- Fewer bad tets, but none that is worse: with the exponent 1 the many mild ones count.
local function reduce()
  apply({"cavity_insertion", exponent = 1, desperate = 0, tries = 2})
  apply(refill, {on = worst})
  smooth{}
  local_reconnection{}
  smooth{}
end

-- As if the goal were so many times as far from 0 and from 180 degrees.
local function aim(share)
  goal{min = math.min(70, share * start.goal_min),
       max = math.max(71, start.goal_max - (share - 1) * (180 - start.goal_max))}
end

run_schedule("shell", {polish_last = 0})

-- Where the surface forces most of the bad tets, a rescue only makes more of them.
local is_free = quality().n_bad < 2 / 3 * start.n_bad

local rounds, failed, before = 0, 0, quality()
while is_free and rounds < max_rounds and failed < max_failed and not is_enough() do
  rounds = rounds + 1
  -- What is stuck at the goal has neighbours that just meet it and leave it no room. Much becomes
  -- bad by that, and is not to be paid with.
  local is_stuck = failed > 0
  judge_by{price = is_stuck and 0.1 or 0, measure = "sine"}
  aim(is_stuck and 1.05 or 1)
  rescue(rounds % 2 == 0 and 12 or 4)
  apply(open_by("edge_removal"), {on = very_worst})
  apply(open_by{"edge_split", order = "angle", most_edges = 2}, {on = very_worst})
  aim(1)
  run_schedule("shell", {last_sweeps = 0, polish_first = 0, polish_last = 0})
  local now = quality()
  failed = is_progress(before, now) and 0 or failed + 1
  before = now
end

-- As long as it removes a tenth of the bad tets.
while max_rounds > 0 and not is_enough() do
  local n_bad = quality().n_bad
  reduce()
  if quality().n_bad > 0.9 * n_bad then break end
end

-- The mean, without a loss for the worst: so that no angle pays for a needle, by sines.
if max_rounds > 0 and not (time_limit > 0 and quality().seconds >= time_limit) then
  judge_by{measure = "sine"}
  polish{}
  -- It has made room for what could not be mended before.
  judge_by{}
  reduce()
  judge_by{measure = "sine"}
  polish{cycles = 1}
end
