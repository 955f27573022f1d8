-- The best mesh that the fixed surface allows, for the time it takes.
description "The rounds of Algorithm 6; then insertion by cavity, small polyhedra and sequences of operators for the bad tets that remain, until nothing helps"

local max_rounds   = parameter{"max_rounds", default = 12, low = 0, high = 10000,
                               help = "rounds of costly operators on the bad tets that remain"}
local max_failed   = parameter{"max_failed", default = 2, low = 1, high = 1000,
                               help = "such rounds in sequence without progress that end the run"}
local min_dihedral = parameter{"min_dihedral", default = 30, low = 0, high = 30,
                               help = "goal, degrees: ends as soon as no dihedral angle is below this or above 180 less this"}
local time_limit   = parameter{"time_limit", default = 0, low = 0, high = 1e9,
                               help = "seconds after which no further pass begins; 0: none"}

local worst = {below = 1, worst = 100}
local few   = {below = 1, worst = 24}
-- As in the default schedule: the choice of edges matters for the time alone.
local quick = {"recursive_shell_transformation", max_level = 2, order = "angle", most_edges = 1}
local dire  = {below = 0.5, at_least = 100}
local hard  = {below = 0.7}
-- Largest angles between 147.5 and 150 degrees, and above 148.
local blunt  = {below = 1.08, worst = 100, property = {"largest_angle_sine", low = 0.5, high = 0.537}}
local obtuse = {below = 1.06, worst = 8, property = {"largest_angle_sine", low = 0, high = 0.53}}

local function is_late()
  return time_limit > 0 and quality().seconds >= time_limit
end

local function is_enough()
  local now = quality()
  return now.n_bad == 0 or math.min(now.theta_min, 180 - now.theta_max) >= min_dihedral or is_late()
end

local function clean_up()
  smooth{}
  suppress_points{}
  smooth{}
end

-- Algorithm 6, as long as it is fast.
local function plain_round()
  begin_round()
  local_reconnection{edges = quick}
  clean_up()
  insert_points{}
  smooth{}
end

local function mend(edges)
  clean_up()
  local_reconnection{edges = edges}
  smooth{}
end

-- A small polyhedron without the tet but with a new vertex, smoothed.
local function refill(max_vertices, desperate)
  return {"polyhedron_reconnection", insert = true, remove = true, relax = true,
          max_vertices = max_vertices, max_nodes = 50, desperate = desperate}
end

-- Makes things worse at first, then mends them.
local function open_by(operator, desperate)
  return sequence{operator, "recursive_shell_transformation", "smoothing", "joint_smoothing",
                  desperate = desperate}
end

-- The last round of the default schedule.
local function first_dear_round()
  begin_round()
  for _ = 1, 3 do
    local_reconnection{on = dire, reflex_only = false}
    apply({"cavity_insertion", exponent = 12, desperate = 0}, {on = dire})
    apply(refill(14, 0.7), {on = {below = 0, at_least = 32}})
    smooth{on = dire}
  end
  mend(quick)
end

-- A steep exponent: a new mild bad tet hardly counts against a worse one that vanishes.
local function insertion_round()
  begin_round()
  local_reconnection{on = dire, reflex_only = false}
  apply({"cavity_insertion", exponent = 16}, {on = {below = 1, worst = 1000}})
  apply(open_by("edge_split", 0.7), {on = few})
  mend()
end

-- Moves the vertices of a tet until it is as good as the goal. No other tet becomes bad.
local function lift(goal, on)
  return apply({"joint_smoothing", goal = goal}, {on = on})
       + apply({"joint_smoothing", goal = goal, rings = 1}, {on = on})
end

-- Lowers angles above 148 degrees, even if a few more tets fall just below 30.
local function lower(opening, follow_up)
  return apply(sequence{opening, "recursive_shell_transformation", "smoothing", follow_up, follow_up,
                        {"joint_smoothing", goal = 1.07}, theta_max = 148}, {on = obtuse})
end

-- All that may help the worst, every other round with less regard for mild ones.
local function worst_tets(i)
  local exponent, desperate = 4, 0.4
  if i % 2 == 0 then exponent, desperate = 12, 0.7 end
  smooth{on = worst, desperate = 0.7, steps = 30}
  local_reconnection{on = worst, reflex_only = false}
  apply({"cavity_insertion", exponent = exponent, desperate = desperate}, {on = worst})
  apply(refill(18, 0.7), {on = worst})
  apply(open_by("edge_split", 0.7), {on = worst})
  apply(open_by("edge_removal", 0.7), {on = worst})
end

-- Fewer bad tets, but none that is worse: with the exponent 1 the many mild ones count. Returns
-- whether that was worth the time.
local function all_bad_tets()
  local n_bad = quality().n_bad
  apply({"cavity_insertion", exponent = 1, desperate = 0, tries = 2})
  apply(refill(20, 0), {on = hard})
  return quality().n_bad < 0.88 * n_bad
end

-- Every form of every operator, for the few tets that decide about the angles. Returns how often one
-- helped.
local openings = {"edge_split", "edge_removal", "flip_2_3", "edge_contraction"}
local follow_ups = {"joint_smoothing", all_of{"joint_smoothing", "cavity_insertion"},
                    {"joint_smoothing", rings = 1}}
local function very_worst_tets()
  local accepted = 0
  for i, opening in ipairs(openings) do
    accepted = accepted
             + apply({"cavity_insertion", exponent = i % 2 == 0 and 4 or 12, desperate = 1}, {on = few})
             + apply(refill(12 + 4 * i, 1), {on = few})
             + apply(open_by(opening, 1), {on = few})
  end
  return accepted
end

local before = quality()
repeat
  local last = before
  plain_round()
  before = quality()
until before.n_bad > 0.6 * last.n_bad or is_enough()
if not is_enough() then first_dear_round() end

while not is_enough() do
  insertion_round()
  local now = quality()
  local stuck = not is_progress(before, now)
  before = now
  if stuck then break end
end

local rounds, failed, numbers_fall = 0, 0, true
while rounds < max_rounds and failed < max_failed and not is_enough() do
  before = quality()
  rounds = rounds + 1
  begin_round()
  worst_tets(rounds)
  mend()
  if numbers_fall and not is_enough() then numbers_fall = all_bad_tets() end
  failed = is_progress(before, quality()) and 0 or failed + 1
end

while rounds < max_rounds and not is_enough() do
  before = quality()
  rounds = rounds + 1
  begin_round()
  if very_worst_tets() == 0 then break end
  mend()
  if not is_progress(before, quality()) then break end
end

-- Smoothing trades a few mild tets against each other, so the costly operators come last.
if max_rounds > 0 and not is_enough() then
  worst_tets(1)
  while all_bad_tets() and not is_enough() do end
  if not is_late() then
    lift(1.01, worst)
    lift(1.08, blunt)
  end
  for _, follow_up in ipairs(follow_ups) do
    for _, opening in ipairs(openings) do
      if not is_late() then lower(opening, follow_up) end
    end
  end
  if not is_late() then lift(1.08, blunt) end
end
