-- For solvers that care about all tets, not only about the worst.
description "What the default does; then smoothing and flips that raise the mean ratio of all tets"

local cycles = parameter{"cycles", default = 3, low = 1, high = 100,
                         help = "of smoothing and flips at the end, at most"}

run_schedule("shell")
judge_by{measure = "sine"}  -- so that no angle pays for a needle
polish{cycles = cycles}
