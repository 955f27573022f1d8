-- Grummp's default, as Chen et al. describe it in section 7, with tetmend's operators.
description "The default of Grummp: three passes of 2-3 flips and edge removal over all tets, smoothing below an angle that falls, repair of the worst tets, smoothing again"

local theta = parameter{"theta", default = 25.0, low = 1, high = 60,
                        help = "degrees: tets with a smaller angle, or a larger one than 180 - theta, are smoothed"}
local share = parameter{"repair_share", default = 0.005, low = 0, high = 1,
                        help = "share of the tets that are repaired, the worst"}

-- Where most tets are above the threshold already, a lower one spares work.
local function smooth_twice()
  for _ = 1, 2 do
    smooth{on = {below = quality_of_angle(theta)}, cycles = 1}
    local now = quality()
    theta = math.min(theta, math.max(1, 1.5 * math.min(now.theta_min, 180 - now.theta_max)))
  end
end

judge_by{measure = "sine", price = 0}
-- Where inverted tets are many and neighbours, no operator finds a place for one of them.
untangle{}

begin_round()
for _ = 1, 3 do
  apply(all_of{"flip_2_3", "edge_removal"}, {on = "all"})
end
smooth_twice()

begin_round()
apply(all_of{"edge_removal", "multi_face_removal"}, {on = {below = 2, share = share}, sweeps = 3})
smooth_twice()
