-- Algorithm 6 of Chen et al., Tetrahedral Mesh Improvement by Shell Transformation.
description "Algorithm 6 of the paper: rounds of reconnection, suppression and insertion of points, each followed by smoothing, until rounds bring little; then costly operators for the worst tets"

local max_rounds     = parameter{"max_rounds", default = 30, low = 0, high = 10000, help = "rounds in all"}
local least_progress = parameter{"least_progress", default = 0.4, low = 0, high = 1,
                                 help = "least share of the bad tets that a plain round must remove"}
local last_sweeps    = parameter{"last_sweeps", default = 3, low = 0, high = 1000,
                                 help = "most sweeps of costly operators over the worst tets in the last round"}

-- DEVIATION: Algorithm 5 tries all edges. The choice matters little for the mesh, but much for the time
-- (docs/deviations.md).
local quick = {"recursive_shell_transformation", max_level = 2, order = "angle", most_edges = 1}
local dire  = {below = 0.5, at_least = 100}
local worst = {below = 0, at_least = 32}

-- DEVIATION: new bad tets have a price (docs/deviations.md). The worst tets are worth more than that.
local price = 0.1

local function clean_up()
  smooth{}
  suppress_points{}
  smooth{}
end

-- DEVIATION: Algorithm 6 smooths before the first reconnection (docs/deviations.md).
local function plain_round()
  begin_round()
  local_reconnection{edges = quick}
  clean_up()
  insert_points{}
  smooth{}
end

-- DEVIATION: only the recursion is in the paper. With so few tets, a new mild bad one is no reason to
-- refuse.
local function sweep_worst()
  return local_reconnection{on = dire, reflex_only = false}
       + apply({"cavity_insertion", exponent = 12, desperate = 0}, {on = dire})
       + apply({"polyhedron_reconnection", insert = true, remove = true, relax = true,
                max_vertices = 14, max_nodes = 50, desperate = 0.7}, {on = worst})
       + smooth{on = dire}
end

local function last_round()
  begin_round()
  judge_by{price = 0}
  for _ = 1, last_sweeps do
    if sweep_worst() == 0 then break end
  end
  clean_up()
  local_reconnection{edges = quick}
  smooth{}
end

judge_by{price = price}
local rounds, before, now = 0, nil, quality()

-- DEVIATION: Algorithm 6 ends after three rounds without progress (docs/deviations.md).
repeat
  if rounds == max_rounds or now.n_bad == 0 then break end
  before = now
  plain_round()
  rounds = rounds + 1
  now = quality()
until now.n_bad > (1 - least_progress) * before.n_bad

if rounds < max_rounds and last_sweeps > 0 and now.n_bad > 0 then last_round() end
