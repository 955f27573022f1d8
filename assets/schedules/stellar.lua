-- Stellar's default, as Chen et al. describe it in section 7, with tetmend's operators.
description "The default of Stellar: smoothing, reconnection and contraction over all tets first, then rounds of them with insertion, and a desperate insertion into the worst tets when rounds bring little"

local max_rounds = parameter{"max_rounds", default = 30, low = 0, high = 10000, help = "rounds in all"}
local max_failed = parameter{"max_failed", default = 3, low = 1, high = 1000,
                             help = "rounds in sequence without progress that end the schedule"}
local desperate  = parameter{"desperate_share", default = 0.035, low = 0, high = 1,
                             help = "share of the tets that the desperate insertion works on, the worst"}
local coarsen    = parameter{"coarsen", default = false,
                             help = "contract over all tets at the beginning, as Stellar does; the paper's tests leave that out"}

judge_by{measure = "sine", price = 0}

-- Tets with an angle below 40 or above 140 degrees.
local mild = {below = quality_of_angle(40)}

local function reconnect()
  return apply(all_of{"edge_removal", "multi_face_removal"}, {on = "all"})
end

-- Where inverted tets are many and neighbours, no operator finds a place for one of them.
untangle{}

begin_round()
smooth{on = "all", cycles = 1}
reconnect()
if coarsen then suppress_points{on = "all"} end

local before = quality()
local failed = 0
for _ = 1, max_rounds do
  if failed == max_failed or before.n_bad == 0 then break end
  begin_round()
  smooth{on = "all", cycles = 1}
  reconnect()
  local now = quality()
  if not is_progress(before, now) then
    suppress_points{on = mild}
    if failed == 0 then
      insert_points{on = mild}
    else
      apply({"cavity_insertion", tries = 1, desperate = 2}, {on = {below = 2, share = desperate}})
    end
    smooth{on = "all", cycles = 1}
    reconnect()
    now = quality()
  end
  failed = is_progress(before, now) and 0 or failed + 1
  before = now
end
