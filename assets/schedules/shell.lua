-- Algorithm 6 of Chen et al., Tetrahedral Mesh Improvement by Shell Transformation.
description "Algorithm 6 of the paper: rounds of reconnection, suppression and insertion of points, each followed by smoothing, until rounds bring little; then dearer forms for the worst tets"

local max_rounds     = parameter{"max_rounds", default = 30, low = 0, high = 10000, help = "rounds in all"}
local least_progress = parameter{"least_progress", default = 0.1, low = 0, high = 1,
                                 help = "least share of the bad tets that a plain round must remove"}
local max_failed     = parameter{"max_failed", default = 2, low = 1, high = 1000,
                                 help = "thorough rounds in sequence without progress that end them"}
local last_rounds    = parameter{"last_rounds", default = 4, low = 0, high = 1000,
                                 help = "rounds for the very worst tets at the end"}

local dire  = {below = 0.25, at_least = 100}
local worst = {below = 0, at_least = 32}

-- DEVIATION: Algorithm 6 smooths before the first reconnection (docs/deviations.md).
local function round(thorough)
  begin_round()
  local_reconnection{}
  if thorough then local_reconnection{on = dire, reflex_only = false} end
  smooth{}
  suppress_points{}
  smooth{}
  if thorough then insert_points{on = dire, relax = true} else insert_points{} end
  smooth{}
  return quality()
end

-- For so few tets a new mild bad one is no reason to refuse.
local function last_round()
  begin_round()
  return smooth{on = worst, desperate = 0.35, steps = 30}
       + local_reconnection{on = worst, reflex_only = false}
       + insert_points{on = worst, desperate = 0.35, relax = true}
       + apply(first_of{"circumcentre_insertion", "centroid_insertion"}, {on = worst})
       + smooth{} + suppress_points{} + smooth{}
       + local_reconnection{} + smooth{}
end

local before   = quality()
local thorough = false
local failed   = 0
local rounds   = 0

-- DEVIATION: Algorithm 6 ends after three rounds without progress (docs/deviations.md).
while failed < max_failed and rounds < max_rounds and before.n_bad > 0 do
  local now = round(thorough)
  rounds = rounds + 1
  if thorough then
    failed = is_progress(before, now) and 0 or failed + 1
  else
    thorough = now.n_bad > (1 - least_progress) * before.n_bad
  end
  before = now
end

for _ = 1, math.min(last_rounds, max_rounds - rounds) do
  if quality().n_bad == 0 or last_round() == 0 then break end
end
