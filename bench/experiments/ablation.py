# SPDX-License-Identifier: MIT
"""The thorough schedule with one operator or form left out at a time."""

import common
import compare
import report

SCHEDULES = compare.ROOT / "assets" / "schedules"
LEFT_OUT = ["local_reconnection", "smooth", "suppress_points", "insert_points", "cavity_insertion",
            "polyhedron_reconnection", "joint_smoothing", "sequence", "polish"]
TEXT = (
    "The thorough schedule with one operator or form left out at a time. Inside of other operators "
    "(relaxation) nothing is left out."
)

# The words of a script are globals, so locals of the same name take their place.
PRELUDE = """
local left_out = "{left_out}"
local function is_left_out(what)
  if type(what) == "string" then return what == left_out end
  return what.how == left_out or is_left_out(what[1])
end
local function without(what)
  if type(what) == "string" then return what end
  local kept = {{}}
  for key, value in pairs(what) do
    if math.type(key) ~= "integer" then kept[key] = value end
  end
  for _, part in ipairs(what) do
    if not is_left_out(part) then kept[#kept + 1] = without(part) end
  end
  return kept
end
local function unless_left_out(name, word)
  return function(...) return name == left_out and 0 or word(...) end
end
local all_apply = apply
local function apply(what, options)
  if is_left_out(what) then return 0, 0 end
  return all_apply(without(what), options)
end
local local_reconnection = unless_left_out("local_reconnection", local_reconnection)
local smooth = unless_left_out("smooth", smooth)
local suppress_points = unless_left_out("suppress_points", suppress_points)
local insert_points = unless_left_out("insert_points", insert_points)
local polish = unless_left_out("polish", polish)
local function run_schedule(_, settings)
  local function description() end
  local function parameter(spec)
    local value = settings and settings[spec[1]]
    return value == nil and spec.default or value
  end
"""


def write_script(left_out: str, options) -> str:
    script = options.output / f"thorough-without-{left_out}.lua"
    shell, thorough = ((SCHEDULES / name).read_text() for name in ("shell.lua", "thorough.lua"))
    script.write_text(f"{PRELUDE.format(left_out=left_out)}{shell}end\n{thorough}")
    return str(script)


def main() -> None:
    options = common.parse("ablation", __doc__)
    table = [["mesh", "left out", "tets", *report.QUALITY, common.SECONDS]]
    results = []
    for mesh in common.meshes(options):
        rows = {"nothing": common.improve(mesh, options, "--schedule", "thorough")}
        for name in LEFT_OUT:
            rows[name] = common.improve(mesh, options, "--schedule", write_script(name, options))
        for name, row in rows.items():
            table.append([mesh.stem, name, *common.cells(row["after"], row["user_seconds"])])
        results.append({"mesh": mesh.stem, "rows": rows})
    common.save("ablation", options, {"meshes": results}, table, "What each operator buys", TEXT)


if __name__ == "__main__":
    main()
