-- Table 2 of Chen et al.: what reconnection alone does, in one pass over the bad tets.
description "Table 2 of the paper: one reconnection pass with one of its schemes"

local scheme = parameter{"scheme", choices = {"shell", "shell_flat", "stellar", "grummp"},
  help = "shell: recursive shell transformation; shell_flat: without recursion; stellar: edge removal and multi-face removal; grummp: edge removal and 2-3 flips"}

judge_by{measure = "sine", price = 0}
if scheme == "shell" then
  local_reconnection{sweeps = 1}
elseif scheme == "shell_flat" then
  local_reconnection{sweeps = 1, max_level = 0}
elseif scheme == "stellar" then
  local_reconnection{sweeps = 1, edges = "edge_removal"}
else
  local_reconnection{sweeps = 1, edges = "edge_removal", faces = "flip_2_3"}
end
