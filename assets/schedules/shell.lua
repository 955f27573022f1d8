-- Algorithm 6 of Chen et al., Tetrahedral Mesh Improvement by Shell Transformation.
description "Algorithm 6 of the paper: rounds of reconnection, suppression and insertion of points, each followed by smoothing, until rounds bring little; then costly operators, for the worst tets first. A polish before that and at the end, of small meshes"

local max_rounds     = parameter{"max_rounds", default = 30, low = 0, high = 10000, help = "rounds in all"}
local least_progress = parameter{"least_progress", default = 0.1, low = 0, high = 1,
                                 help = "least share of the bad tets that a plain round must remove"}
local last_sweeps    = parameter{"last_sweeps", default = 4, low = 0, high = 1000,
                                 help = "most sweeps of costly operators over the worst tets"}
local least_yield    = parameter{"least_yield", default = 0.1, low = 0, high = 10,
                                 help = "least number of bad tets that a costly attempt must remove on average"}
local polish_first   = parameter{"polish_first", default = 3, low = 0, high = 100,
                                 help = "cycles of polish before the rounds, at most"}
local polish_last    = parameter{"polish_last", default = 2, low = 0, high = 100,
                                 help = "cycles of polish at the end, at most"}
local worst_only     = parameter{"worst_only", default = false,
                                 help = "go for the worst tets at once, whatever that costs in mild ones"}
local worst_later    = parameter{"worst_later", default = false,
                                 help = "leave them to a run with worst_only"}

-- DEVIATION: Algorithm 5 tries all edges. The choice matters little for the mesh, but much for the time
-- (docs/deviations.md).
local quick = {"recursive_shell_transformation", max_level = 2, order = "angle", most_edges = 1}
local dire  = {below = 0.5, at_least = 100}
local worst = {below = 1, worst = 100}
local few, fewest = {below = 1, worst = 32}, {below = 1, worst = 8}

-- DEVIATION: a new bad tet has a price (docs/deviations.md). Without one, the worst tet gains a little, mild
-- bad ones remain, and the next round has more to do. Only the worst tets are worth any number of mild ones.
local full_price, half_price = 0.1, 0.02

-- DEVIATION: insertion has to pay. A split adds some five tets, and usually removes one bad one.
local least_growth_yield = 0.02
local is_growing = true

local function pays_growth(before, now)
  return before.n_bad - now.n_bad >= least_growth_yield * (now.tets - before.tets)
end

-- DEVIATION: where inverted tets are many and neighbours, no operator finds a better place for one of them.
untangle{}

local start = quality()
local is_small = start.tets <= 100000

local first_mean, first_lambda = start.mean_ratio, start.lambda
local first_radius = is_small and start.radius_ratio or 0

-- Where insertion costs the mean more than the polish at the end gains, only what is round enough is
-- inserted. A part of the bad tets tells.
local function insert_some()
  local before = quality()
  if before.n_bad < 40 or before.mean_ratio == 0 then return end
  insert_points{on = {below = 1, worst = before.n_bad // 4}}
  smooth{}
  local now = quality()
  if before.mean_ratio - 4 * (before.mean_ratio - now.mean_ratio) < first_mean - 0.01 then
    hold_mean(0.85 * first_mean)
  end
end

-- Likewise where the insertions of several rounds together cost more: the first polish tells what the last
-- one may gain.
local room = 0.01
local function hold_if_costly()
  if is_small and start.n_bad > 0 and quality().mean_ratio < first_mean - room then
    hold_mean(first_mean)
  end
end

-- Returns the share of the bad tets that remains.
local rounds = 0
local function plain_round()
  local n_bad = quality().n_bad
  if rounds == max_rounds or n_bad == 0 then return 1 end
  rounds = rounds + 1
  begin_round()
  -- DEVIATION: Algorithm 6 smooths before the first reconnection (docs/deviations.md).
  local_reconnection{edges = quick}
  smooth{}
  suppress_points{}
  smooth{}
  if is_growing then
    local before = quality()
    if rounds == 1 then insert_some() else hold_if_costly() end
    insert_points{}
    smooth{}
    is_growing = pays_growth(before, quality())
  end
  return quality().n_bad / n_bad
end

-- DEVIATION: Algorithm 6 ends after three rounds without progress (docs/deviations.md).
local function plain_rounds()
  repeat until plain_round() > 1 - least_progress
end

-- DEVIATION: only the recursion is in the paper. The exponent is steep: here a new mild bad tet hardly
-- counts against a worse one that vanishes.
local function sweep_worst(on)
  return local_reconnection{on = on, reflex_only = false}
       + apply({"cavity_insertion", exponent = 12, desperate = 0, tries = 6}, {on = on})
       + apply({"polyhedron_reconnection", insert = true, remove = true, relax = true,
                max_vertices = 14, max_nodes = 50, desperate = 0.7}, {on = few})
end

-- What makes things worse at first may help where nothing else does.
local function split_worst()
  return apply(sequence{"edge_split", "recursive_shell_transformation", "smoothing", "joint_smoothing",
                        desperate = 0.7}, {on = few})
end

-- A rescue must not end with more bad tets than there were at the start, so it stops in time.
local function is_too_costly()
  return not worst_only and quality().n_bad > start.n_bad
end

-- Needles count first: they would spoil what is around them. Sines alone count last, so that needles which
-- the surface forces do not hide them.
local function rescue_worst()
  local function mend(on)
    return sweep_worst(on) + smooth{on = on, desperate = 0.7}
  end
  -- Mild bad tets buy angles for the worst. Where the walls hold those, they would be spent for nothing: few
  -- tell, before many pay.
  local function is_in_vain(on)
    local before = quality().q_few
    mend(on)
    return quality().q_few < before + 0.02
  end
  local has_price = false
  if not worst_only then
    begin_round()
    judge_by{price = 0}
    has_price = is_in_vain(fewest) or is_in_vain(few)
  end
  judge_by{price = has_price and full_price or half_price}
  plain_round()
  is_growing = true
  begin_round()
  judge_by{price = has_price and full_price or 0}
  for _ = 1, last_sweeps // 2 do
    if is_too_costly() then break end
    hold_if_costly()
    if mend(dire) == 0 then break end
  end
  judge_by{price = has_price and full_price or 0, measure = "sine"}
  for _ = 1, last_sweeps - last_sweeps // 2 do
    if is_too_costly() then break end
    hold_if_costly()
    if sweep_worst(worst) + split_worst() + smooth{on = worst, desperate = 0.7} == 0 then break end
  end
  judge_by{price = full_price}
  plain_rounds()
end

-- The worst bad tets first, then four times as many, as long as attempts pay.
local function insert_while_it_pays()
  begin_round()
  local now, count, removed, tried = quality(), 200, 1, 0
  while now.n_bad > 0 and removed > 0 and removed >= least_yield * tried do
    local n_bad = now.n_bad
    hold_if_costly()
    local accepted
    accepted, tried = apply({"cavity_insertion", desperate = 0}, {on = {below = 1, worst = count}})
    smooth{}
    local_reconnection{edges = quick}
    smooth{}
    local before = now
    now = quality()
    if not pays_growth(before, now) then break end
    removed, count = n_bad - now.n_bad, 4 * count
  end
end

if worst_only then
  rescue_worst()
  return
end
-- Size first: where edges are too long or too short for their place, what follows only adds to it. By
-- sines, so that no angle pays for a needle. Of a large mesh all this would take longer than the rest.
-- A mesh without bad tets comes back as it is.
local function even_out(options)
  if options.cycles == 0 or max_rounds == 0 or start.n_bad == 0 then return end
  judge_by{measure = "sine"}
  polish(options)
end

if is_small then
  -- With few bad angles to lose, fewer tets would raise their share.
  even_out{cycles = polish_first, below = 0.8, insert = 0.7, contract = first_lambda > 0.3 and 0.75 or 0,
           grow = 0}
  room = room + (quality().mean_ratio - first_mean) / 2
end
judge_by{price = full_price}
plain_rounds()

-- Where the surface forces most of the bad tets, costly operators only make more of them.
local is_free = quality().n_bad < 2 / 3 * start.n_bad
if rounds < max_rounds and last_sweeps > 0 and quality().n_bad > 0 then
  if is_free and not worst_later then rescue_worst() end
  insert_while_it_pays()
end

if is_small then
  even_out{cycles = polish_last, below = 0.8, insert = 0.75, contract = 2, lambda = first_lambda}
  -- The mean of the radius ratios lags behind that of the mean ratios.
  if polish_last > 0 and
     (quality().mean_ratio < first_mean + 0.01 or quality().radius_ratio < first_radius) then
    even_out{cycles = 2 * polish_last, below = 0.9, insert = 0.8, contract = 2, lambda = first_lambda}
  end
else
  even_out{cycles = math.min(polish_last, 1), smooth = 0.5, below = 0.3, insert = 0, contract = 0,
           lambda = first_lambda}
end
