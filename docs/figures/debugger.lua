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

-- A call whose candidate was made and undone.
theme("dark")
to_begin()
while next_refused() do
  local s = state().trace
  if s.undone and s.shell and s.shell.covering and #s.shell.ring > 4 then break end
end
screenshot("docs/figures/debugger-shell.png")

theme("light")
open("assets/lessons/2-two-shells.trace")
for _ = 1, 6 do next_lesson_step() end
screenshot("docs/figures/debugger-lesson.png")
