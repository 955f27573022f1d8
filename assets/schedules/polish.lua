-- For solvers that care about all tets, not only about the worst.
description "What the default does; then smoothing, flips, contraction and insertion that raise the mean ratio of all tets"

local cycles = parameter{"cycles", default = 6, low = 1, high = 100,
                         help = "of the polish at the end, at most"}

run_schedule("shell", {polish_last = 0})
judge_by{measure = "sine"}  -- so that no angle pays for a needle
polish{cycles = cycles}
