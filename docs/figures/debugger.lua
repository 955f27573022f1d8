-- Makes the pictures of the section on traces in docs/viewer.md. From the root of the repository:
--   build/release/bin/tetmend-view --panels --script docs/figures/debugger.lua
--   pngquant --force --ext .png docs/figures/debugger-*.png      (smaller files; optional)

size(1500, 940)
open("assets/meshes/sheet.mesh")
local trace = "demo-out/sheet.trace"
live_record(trace)
live_run()
live_wait()
open(trace)

deepest()
screenshot("docs/figures/debugger-tree.png")

-- A transformation that leaves a core.
theme("dark")
open("assets/lessons/1-core.trace")
next_accepted()
screenshot("docs/figures/debugger-shell.png")

theme("light")
open("assets/lessons/2-two-shells.trace")
for _ = 1, 6 do next_lesson_step() end
screenshot("docs/figures/debugger-lesson.png")
