-- The best mesh that the fixed surface allows, for the time it takes.
description "The rounds of Algorithm 6, then insertion by cavity, small polyhedra and joint smoothing for the bad tets that remain, the worst first, until nothing helps"

local max_rounds   = parameter{"max_rounds", default = 12, low = 0, high = 10000,
                               help = "rounds of dear operators on the bad tets that remain"}
local max_failed   = parameter{"max_failed", default = 2, low = 1, high = 1000,
                               help = "such rounds in sequence without progress that end the run"}
local min_dihedral = parameter{"min_dihedral", default = 30, low = 0, high = 30,
                               help = "goal, degrees: ends as soon as no dihedral angle is below this or above 180 less this"}
local time_limit   = parameter{"time_limit", default = 0, low = 0, high = 1e9,
                               help = "seconds after which no further pass begins; 0: none"}

local worst = {below = 0.5, worst = 100}
local dire  = {below = 0.25, at_least = 100}
local hard  = {below = 0.35}

local function is_enough()
  local now = quality()
  return now.n_bad == 0
      or math.min(now.theta_min, 180 - now.theta_max) >= min_dihedral
      or time_limit > 0 and now.seconds >= time_limit
end

local function clean_up()
  smooth{}
  suppress_points{}
  smooth{}
end

-- Algorithm 6, as long as it is fast.
local function plain_round()
  begin_round()
  local_reconnection{}
  clean_up()
  insert_points{}
  smooth{}
end

-- A steep exponent: a new mild bad tet hardly counts against a worse one that goes.
local function insertion_round()
  begin_round()
  local_reconnection{}
  local_reconnection{on = dire, reflex_only = false}
  clean_up()
  apply({"cavity_insertion", exponent = 16}, {on = {below = 0.5, worst = 1000}})
  smooth{}
end

-- A small polyhedron without the tet, smoothed: with a new vertex, else without.
local function refill(max_vertices, desperate)
  local function form(insert)
    return {"polyhedron_reconnection", insert = insert, remove = true, relax = true,
            max_vertices = max_vertices, max_nodes = 50, desperate = desperate}
  end
  return first_of{form(true), form(false)}
end

-- All that may help the worst, each round in another form.
local sizes = {16, 20, 24}
local function worst_tets(i)
  local size = sizes[(i - 1) % #sizes + 1]
  local steep = i % 2 == 0
  smooth{on = worst, desperate = 0.35, steps = 30}
  apply({"joint_smoothing", desperate = 0.35}, {on = worst})
  local_reconnection{on = worst, reflex_only = false}
  apply({"cavity_insertion", exponent = steep and 12 or 4, desperate = steep and 0.35 or 0.2}, {on = worst})
  apply(refill(size, 0.35), {on = worst})
  apply(refill(size, 0.45), {on = {below = 0.5, worst = 32}})
end

-- Fewer bad tets, never for a worse one: with the exponent 1 the many mild ones count.
local function all_bad_tets()
  apply("joint_smoothing")
  apply({"cavity_insertion", exponent = 1, desperate = 0, tries = 4})
  apply(refill(20, 0), {on = hard})
end

local before = quality()
repeat
  local last = before
  plain_round()
  before = quality()
until before.n_bad > 0.9 * last.n_bad or is_enough()

while not is_enough() do
  insertion_round()
  local now = quality()
  local stuck = not is_progress(before, now)
  before = now
  if stuck then break end
end

local failed, numbers_fall = 0, true
for i = 1, max_rounds do
  if is_enough() or failed == max_failed then break end
  before = quality()
  begin_round()
  worst_tets(i)
  clean_up()
  local_reconnection{}
  smooth{}
  if numbers_fall and not is_enough() then
    all_bad_tets()
    numbers_fall = quality().n_bad < 0.95 * before.n_bad
  end
  failed = is_progress(before, quality()) and 0 or failed + 1
end

-- Smoothing of mild tets trades a few against each other; the last word is with the dear operators.
if not is_enough() and max_rounds > 0 then
  worst_tets(1)
  all_bad_tets()
end
