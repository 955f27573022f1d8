-- An hour for the last tet.
description "What thorough does, then neighbourhoods of the worst tets in many variants, of each the best, over and over: for the last bad tets. Each turn ends no worse than it began"

local turns    = parameter{"turns", default = 20, low = 1, high = 1000000,
                           help = "turns at most; ends earlier when six in a row bring nothing"}
local variants = parameter{"variants", default = 24, low = 1, high = 100000,
                           help = "of each neighbourhood in each turn"}
local worst    = parameter{"worst", default = 64, low = 1, high = 1000000,
                           help = "tets that get a neighbourhood in each turn, at most"}

run_schedule("thorough")

judge_by{price = 0}
local in_vain = 0
for turn = 1, turns do
  if quality().n_bad == 0 or in_vain == 6 then break end
  begin_round()
  local accepted = vary{on = {below = 1, worst = worst}, rings = 2 + turn % 3, variants = variants,
                        first = turn * (variants + 1)}
  in_vain = accepted > 0 and 0 or in_vain + 1
end

-- What replaced a neighbourhood for its worst tets may be less round on average.
polish{}
