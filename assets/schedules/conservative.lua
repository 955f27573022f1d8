description "Reconnection and smoothing only: no point is added or removed"

local max_rounds = parameter{"max_rounds", default = 20, low = 0, high = 10000, help = "rounds at most"}

-- Where inverted tets are many and neighbours, no operator finds a place for one of them.
untangle{}

local before = quality()
for _ = 1, max_rounds do
  if before.n_bad == 0 then break end
  begin_round()
  local_reconnection{}
  smooth{}
  local now = quality()
  if not is_progress(before, now) then break end
  before = now
end

-- The costly form, once, for what is left.
if before.n_bad > 0 then
  begin_round()
  local_reconnection{reflex_only = false}
  smooth{}
end
