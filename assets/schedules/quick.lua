-- For programs that make meshes in a loop.
description "Most bad tets in little time: rounds of reconnection, smoothing and insertion until few are left, costly operators for small meshes alone, little polish"

local max_rounds = parameter{"max_rounds", default = 3, low = 0, high = 10000, help = "rounds at most"}
local enough     = parameter{"enough", default = 0.03, low = 0, high = 1,
                             help = "share of the bad tets that may be left"}

local start = quality()
local first_mean = start.mean_ratio

-- Of a small mesh everything is cheap, and rounds alone leave a tenth of the bad tets.
if start.tets <= 100000 then
  run_schedule("shell", {max_rounds = max_rounds, last_sweeps = 2, polish_first = 1, polish_last = 0})
  return
end

untangle{}
-- A bad tet that is new has a price, as in shell.
judge_by{price = 0.1}
for round = 1, max_rounds do
  if quality().n_bad <= enough * start.n_bad then break end
  begin_round()
  local_reconnection{edges = {"recursive_shell_transformation", max_level = 1, order = "angle", most_edges = 1}}
  smooth{}
  if round > 1 then suppress_points{} end
  if quality().mean_ratio < first_mean then hold_mean(first_mean) end
  insert_points{}
  smooth{}
end
