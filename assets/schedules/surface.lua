-- Where a fixed surface holds bad tets: the surface moves, as far as the run allows.
description "What follows another schedule where the surface may move (--surface): bad tets are worked on by operators that change the surface, in turns with those inside, until rounds bring nothing"

local max_rounds = parameter{"max_rounds", default = 12, low = 0, high = 10000,
                             help = "rounds of costly operators on the worst tets"}
local max_failed = parameter{"max_failed", default = 3, low = 1, high = 1000,
                             help = "such rounds in sequence without progress that end them"}
local most_worst = parameter{"most_worst", default = 200, low = 1, high = 100000,
                             help = "of many bad tets, so many of the worst get costly operators"}

local quick = {"recursive_shell_transformation", max_level = 2, order = "angle", most_edges = 1}
local refill = {"polyhedron_reconnection", insert = true, remove = true, relax = true,
                max_vertices = 18, max_nodes = 50, desperate = 0.7}
local split = {"surface_split", order = "longest"}

local start = quality()

-- Where more are bad after the cheap rounds, what raises the worst at no price makes many mild ones.
local few = 200
local worst = {below = 1, worst = most_worst}
-- Where the cheap rounds leave more of those that there were, the surface holds them.
local most_left = 0.9

local function flip()
  return apply({"surface_edge_removal", order = "angle"}, {sweeps = 2})
end

local function move()
  local moved = 0
  for _ = 1, 3 do
    local accepted = apply("surface_smoothing")
    moved = moved + accepted
    if smooth{} + accepted == 0 then break end
  end
  return moved
end

-- Many attempts in vain cost more than they may still bring.
local splits_fail = false
local function split_surface()
  if splits_fail then return 0 end
  local accepted, tried = apply(split)
  splits_fail = accepted == 0 and tried > 1000
  return accepted
end

-- Returns how often the surface changed.
local function plain_round()
  begin_round()
  local changed = flip() + move() + apply("surface_contraction") + move()
  local_reconnection{edges = quick}
  suppress_points{}
  smooth{}
  return changed + split_surface() + flip() + move()
end

-- Cheap: all bad tets, as long as that removes a twentieth of them.
local function plain_rounds()
  local changed = 0
  repeat
    local n_bad = quality().n_bad
    changed = changed + plain_round()
  until n_bad == 0 or quality().n_bad > 0.95 * n_bad
  return changed
end

-- Makes things worse at first, then mends them by nearly all that there is.
local function open_by(operator)
  return sequence{operator, "surface_edge_removal", "surface_smoothing",
                  "recursive_shell_transformation", "smoothing", "joint_smoothing",
                  "surface_smoothing", "surface_contraction", {"cavity_insertion", tries = 6},
                  {"polyhedron_reconnection", insert = true, remove = true, relax = true,
                   max_vertices = 10, max_nodes = 15},
                  "smoothing", "surface_smoothing", "joint_smoothing", desperate = 0.7}
end

local openings = {"surface_contraction", "surface_edge_removal", "edge_removal",
                  {"surface_split", order = "longest", relax = false},
                  {"edge_split", order = "angle", most_edges = 2}, "edge_contraction",
                  "surface_smoothing", "smoothing"}

local function costly_round(on)
  begin_round()
  for _, opening in ipairs(openings) do apply(open_by(opening), {on = on}) end
  apply({"cavity_insertion", exponent = 12, desperate = 0, tries = 6}, {on = on})
  apply(refill, {on = on})
  local_reconnection{on = on, reflex_only = false}
  smooth{on = on, desperate = 0.7, steps = 30}
end

-- The same, mended by what takes little time.
local function open_lightly(operator)
  return sequence{operator, "surface_edge_removal", "smoothing", "surface_smoothing",
                  "recursive_shell_transformation", "smoothing", "joint_smoothing", desperate = 0.7}
end

-- Those first that take the least time for a success.
local quick_openings = {"surface_smoothing", "smoothing",
                        {"surface_split", order = "longest", most_edges = 2, relax = false},
                        {"edge_removal", most_edges = 2},
                        {"edge_split", order = "angle", most_edges = 2}}
local fails_lightly = {}

-- Where many are left: lightly all of them, so that fewer are close together; then the worst.
local function thinning_round()
  begin_round()
  apply({"cavity_insertion", desperate = 0, tries = 2})
  for i, opening in ipairs(quick_openings) do
    if not fails_lightly[i] then
      local accepted, tried = apply(open_lightly(opening))
      fails_lightly[i] = accepted < 0.05 * tried
    end
  end
  begin_round()
  for _, opening in ipairs(quick_openings) do apply(open_by(opening), {on = worst}) end
  local_reconnection{on = worst, reflex_only = false}
  smooth{on = worst, desperate = 0.7, steps = 30}
end

-- As if the goal were so many times as far from 0 and from 180 degrees.
local function aim(share)
  goal{min = math.min(70, share * start.goal_min),
       max = math.max(71, start.goal_max - (share - 1) * (180 - start.goal_max))}
end

local full_price, half_price = 0.1, 0.02

-- A needle is no worse than 0.4, so it would be given for angles of 12 and 168 degrees: none may be worse
-- than the worst that the fixed surface has left.
hold_worst()
judge_by{price = full_price}
local has_moved = plain_rounds() > 0

-- Where too many are left for that, what takes little time, by sines alone, inside: a surface that moves
-- so often loses volume.
if has_moved and quality().n_bad > math.max(few, 0.002 * quality().tets) then
  begin_round()
  judge_by{price = full_price, measure = "sine"}
  apply({"cavity_insertion", desperate = 0, tries = 2})
  apply(sequence{"smoothing", "recursive_shell_transformation", "smoothing", "joint_smoothing",
                 desperate = 0.7})
  local_reconnection{edges = quick}
  smooth{}
  judge_by{price = full_price}
end

-- Where many are left, but few of all tets or of those that there were, the worst rise at a price, as
-- long as a round removes a fifth of the bad ones.
for _ = 1, max_rounds do
  local n_bad = quality().n_bad
  local is_crowded = n_bad > 0.002 * quality().tets
  local is_held = is_crowded and n_bad > most_left * start.n_bad
  if not has_moved or n_bad <= few or is_held then break end
  -- At half a price, a crowd of bad tets grows.
  local price = is_crowded and full_price or half_price
  judge_by{price = price, measure = "sine"}
  thinning_round()
  judge_by{price = price}
  plain_rounds()
  if quality().n_bad > 0.8 * n_bad then break end
end

-- Where a few are left, several changes together may move what none moves alone.
local rounds, failed, before = 0, 0, quality()
while rounds < max_rounds and failed < max_failed
      and quality().n_bad > 0 and quality().n_bad <= few do
  rounds = rounds + 1
  -- What is stuck at the goal has neighbours that just meet it and leave it no room.
  local is_stuck = failed > 0
  judge_by{price = is_stuck and full_price or 0, measure = "sine"}
  aim(is_stuck and 1.05 or 1)
  -- Beyond the goal, much is bad that has nothing to do with them.
  costly_round{below = 1, worst = is_stuck and math.min(few, math.max(50, 4 * before.n_bad)) or few}
  aim(1)
  judge_by{price = half_price}
  plain_rounds()
  local now = quality()
  failed = is_progress(before, now) and 0 or failed + 1
  before = now
end

-- At the goal, the surface stays as it is. Inside, the largest angles are eased as long as they fall.
local function ease(most)
  local blunt = {below = quality_of_angle(most), worst = 50,
                 property = {"largest_angle_sine", low = 0, high = math.sin(math.rad(180 - most))}}
  for _, opening in ipairs{"edge_removal", {"edge_split", order = "angle", most_edges = 2},
                           "smoothing", "edge_contraction"} do
    apply(sequence{opening, "recursive_shell_transformation", "smoothing", "joint_smoothing",
                   {"cavity_insertion", tries = 6}, "smoothing", "joint_smoothing", theta_max = most},
          {on = blunt})
  end
end

local most = start.goal_max - 2
if max_rounds > 0 and quality().n_bad == 0 and most > 90 then
  judge_by{measure = "sine"}
  local largest
  repeat
    largest = quality().theta_max
    ease(most)
  until quality().theta_max > largest - 0.1
end
