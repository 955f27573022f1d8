-- Makes the pictures of docs/viewer.md. From the root of the repository, after script/demo:
--   build/release/bin/tetmend improve assets/meshes/bracket.meshb -o demo-out/moved.mesh --goal 40 --surface 5%
--   build/release/bin/tetmend-view --panels --scale 0.85 --script docs/figures/viewer.lua
--   pngquant --force --ext .png docs/figures/viewer-*.png      (smaller files; optional)

size(1100, 690)
open("assets/meshes/bracket.meshb")
cut(1, {position = 0.12})
ghosts(0.12)
screenshot("docs/figures/viewer-cut.png")

-- An exact cut in the colours of the measure, and the brushed histogram.
show_all()
colour("min_sine")
bad()
cut(2, {position = -0.05, exact = true})
look_from("-y")
view{camera = {yaw = -70, pitch = 20}}
fit()
filter(0.0, 0.6)
screenshot("docs/figures/viewer-filter.png")

-- The shell of an edge: one that is not on the surface, seen through the rest.
theme("dark")
open("assets/meshes/sheet.mesh")
bad()
colour("region")
show_all()
ghosts(0.1)
select_edge(704, 745)
filter(2, 3) -- no tet at all
fit()
screenshot("docs/figures/viewer-shell.png")

-- Before and after.
theme("light")
deselect()
show_all()
open("demo-out/improved.mesh")
compare("assets/meshes/bracket.meshb")
home()
screenshot("docs/figures/viewer-after.png")

-- A run that is paused after the first call of its third pass that changes the mesh.
open("assets/meshes/bracket.meshb")
show_all()
cut(1, {position = 0.12})
ghosts(0.12)
home()
live_run()
for _ = 1, 2 do live_step_pass() live_wait() end
live_step()
live_wait()
live_debug()
screenshot("docs/figures/viewer-live.png")
live_stop()

-- How far the surface has moved.
open("demo-out/moved.mesh")
show_all()
ghosts(0)
reference("assets/meshes/bracket.meshb", "5%")
view{both_ways = true}
home()
screenshot("docs/figures/viewer-distance.png")
