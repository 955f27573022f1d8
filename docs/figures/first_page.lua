-- Makes the two pictures of README and of the first page of the site. From the root of the repository, after script/demo:
--   build/release/bin/tetmend-view --script docs/figures/first_page.lua
--   pngquant --force --ext .png docs/figures/before.png docs/figures/after.png      (smaller files; optional)

size(640, 460)

-- Cut at the same place, from the same side; bad tets are red.
local function picture(mesh, file)
  open(mesh)
  show_all()
  home()
  cut(1, {position = 0.12})
  ghosts(0.12)
  screenshot(file)
end

picture("assets/meshes/bracket.meshb", "docs/figures/before.png")
picture("demo-out/improved.mesh", "docs/figures/after.png")
