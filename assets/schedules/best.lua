-- An hour for the last tet.
description "What thorough does, then neighbourhoods of the worst tets in many variants, of each the best, over and over: for the last bad tets. No turn leaves more of them; the worst may pay for half of those around it"

local turns    = parameter{"turns", default = 20, low = 1, high = 1000000,
                           help = "turns at most; ends earlier when six in a row bring nothing"}
local variants = parameter{"variants", default = 24, low = 1, high = 100000,
                           help = "of each neighbourhood in each turn"}
local worst    = parameter{"worst", default = 64, low = 1, high = 1000000,
                           help = "tets that get a neighbourhood in each turn, at most"}

run_schedule("thorough")

-- By angles alone, for needles are not what is left to be done.
judge_by{price = 0, measure = "sine"}

-- A new largest angle counts, though it is good, as far as it is near the goal.
local goal_max = quality().goal_max
local function keep_largest()
  goal{max = math.min(goal_max, math.max(quality().theta_max + 0.001, goal_max - 2))}
end

-- Where nothing brings anything any more, a worst tet may pay for half of the bad ones around it. The turns
-- that follow work on it.
local in_vain = 0
for turn = 1, turns do
  if quality().n_bad == 0 or in_vain == 6 then break end
  begin_round()
  keep_largest()
  local pays = in_vain % 3 == 2
  local accepted = vary{on = {below = 1, worst = worst}, rings = (pays and 4 or 2) + turn % 3, variants = variants,
                        first = turn * (variants + 1), floor = pays and 0.6 or 1}
  in_vain = accepted > 0 and 0 or in_vain + 1
end

-- What replaced a neighbourhood for its worst tets may be less round on average.
keep_largest()
polish{}
goal{max = goal_max}
