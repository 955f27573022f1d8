-- Where a fixed surface holds bad tets: the surface moves, as far as the run allows.
description "What follows another schedule when the surface may move (--surface): vertices, edges and triangles of the surface are tried where tets are bad, and what is around them again; does nothing where the surface is fixed"

local max_rounds = parameter{"max_rounds", default = 12, low = 0, high = 10000,
                             help = "rounds on all bad tets"}
local max_failed = parameter{"max_failed", default = 2, low = 1, high = 1000,
                             help = "such rounds in sequence without progress that end them"}

local worst = {below = 1, worst = 200}

local quick = {"recursive_shell_transformation", max_level = 2, order = "angle", most_edges = 1}

-- Only the tets that are bad: all else keeps its bits.
local function flip()
  return apply({"surface_edge_removal", order = "angle"}, {sweeps = 2})
end

local function move()
  local accepted = 0
  for _ = 1, 3 do
    local n = apply("surface_smoothing")
    smooth{}
    accepted = accepted + n
    if n == 0 then break end
  end
  return accepted
end

local function plain_round()
  begin_round()
  local accepted = flip() + move()
  accepted = accepted + apply("surface_contraction") + move()
  local_reconnection{edges = quick}
  suppress_points{}
  smooth{}
  accepted = accepted + flip() + move()
  return accepted
end

-- What makes things worse at first may help where nothing else does.
local function open_by(operator)
  return sequence{operator, "surface_edge_removal", "surface_smoothing",
                  "recursive_shell_transformation", "smoothing", "joint_smoothing",
                  "surface_smoothing", "surface_contraction", desperate = 0.7}
end

local function costly_round()
  begin_round()
  local accepted = apply({"surface_split", order = "longest"}, {on = worst})
  accepted = accepted + apply(open_by("surface_contraction"), {on = worst})
  accepted = accepted + apply(open_by("surface_edge_removal"), {on = worst})
  accepted = accepted + apply(open_by("edge_removal"), {on = worst})
  accepted = accepted + apply(open_by{"surface_split", order = "longest", relax = false}, {on = worst})
  accepted = accepted + apply(open_by{"edge_split", order = "angle", most_edges = 2}, {on = worst})
  apply({"cavity_insertion", exponent = 12, desperate = 0}, {on = worst})
  local_reconnection{on = worst, reflex_only = false}
  smooth{on = worst, desperate = 0.7, steps = 30}
  return accepted
end

local rounds, failed, before = 0, 0, quality()
while rounds < max_rounds and failed < max_failed and quality().n_bad > 0 do
  rounds = rounds + 1
  judge_by{price = 0.02}
  if plain_round() == 0 and rounds == 1 then
    -- nothing at all can move
  end
  if failed > 0 or rounds > 2 then
    judge_by{price = 0, measure = "sine"}
    costly_round()
    judge_by{price = 0.02}
    plain_round()
  end
  local now = quality()
  failed = is_progress(before, now) and 0 or failed + 1
  before = now
end
