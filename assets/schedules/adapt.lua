-- For sizes: what `tetmend adapt` does.
description "Splits edges that are longer than wanted and contracts shorter ones, smooths and flips in between; then what the default does, under the same sizes. Needs --size"

local max_rounds = parameter{"max_rounds", default = 12, low = 1, high = 1000,
                             help = "rounds of splits, contractions, flips and smoothing"}
local floor      = parameter{"floor", default = 0.35, low = 0, high = 2,
                             help = "no split or contraction makes a tet below that quality"}
local improves   = parameter{"improve", default = true,
                             help = "do what the default does, at the end"}

-- Among inverted neighbours nearly every split or contraction is refused.
untangle{}

judge_by{measure = "sine"}
for round = 1, max_rounds do
  begin_round()
  local before = quality().tets
  local changed = adapt{floor = floor}
  local is_rough = changed > 0.05 * before
  polish{cycles = 1, below = is_rough and 0.5 or 0.8, smooth = is_rough and 0.7 or 1, insert = 0, contract = 0}
  if changed < 0.002 * before then break end
end

if improves then
  hold_worst()
  run_schedule("shell", {polish_first = 0})
end
